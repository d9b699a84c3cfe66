// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/sparse_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hogel::exchange {
namespace {

// Maximum parallax, samples per direction, of overlapping windows of `olas`: docs/holograms.md.
constexpr double max_overlap_parallax = 4;
// Wavelength used for all visible light.
constexpr double green = 532e-9;

std::string counts(const LightFieldGrid& grid, const auto& enough) {
    const auto along = [&](std::size_t views, double half) { return views < 2 ? 1.0 : enough(views, half); };
    return fmt::format("{:.0f}x{:.0f}", along(grid.directions_u, grid.half_u()),
                       along(grid.directions_v, grid.half_v()));
}

}  // namespace

std::vector<std::string> sparse_views(const LightFieldGrid& grid, double parallax) {
    const auto in_steps_of = [&](double pixels) {
        return counts(grid, [=](std::size_t views, double) {
            return std::ceil(static_cast<double>(views - 1) * parallax / pixels) + 1;
        });
    };
    const std::string dense = in_steps_of(1);
    std::vector<std::string> lines;
    lines.push_back(fmt::format(
        "views are sparse: points jump by up to {:.2g} hogels from a view to the next; {} views over the same angle "
        "would suffice, {:.0f} times as many each way",
        parallax, dense, std::ceil(parallax)));
    const std::string overlapping = parallax <= max_overlap_parallax
                                        ? std::string("these do")
                                        : fmt::format("side lobes below {}", in_steps_of(max_overlap_parallax));
    const double step = green / grid.pitch;
    const bool enough = std::max(grid.step_u(), grid.directions_v > 1 ? grid.step_v() : 0.0) <= step;
    lines.push_back(fmt::format(
        "effects by method: fourier, basis, lines and photographs blur or double points off the hologram by up to "
        "{:.2g} hogels below {}; olas, with hogels of one sample: {}; phase-added: {}",
        parallax, dense, overlapping,
        enough ? std::string("these do")
               : fmt::format("refuses fewer than {} at {:.0f} nm",
                             counts(grid, [&](std::size_t, double half) { return std::ceil(2 * half / step); }),
                             green * 1e9)));
    return lines;
}

}  // namespace hogel::exchange
