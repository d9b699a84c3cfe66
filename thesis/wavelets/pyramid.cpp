// SPDX-License-Identifier: Apache-2.0
#include "thesis/wavelets/pyramid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "hogel/error.h"

namespace hogel::wavelets {
namespace {

int chosen_levels(const std::vector<std::size_t>& shape, const std::vector<std::size_t>& axes) {
    std::size_t longest = 1;
    for (std::size_t axis : axes)
        if (axis < shape.size()) longest = std::max(longest, shape[axis]);
    // The longest axis keeps at least two coarse samples if it has four.
    return longest < 4 ? static_cast<int>(longest > 1) : std::bit_width(longest) - 2;
}

}  // namespace

Pyramid::Pyramid(std::vector<std::size_t> shape, std::vector<AxisGroup> groups)
    : shape_(std::move(shape)), groups_(std::move(groups)) {
    if (shape_.empty()) throw Error(ErrorCode::usage, "pyramid: an array without dimensions cannot be transformed");
    std::size_t elements = 1;
    for (std::size_t extent : shape_) {
        if (extent == 0) throw Error(ErrorCode::usage, "pyramid: an array without elements cannot be transformed");
        constexpr std::size_t max_elements = std::size_t{1} << 40;
        if (extent > max_elements / elements)
            throw Error(ErrorCode::usage, "pyramid: the array has more than 2^40 elements; expected smaller tiles");
        elements *= extent;
    }
    std::vector<bool> taken(shape_.size());
    for (const AxisGroup& group : groups_) {
        if (group.levels < 0 || group.levels > 62)
            throw Error(ErrorCode::usage, fmt::format("pyramid: {} levels, expected 0 to 62", group.levels));
        for (std::size_t axis : group.axes) {
            if (axis >= shape_.size() || taken[axis])
                throw Error(ErrorCode::usage, fmt::format("pyramid: axis {} is in two groups or is none of the {} axes",
                                                          axis, shape_.size()));
            taken[axis] = true;
        }
    }
}

Pyramid Pyramid::interleaved(const std::vector<std::size_t>& shape) {
    std::vector<std::size_t> axes(shape.size());
    for (std::size_t axis = 0; axis < axes.size(); ++axis) axes[axis] = axis;
    return separate(shape, {axes});
}

Pyramid Pyramid::separate(const std::vector<std::size_t>& shape, const std::vector<std::vector<std::size_t>>& axes) {
    std::vector<AxisGroup> groups;
    for (const std::vector<std::size_t>& list : axes) groups.push_back({list, chosen_levels(shape, list)});
    return {shape, groups};
}

std::size_t Pyramid::size() const {
    std::size_t elements = 1;
    for (std::size_t extent : shape_) elements *= extent;
    return elements;
}

std::vector<std::size_t> Pyramid::strides() const {
    std::vector<std::size_t> result(shape_.size(), 1);
    for (std::size_t axis = shape_.size() - 1; axis-- > 0;) result[axis] = result[axis + 1] * shape_[axis + 1];
    return result;
}

std::size_t Pyramid::coarse_extent(std::size_t axis, int level) const { return ((shape_[axis] - 1) >> level) + 1; }

}  // namespace hogel::wavelets
