// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/field.h"
#include "hogel/optics/propagation/line_transform.h"

namespace hogel::optics::propagation {

/// Sampling of one axis for the propagation of a field to a rectangle of samples. Positions are relative to the centre
/// of the field and increase with the sample index: to the right along x, downwards along y.
struct AxisPlan {
    Steps field, output, frequencies;
    /// Sideways path: the distance along this axis between the points at which a ray crosses the two planes. Paths that
    /// lead from the field to the output are within middle ± reach, metres.
    double middle = 0, reach = 0;
    /// fresnel: the Fresnel length √(λz)/cos^{3/2} θ of the most oblique direction that is kept; √(λz) along the z
    /// axis. guard: the amplitude falls to one half at paths reach + guard/2 from `middle`, as ½ erfc of width
    /// fresnel/√π. Metres.
    double fresnel = 0, guard = 0;
    double period = 0;  ///< inverse of the frequency step, metres; an even number of field samples
    /// Lengths of the FFTs from field samples to frequencies (inward) and from frequencies to output samples (outward).
    /// 0: a chirp-z transform instead.
    std::size_t inward = 0, outward = 0;
    /// An edge of the band, at half a cycle per sample. `active`: light at the edge reaches the output. low, high: the
    /// range, in periods, of the difference between the path from any field sample to any output sample and the
    /// sideways path of light at the edge.
    struct Edge {
        bool active = false;
        double low = 0, high = 0;
    } lower, upper;

    double edge_frequency() const { return 0.5 / field.step; }
    /// Returns the largest sideways path, relative to middle, of the directions that are kept.
    double outermost() const;
    double end_of_fade() const;
};

/// Propagation of a field to a rectangle of output samples.
struct TilePlan {
    AxisPlan x, y;
    double distance = 0, wavelength = 0;
    bool evanescent = false;  ///< true if evanescent waves have not decayed at this distance
    /// Directions with a smaller cosine to the z axis have a sideways path too long for the period, and are dropped. 0:
    /// none.
    double min_cosine = 0;

    double bytes() const;
    double operations() const;
};

/// Returns the output samples that light of the field can reach. They lie in the cone of directions of the field's
/// samples, or beside it, where the edges of the field's band diffract: on either side as many samples as in the cone.
/// All other samples are dark. Throws Error(usage) if no sample is in the cone.
Region illuminated_region(const FieldGrid& field, double distance, const Grid& output);

TilePlan plan_tile(const FieldGrid& field, double distance, const Grid& output);

}  // namespace hogel::optics::propagation
