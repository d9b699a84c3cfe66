// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/progress.h"

namespace hogel {

/// Options of find_focus().
struct FocusOptions {
    /// The depths that are searched, metres behind the hologram (negative: in front). Equal: as far as its samples and
    /// its size resolve alike, N Δ²/λ on both sides, and up to eight times as far where nothing stands out.
    double from = 0, to = 0;
    std::size_t planes = 0;  ///< number of depths; 0: one every depth of focus
    /// Samples of the middle of each field that are looked at, or all where there are fewer; 0: max_side at most.
    std::size_t width = 0, height = 0;
    std::size_t max_side = 1024;  ///< samples; what is wider or higher is looked at in several parts
};

/// The part of a field that find_focus() looks at.
HOGEL_API Region focus_region(const FieldGrid& grid, const FocusOptions& options);

/// A plane in focus.
struct FocusPlane {
    double depth = 0;  ///< metres behind the hologram
    /// How far the contrast there lies from that of its surroundings: the difference of logarithms to the nearer of the
    /// two extrema beside it.
    double prominence = 0;
    bool brightest = true;  ///< whether contrast is highest (points, edges) or lowest (speckle that vanishes in focus)
    std::size_t cell = 1;   ///< side of the squares of samples whose mean intensities show it best; 0: edges do
};

/// How sharp a field is at many depths.
struct FocusSearch {
    static constexpr std::array<std::size_t, 4> cells{1, 2, 4, 8};  ///< sides of squares, samples
    static constexpr std::size_t edges = cells.size();              ///< index of the contrast of edges
    using Contrasts = std::array<double, cells.size() + 1>;

    std::vector<double> depths;  ///< metres behind the hologram, increasing
    /// At each depth the variance of intensities averaged over squares of each size, relative to their mean squared;
    /// the last the same of the squared magnitudes of the field's gradient, which only edges have.
    std::vector<Contrasts> contrasts;
    /// Metres to either side: 2Δ²/λ, that of light at all frequencies of the samples; the least of all fields.
    double depth_of_focus = 0;
    /// The same of the light that there is, 1/(2λB²), where nine tenths of the amplitudes are within frequencies ±B of
    /// their middle; the greatest of all fields.
    double light_depth_of_focus = 0;
    std::vector<FocusPlane> planes;  ///< the planes in focus, the clearest first: the most prominent for their width
};

/// Finds the depths at which fields of one object, its colours, are in focus. Look 0 is propagated as a sum of plane
/// waves to all depths. What is in focus shows as an extremum of the contrast of its intensity, averaged over the
/// fields: a maximum for points and edges, a minimum for rough surfaces whose speckle is reduced there. Squares of
/// several sizes are used, because one sample shows points, and larger ones the surfaces behind speckle. Around sharp
/// extrema depths are sampled more finely. A minimum at depth 0 is not reported: nearly all holograms are more even
/// than what they show. Memory: 8 bytes for each sample that is looked at, and 24 for each sample of a part on each
/// thread. Throws Error(usage) for depths that are not finite, or fewer than 8 planes.
HOGEL_API FocusSearch find_focus(const Fields& fields, const FocusOptions& options = {}, const Progress& progress = {});
HOGEL_API FocusSearch find_focus(const FieldSource& field, const FocusOptions& options = {},
                                 const Progress& progress = {});

}  // namespace hogel
