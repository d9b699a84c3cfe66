// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi/occlusion.h"

namespace hogel::render::epi {

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

BoxBounds::BoxBounds(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0)
    : x_low(static_cast<float>(box.x_low + shift)),
      x_high(static_cast<float>(box.x_high + shift)),
      z_low(static_cast<float>(box.z_low - z0)),
      z_high(static_cast<float>(box.z_high - z0)) {
    const double depth = box.z_low - z0;
    // Depths of strips are rounded to single precision, and may be differences of larger numbers; this is beyond any
    // rounding.
    nearest = ordered_bits(static_cast<float>(depth - 1e-6 * std::abs(depth) - 1e-12 * std::abs(z0)));
    const double steepest =
        1 + std::abs(static_cast<double>(plane.first_direction)) + static_cast<double>(plane.directions);
    const double reach = std::max(std::abs(box.x_low + shift), std::abs(box.x_high + shift)) + std::abs(shift) +
                         steepest * (std::max(std::abs(depth), std::abs(box.z_high - z0)) + 1e-6 * std::abs(z0));
    margin = static_cast<float>(1e-6 * reach);
}

void SeenBoxes::begin_row(std::span<const ClusterBox> boxes, const EpipolarPlane& plane, double shift, double z0) {
    boxes_ = boxes;
    plane_ = &plane;
    shift_ = shift;
    z0_ = z0;
    ++row_;
    lines_ = CellColumns::lines(plane.directions);
    columns_.resize(boxes.size() * lines_);
    known_.resize(boxes.size());
}

BoxDepth see_box_plain(const ClusterBox& cluster, const EpipolarPlane& plane, double shift, double z0,
                       CellColumns* columns) {
    const auto first = static_cast<float>(plane.first_column);
    const float last = first + static_cast<float>(plane.columns) - 1;
    const float K_last = plane.first_direction + static_cast<float>(plane.directions) - 1;
    std::fill_n(columns, CellColumns::lines(plane.directions), CellColumns{});
    const BoxBounds box(cluster, plane, shift, z0);
    std::uint16_t widest = 0;
    for (std::size_t row = 0; row < PlaneCells::rows(plane.directions); ++row) {
        // The columns that see the box in the cells' directions.
        const float Ka = plane.first_direction + static_cast<float>(row * cell_directions);
        const float Kb = std::min(K_last, Ka + static_cast<float>(cell_directions - 1));
        const auto [least, most] = std::minmax({Ka * box.z_low, Ka * box.z_high, Kb * box.z_low, Kb * box.z_high});
        const float begin = std::max(first, std::ceil((box.x_low - most) - box.margin));
        const float end = std::min(last, std::floor((box.x_high - least) + box.margin));
        if (!(begin <= end)) continue;
        CellColumns& line = columns[row / CellColumns::rows];
        line.first[row % CellColumns::rows] = static_cast<std::uint16_t>(begin - first);
        widest = std::max(widest, line.count[row % CellColumns::rows] = static_cast<std::uint16_t>(end - begin + 1));
    }
    return {box.nearest, widest};
}

bool cells_hide_plain(const EpipolarPlane& plane, const SeenBox& box) {
    for (std::size_t row = 0; row < PlaneCells::rows(plane.directions); ++row) {
        const CellColumns& line = box.columns[row / CellColumns::rows];
        const std::uint32_t* cells =
            plane.cells->farthest.data() + row * plane.columns + line.first[row % CellColumns::rows];
        for (std::size_t i = 0; i < line.count[row % CellColumns::rows]; ++i)
            if (cells[i] >= box.depth.nearest) return false;
    }
    return true;
}

}  // namespace hogel::render::epi
