#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "hogel/coding/jpeg4d_internal.h"
#include "hogel/core/error.h"
#include "hogel/transform/dct.h"

namespace hogel {
namespace {

// ISO 10918-1 (JPEG), table K.1.
constexpr std::array<std::array<int, 8>, 8> luminance{{{16, 11, 10, 16, 24, 40, 51, 61},
                                                       {12, 12, 14, 19, 26, 58, 60, 55},
                                                       {14, 13, 16, 24, 40, 57, 69, 56},
                                                       {14, 17, 22, 29, 51, 87, 80, 62},
                                                       {18, 22, 37, 56, 68, 109, 103, 77},
                                                       {24, 35, 55, 64, 81, 104, 113, 92},
                                                       {49, 64, 78, 87, 103, 121, 120, 101},
                                                       {72, 92, 95, 98, 112, 100, 103, 99}}};

}  // namespace

std::vector<Frequency> zigzag(std::size_t axes) {
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < axes; ++axis) count *= dct_block;
    std::vector<Frequency> order;
    for (std::size_t i = 0; i < count; ++i) {
        Frequency frequency(axes);
        for (std::size_t axis = axes, rest = i; axis-- > 0; rest /= dct_block) frequency[axis] = rest % dct_block;
        order.push_back(frequency);
    }
    std::sort(order.begin(), order.end(), [](const Frequency& a, const Frequency& b) {
        const std::size_t sum_a = std::accumulate(a.begin(), a.end(), std::size_t{0});
        const std::size_t sum_b = std::accumulate(b.begin(), b.end(), std::size_t{0});
        if (sum_a != sum_b) return sum_a < sum_b;
        return sum_a % 2 == 0 ? b < a : a < b;
    });
    return order;
}

double table_entry(const Frequency& frequency) {
    double entry = 1;
    for (std::size_t axis = 0; axis < frequency.size(); axis += 2)
        entry *= axis + 1 < frequency.size() ? luminance[frequency[axis]][frequency[axis + 1]]
                                             : luminance[0][frequency[axis]];
    return entry;
}

BlockSymbols block_symbols(std::span<const std::int32_t> levels) {
    BlockSymbols symbols;
    std::size_t end = levels.size();
    while (end > 0 && levels[end - 1] == 0) --end;
    int zeros = 0;
    for (std::int32_t level : levels.first(end)) {
        if (level == 0) {
            ++zeros;
            continue;
        }
        for (; zeros > z_max; zeros -= z_max) symbols.tuples.push_back({z_max, 0});
        symbols.tuples.push_back(
            {zeros, static_cast<int>(std::bit_width(static_cast<std::uint32_t>(std::abs(level))))});
        symbols.levels.push_back(level);
        zeros = 0;
    }
    if (end < levels.size()) symbols.tuples.push_back({0, 0});
    return symbols;
}

Blocks::Blocks(const Pyramid& pyramid) : shape_(pyramid.shape()), strides_(pyramid.strides()) {
    for (const AxisGroup& group : pyramid.groups()) axes_.insert(axes_.end(), group.axes.begin(), group.axes.end());
    std::sort(axes_.begin(), axes_.end());
    if (axes_.size() > 4)
        throw Error(ErrorCode::usage, fmt::format("jpeg4d: {} transformed axes, expected at most 4", axes_.size()));
    grid_ = shape_;
    for (std::size_t axis : axes_) grid_[axis] = (shape_[axis] + dct_block - 1) / dct_block;
    for (std::size_t blocks : grid_) count_ *= blocks;
    order_ = zigzag(axes_.size());
}

void Blocks::get(std::size_t number, Block& block) const {
    std::vector<std::size_t> extent(axes_.size());
    std::size_t origin = 0;
    for (std::size_t axis = shape_.size(); axis-- > 0; number /= grid_[axis]) {
        const auto found = std::find(axes_.begin(), axes_.end(), axis);
        const std::size_t first = number % grid_[axis] * (found == axes_.end() ? 1 : dct_block);
        origin += first * strides_[axis];
        if (found != axes_.end())
            extent[static_cast<std::size_t>(found - axes_.begin())] = std::min(dct_block, shape_[axis] - first);
    }
    block.offsets.clear();
    block.table.clear();
    Frequency comparable(axes_.size());
    for (const Frequency& frequency : order_) {
        std::size_t offset = origin;
        bool inside = true;
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            inside = inside && frequency[a] < extent[a];
            offset += frequency[a] * strides_[axes_[a]];
            // Frequency k of n points oscillates as 8k/n of eight do.
            comparable[a] = std::min(frequency[a] * dct_block / std::max<std::size_t>(extent[a], 1), dct_block - 1);
        }
        if (!inside) continue;
        block.offsets.push_back(offset);
        block.table.push_back(table_entry(comparable));
    }
}

}  // namespace hogel
