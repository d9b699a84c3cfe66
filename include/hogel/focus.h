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
    /// Range of depths to search, metres behind the hologram (negative: in front). Equal values: ±N Δ²/λ, where samples
    /// and size of the field resolve alike, extended up to eight times if no plane stands out.
    double from = 0, to = 0;
    std::size_t planes = 0;  ///< number of depths; 0: one per depth of focus
    /// Size of the examined region in the middle of each field, samples; at most the field. 0: at most max_side.
    std::size_t width = 0, height = 0;
    std::size_t max_side = 1024;  ///< largest side of an examined part, samples; a larger region is divided into parts
};

/// Returns the region of a field that find_focus() examines.
HOGEL_API Region focus_region(const FieldGrid& grid, const FocusOptions& options);

/// A plane in focus.
struct FocusPlane {
    double depth = 0;  ///< metres behind the hologram
    /// Height of the extremum of log contrast above the nearer of the two neighbouring extrema.
    double prominence = 0;
    /// true: highest contrast (points, edges); false: lowest contrast (speckle that vanishes in focus).
    bool brightest = true;
    std::size_t cell = 1;  ///< side of the squares of samples that show the extremum best; 0: contrast of edges
};

/// The sharpness of a field at many depths.
struct FocusSearch {
    static constexpr std::array<std::size_t, 4> cells{1, 2, 4, 8};  ///< sides of squares, samples
    static constexpr std::size_t edges = cells.size();              ///< index of the contrast of edges
    using Contrasts = std::array<double, cells.size() + 1>;

    std::vector<double> depths;  ///< metres behind the hologram, increasing
    /// At each depth the variance of intensities, averaged over squares of each size, relative to their mean squared.
    /// The last element is the same for the squared magnitude of the field's gradient, which only edges have.
    std::vector<Contrasts> contrasts;
    /// Depth of focus of light at all frequencies of the samples, ±2Δ²/λ, metres; the smallest of all fields.
    double depth_of_focus = 0;
    /// Depth of focus of the actual light, ±1/(2λB²), metres; the largest of all fields. 90 % of amplitudes are within
    /// ±B.
    double light_depth_of_focus = 0;
    std::vector<FocusPlane> planes;  ///< the clearest first: highest prominence relative to width
};

/// Finds the depths at which fields of one object, such as its colours, are in focus. It propagates look 0 as a sum of
/// plane waves to all depths. A plane in focus is an extremum of intensity contrast, averaged over the fields: a
/// maximum for points and edges, a minimum for rough surfaces with less speckle there. Contrast is computed on squares
/// of several sizes: single samples show points, larger squares show surfaces behind speckle. Depths near sharp extrema
/// are sampled more finely. A minimum at depth 0 is not reported, because nearly all holograms are more uniform than
/// their objects. Memory: 8 bytes per examined sample, and 24 bytes per sample of a part on each thread. Throws
/// Error(usage) for depths that are not finite, or fewer than 8 planes.
HOGEL_API FocusSearch find_focus(const Fields& fields, const FocusOptions& options = {}, const Progress& progress = {});
HOGEL_API FocusSearch find_focus(const FieldSource& field, const FocusOptions& options = {},
                                 const Progress& progress = {});

}  // namespace hogel
