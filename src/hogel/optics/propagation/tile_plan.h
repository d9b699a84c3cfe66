// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/field.h"
#include "hogel/optics/propagation/line_transform.h"

namespace hogel::optics::propagation {

/// One axis of the propagation of a field to a rectangle of samples. Positions are relative to the field's middle and
/// run with the samples: to the right along x, downwards along y.
struct AxisPlan {
    Steps field, output, frequencies;
    /// Light that reaches the output travels sideways by middle ± reach.
    double middle = 0, reach = 0;
    /// Directions that travel farther by more than half of `guard` fade out over a multiple of `fresnel`, √(λz) for
    /// light along the axis.
    double fresnel = 0, guard = 0;
    double period = 0;  ///< one over the step of the frequencies, an even number of the field's samples
    /// The Fourier transforms of the samples to the frequencies and of these to the output; 0: chirp-z.
    std::size_t inward = 0, outward = 0;
    /// One of the band's edges, half a cycle per sample: whether light there reaches the output, and then the range of
    /// the path that remains from any sample to any output, in periods.
    struct Edge {
        bool active = false;
        double low = 0, high = 0;
    } lower, upper;

    double edge_frequency() const { return 0.5 / field.step; }
    /// The largest sideways path of directions that are kept, beyond middle ± reach.
    double outermost() const;
    double end_of_fade() const;
};

/// Propagation of a field to a rectangle of output samples.
struct TilePlan {
    AxisPlan x, y;
    double distance = 0, wavelength = 0;
    bool evanescent = false;  ///< whether evanescent waves have not decayed yet
    /// Directions at smaller cosines to the z axis travel too far for the period.
    double min_cosine = 0;

    double bytes() const;
    double operations() const;
};

/// The samples of an output that light of the field may reach: those in the cone of the directions of its samples, and
/// beside it, where the ends of the field's band diffract, as many as are in it on either side. All others are dark.
/// Throws Error(usage) if no sample is in the cone.
Region lit_part(const FieldGrid& field, double distance, const Grid& output);

TilePlan plan_tile(const FieldGrid& field, double distance, const Grid& output);

}  // namespace hogel::optics::propagation
