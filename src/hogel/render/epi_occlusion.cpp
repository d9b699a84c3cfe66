#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi_occlusion_internal.h"

namespace hogel {
namespace {

// Of so many columns the farthest are taken together to ask about boxes.
constexpr std::size_t group = 8;

std::size_t groups_of(const EpipolarPlane& plane) { return (plane.columns + group - 1) / group; }

}  // namespace

void Occlusion::clear(const EpipolarPlane& plane) {
    plane.cells->clear(plane.columns, plane.directions);
    worth_asking_ = false;
}

void Occlusion::update(const EpipolarPlane& plane) {
    find_farthest(plane);
    cells_.clear();
    for (std::size_t row = 0; row < PlaneCells::rows(plane.directions); ++row)
        for (std::size_t first = 0; first < plane.columns; first += group) {
            const std::uint32_t* cell = plane.cells->farthest.data() + row * plane.columns + first;
            const std::size_t count = std::min(group, plane.columns - first);
            std::uint32_t most = 0;
            for (std::size_t i = 0; i < count; ++i) most = std::max(most, cell[i]);
            cells_.push_back(most);
        }
    // Objects that stand alone hide too little to pay for the asking.
    constexpr std::uint32_t open = ordered_bits(std::numeric_limits<float>::infinity());
    const auto covered = std::count_if(cells_.begin(), cells_.end(), [](std::uint32_t cell) { return cell < open; });
    worth_asking_ = 4 * static_cast<std::size_t>(covered) >= cells_.size();
}

bool Occlusion::hides(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0) const {
    if (!worth_asking_) return false;
    const double x_low = box.x_low + shift, x_high = box.x_high + shift;
    const double z_low = box.z_low - z0, z_high = box.z_high - z0;
    // Depths of strips are rounded to single precision, and may be differences of larger numbers; this is beyond any
    // rounding.
    const auto nearest = static_cast<float>(z_low - 1e-6 * std::abs(z_low) - 1e-12 * std::abs(z0));
    const std::uint32_t near_bits = ordered_bits(nearest);
    const double first = plane.first_column, last = first + static_cast<double>(plane.columns) - 1;
    for (std::size_t k = 0; k < plane.directions; k += cell_directions) {
        // The columns that see the box in the cell's directions, and one more on either side for rounding.
        const double Ka = static_cast<double>(plane.first_direction) + static_cast<double>(k);
        const double Kb = Ka + static_cast<double>(std::min(cell_directions, plane.directions - k) - 1);
        const auto [least, most] = std::minmax({Ka * z_low, Ka * z_high, Kb * z_low, Kb * z_high});
        const double n_low = std::max(first, std::floor(x_low - most) - 1);
        const double n_high = std::min(last, std::ceil(x_high - least) + 1);
        if (!(n_low <= n_high)) continue;
        const auto begin = static_cast<std::size_t>(n_low - first) / group;
        const auto end = static_cast<std::size_t>(n_high - first) / group;
        const std::uint32_t* cells = cells_.data() + k / cell_directions * groups_of(plane);
        for (std::size_t cell = begin; cell <= end; ++cell)
            if (cells[cell] >= near_bits) return false;
    }
    return true;
}

}  // namespace hogel
