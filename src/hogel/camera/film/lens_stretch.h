// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/optics/lines.h"
#include "hogel/optics/pupil_edge.h"

namespace hogel::camera::film {

/// A stretch of columns of sixteen rows of a lens, over which the squared distance from the middle of the pupil, the
/// weight of the transmission and the phase are parabolas.
struct LensStretch {
    std::size_t columns = 0;
    double inner = 0;  ///< distance from the middle of the pupil within which all light passes, metres

    /// a + b t + c t² of each row, for column t.
    struct Parabolas {
        alignas(64) float a[optics::block_lines], b[optics::block_lines], c[optics::block_lines];
    };
    Parabolas square, weight;
    /// Phasors of each row: of the first column, of the step to the next, and of the change of the step per column.
    struct Phasors {
        alignas(64) float re[optics::block_lines], im[optics::block_lines];
    };
    Phasors value, step, bend;

    /// Sets a row by values at columns 0, length/2 and length; phases in cycles.
    void set(std::size_t row, const double (&squares)[3], const double (&weights)[3], const double (&cycles)[3],
             double length);
};

/// Computes the lens, [column][part][row]. Plain and fast twins agree to 1e-4 of the weight.
/// @param radius  of the pupil, metres
void lens_stretch_plain(const LensStretch& stretch, const optics::PupilEdge& edge, double radius, float* out);
extern decltype(lens_stretch_plain)& lens_stretch;

}  // namespace hogel::camera::film
