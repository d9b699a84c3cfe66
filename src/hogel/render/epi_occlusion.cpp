#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi_occlusion_internal.h"

namespace hogel {

void Occlusion::clear(const EpipolarPlane& plane) {
    plane.cells->clear(plane.columns, plane.directions);
    worth_asking_ = false;
}

void Occlusion::update(const EpipolarPlane& plane) {
    find_farthest(plane);
    // Objects that stand alone hide too little to pay for the asking.
    constexpr std::uint32_t open = ordered_bits(std::numeric_limits<float>::infinity());
    const std::span cells(plane.cells->farthest.data(), plane.columns * PlaneCells::rows(plane.directions));
    const auto covered = std::ranges::count_if(cells, [](std::uint32_t cell) { return cell < open; });
    worth_asking_ = 4 * static_cast<std::size_t>(covered) >= cells.size();
}

bool Occlusion::hides(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0) const {
    if (!worth_asking_) return false;
    const double z_low = box.z_low - z0, z_high = box.z_high - z0;
    const double x_low = box.x_low + shift, x_high = box.x_high + shift;
    // Depths of strips are rounded to single precision, and may be differences of larger numbers; this is beyond any
    // rounding.
    const auto nearest = static_cast<float>(z_low - 1e-6 * std::abs(z_low) - 1e-12 * std::abs(z0));
    const double steepest =
        1 + std::abs(static_cast<double>(plane.first_direction)) + static_cast<double>(plane.directions);
    const double reach = std::max(std::abs(x_low), std::abs(x_high)) + std::abs(shift) +
                         steepest * (std::max(std::abs(z_low), std::abs(z_high)) + 1e-6 * std::abs(z0));
    return cells_hide(plane, {static_cast<float>(x_low), static_cast<float>(x_high), static_cast<float>(z_low),
                              static_cast<float>(z_high), static_cast<float>(1e-6 * reach), ordered_bits(nearest)});
}

bool cells_hide_plain(const EpipolarPlane& plane, const SeenBox& box) {
    const auto first = static_cast<float>(plane.first_column);
    const float last = first + static_cast<float>(plane.columns) - 1;
    const float K_last = plane.first_direction + static_cast<float>(plane.directions) - 1;
    for (std::size_t row = 0; row < PlaneCells::rows(plane.directions); ++row) {
        // The columns that see the box in the cells' directions.
        const float Ka = plane.first_direction + static_cast<float>(row * cell_directions);
        const float Kb = std::min(K_last, Ka + static_cast<float>(cell_directions - 1));
        const auto [least, most] = std::minmax({Ka * box.z_low, Ka * box.z_high, Kb * box.z_low, Kb * box.z_high});
        const float begin = std::max(first, std::ceil((box.x_low - most) - box.margin));
        const float end = std::min(last, std::floor((box.x_high - least) + box.margin));
        for (float n = begin; n <= end; ++n)
            if (plane.cells->farthest[row * plane.columns + static_cast<std::size_t>(n - first)] >= box.nearest)
                return false;
    }
    return true;
}

}  // namespace hogel
