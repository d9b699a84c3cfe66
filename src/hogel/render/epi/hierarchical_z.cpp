// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/hierarchical_z.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hogel::render::epi {

void HierarchicalZ::clear(const EpipolarPlane& plane) {
    plane.cells->clear(plane.columns, plane.directions);
    pays_ = false;
}

void HierarchicalZ::update(const EpipolarPlane& plane) {
    find_max_depths(plane);
    // Isolated objects occlude too little to justify the tests.
    constexpr std::uint32_t open = ordered_bits(std::numeric_limits<float>::infinity());
    const std::span cells(plane.cells->max_depth.data(), plane.columns * DepthCells::rows(plane.directions));
    const auto covered = std::ranges::count_if(cells, [](std::uint32_t cell) { return cell < open; });
    pays_ = 4 * static_cast<std::size_t>(covered) >= cells.size();
}

BoxBounds::BoxBounds(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0)
    : x_low(static_cast<float>(box.x_low + shift)),
      x_high(static_cast<float>(box.x_high + shift)),
      z_low(static_cast<float>(box.z_low - z0)),
      z_high(static_cast<float>(box.z_high - z0)) {
    const double depth = box.z_low - z0;
    // The margin exceeds the rounding error of span depths, which may be differences of larger numbers.
    min_depth = ordered_bits(static_cast<float>(depth - 1e-6 * std::abs(depth) - 1e-12 * std::abs(z0)));
    const double max_K =
        1 + std::abs(static_cast<double>(plane.first_direction)) + static_cast<double>(plane.directions);
    const double max_z = std::max(std::abs(depth), std::abs(box.z_high - z0)) + 1e-6 * std::abs(z0);
    const double size =
        std::max(std::abs(box.x_low + shift), std::abs(box.x_high + shift)) + std::abs(shift) + max_K * max_z;
    margin = static_cast<float>(1e-6 * size);
}

void BoxFootprints::begin_row(std::span<const ClusterBox> boxes, const EpipolarPlane& plane, double shift, double z0) {
    boxes_ = boxes;
    plane_ = &plane;
    shift_ = shift;
    z0_ = z0;
    ++row_;
    columns_per_box_ = CellColumns::needed(plane.directions);
    columns_.resize(boxes.size() * columns_per_box_);
    found_.resize(boxes.size());
}

FootprintBounds find_footprint_plain(const ClusterBox& cluster, const EpipolarPlane& plane, double shift, double z0,
                                     CellColumns* columns) {
    const auto first = static_cast<float>(plane.first_column);
    const float last = first + static_cast<float>(plane.columns) - 1;
    const float K_last = plane.first_direction + static_cast<float>(plane.directions) - 1;
    std::fill_n(columns, CellColumns::needed(plane.directions), CellColumns{});
    const BoxBounds box(cluster, plane, shift, z0);
    std::uint16_t max_columns = 0;
    for (std::size_t row = 0; row < DepthCells::rows(plane.directions); ++row) {
        // Columns that see the box in some direction of the row.
        const float Ka = plane.first_direction + static_cast<float>(row * directions_per_cell);
        const float Kb = std::min(K_last, Ka + static_cast<float>(directions_per_cell - 1));
        const auto [min_Kz, max_Kz] = std::minmax({Ka * box.z_low, Ka * box.z_high, Kb * box.z_low, Kb * box.z_high});
        const float begin = std::max(first, std::ceil((box.x_low - max_Kz) - box.margin));
        const float end = std::min(last, std::floor((box.x_high - min_Kz) + box.margin));
        if (!(begin <= end)) continue;
        CellColumns& row_columns = columns[row / CellColumns::rows];
        const std::size_t i = row % CellColumns::rows;
        row_columns.first[i] = static_cast<std::uint16_t>(begin - first);
        row_columns.count[i] = static_cast<std::uint16_t>(end - begin + 1);
        max_columns = std::max(max_columns, row_columns.count[i]);
    }
    return {box.min_depth, max_columns};
}

bool cells_occlude_plain(const EpipolarPlane& plane, const BoxFootprint& box) {
    for (std::size_t row = 0; row < DepthCells::rows(plane.directions); ++row) {
        const CellColumns& columns = box.columns[row / CellColumns::rows];
        const std::size_t i = row % CellColumns::rows;
        const std::uint32_t* cells = plane.cells->max_depth.data() + row * plane.columns + columns.first[i];
        for (std::size_t k = 0; k < columns.count[i]; ++k)
            if (cells[k] >= box.bounds.min_depth) return false;
    }
    return true;
}

}  // namespace hogel::render::epi
