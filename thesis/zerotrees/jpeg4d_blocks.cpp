// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "hogel/error.h"
#include "thesis/wavelets/dct.h"
#include "thesis/zerotrees/jpeg4d_blocks.h"

namespace hogel::zerotrees {
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
    for (std::size_t axis = 0; axis < axes; ++axis) count *= wavelets::dct_block;
    std::vector<Frequency> order;
    for (std::size_t i = 0; i < count; ++i) {
        Frequency frequency(axes);
        for (std::size_t axis = axes, rest = i; axis-- > 0; rest /= wavelets::dct_block)
            frequency[axis] = rest % wavelets::dct_block;
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

std::size_t index_in_block(const Frequency& frequency) {
    std::size_t position = 0;
    for (const std::size_t frequency_along_axis : frequency)
        position = position * wavelets::dct_block + frequency_along_axis;
    return position;
}

double table_entry(const Frequency& frequency) {
    double entry = 1;
    for (std::size_t axis = 0; axis < frequency.size(); axis += 2)
        entry *= axis + 1 < frequency.size() ? luminance[frequency[axis]][frequency[axis + 1]]
                                             : luminance[0][frequency[axis]];
    return entry;
}

Quantisation jpegs_quantisation(double scale, std::size_t axes) {
    const std::vector<Frequency> order = zigzag(axes);
    Quantisation quantisation{std::vector<double>(order.size()), 0.5};
    for (const Frequency& frequency : order)
        quantisation.steps[index_in_block(frequency)] = scale * table_entry(frequency);
    return quantisation;
}

std::vector<std::vector<float>> min_values(const Blocks& blocks, const Quantisation& quantisation) {
    std::vector<std::vector<float>> min_magnitudes;
    for (const Blocks::Kind& kind : blocks.kinds()) {
        min_magnitudes.emplace_back();
        for (const std::uint16_t full_index : kind.full_index)
            min_magnitudes.back().push_back(quantisation.min_magnitude(full_index));
    }
    return min_magnitudes;
}

void quantise_block(const Blocks::Kind& kind, const float* block, std::span<const float> min_magnitudes,
                    const Quantisation& quantisation, SparseLevels& levels) {
    levels.clear();
    for_each_large(kind, block, min_magnitudes, [&](std::size_t entry, float value) {
        const std::int32_t level = quantisation.level(value, kind.full_index[entry]);
        if (level != 0) levels.set(kind.position[entry], level);
    });
}

Blocks::Blocks(const wavelets::Pyramid& pyramid) : shape_(pyramid.shape()), strides_(pyramid.strides()) {
    for (const wavelets::AxisGroup& group : pyramid.groups())
        axes_.insert(axes_.end(), group.axes.begin(), group.axes.end());
    std::sort(axes_.begin(), axes_.end());
    if (axes_.size() > 4)
        throw Error(ErrorCode::usage, fmt::format("jpeg4d: {} transformed axes, expected at most 4", axes_.size()));
    grid_ = shape_;
    bit_of_axis_.assign(shape_.size(), 0);
    for (std::size_t a = 0; a < axes_.size(); ++a) {
        grid_[axes_[a]] = (shape_[axes_[a]] + wavelets::dct_block - 1) / wavelets::dct_block;
        bit_of_axis_[axes_[a]] = std::size_t{1} << a;
    }
    for (std::size_t blocks : grid_) count_ *= blocks;
    const std::vector<Frequency> order = zigzag(axes_.size());
    for (std::size_t bits = 0; bits < std::size_t{1} << axes_.size(); ++bits) {
        std::vector<std::size_t> extents;
        bool exists = true;
        for (const std::size_t axis : axes_) {
            const bool shorter = (bits & bit_of_axis_[axis]) != 0;
            extents.push_back(shorter ? shape_[axis] % wavelets::dct_block : wavelets::dct_block);
            exists = exists && extents.back() > 0 && extents.back() <= shape_[axis];
        }
        kinds_.push_back(exists ? make_kind(extents, order) : Kind{});
    }
}

Blocks::Kind Blocks::make_kind(const std::vector<std::size_t>& extents, const std::vector<Frequency>& order) const {
    std::size_t entries = 1;
    for (const std::size_t extent : extents) entries *= extent;
    Kind kind;
    kind.offsets.resize(entries);
    for (std::vector<std::uint16_t>* list : {&kind.position, &kind.entry, &kind.full_index}) list->resize(entries);
    if (!axes_.empty() && strides_[axes_.back()] == 1) kind.run = extents.back();
    std::uint16_t position = 0;
    for (const Frequency& frequency : order) {
        std::size_t entry = 0, offset = 0;
        Frequency comparable;
        bool inside = true;
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            inside = inside && frequency[a] < extents[a];
            entry = entry * extents[a] + frequency[a];
            offset += frequency[a] * strides_[axes_[a]];
            comparable.push_back(comparable_frequency(frequency[a], extents[a]));
        }
        if (!inside) continue;
        kind.offsets[entry] = offset;
        kind.full_index[entry] = static_cast<std::uint16_t>(index_in_block(comparable));
        kind.position[entry] = position;
        kind.entry[position++] = static_cast<std::uint16_t>(entry);
    }
    return kind;
}

Blocks::Block Blocks::operator[](std::size_t number) const {
    Block block{0, 0};
    for (std::size_t axis = shape_.size(); axis-- > 0; number /= grid_[axis]) {
        const std::size_t side = bit_of_axis_[axis] > 0 ? wavelets::dct_block : 1, first = number % grid_[axis] * side;
        block.origin += first * strides_[axis];
        if (first + side > shape_[axis]) block.kind += bit_of_axis_[axis];
    }
    return block;
}

std::vector<Frequency> Blocks::frequencies() const {
    std::vector<Frequency> result = zigzag(axes_.size());
    std::erase_if(result, [&](const Frequency& frequency) {
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            const std::size_t n = std::min(shape_[axes_[a]], wavelets::dct_block);
            if (frequency[a] > comparable_frequency(n - 1, n)) return true;
        }
        return false;
    });
    return result;
}

}  // namespace hogel::zerotrees
