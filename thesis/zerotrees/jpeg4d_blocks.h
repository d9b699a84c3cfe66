// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "thesis/wavelets/dct.h"
#include "thesis/wavelets/pyramid.h"

namespace hogel::zerotrees {

// Entry of a block: its frequency along each transformed axis.
using Frequency = std::vector<std::size_t>;

// All frequencies of a block of 8 along each of `axes` axes in the zigzag order of [K] fig. 4.14, generalised to any
// number of dimensions: by the sum of the frequencies, in alternating directions for each sum. In 2D it is JPEG's.
std::vector<Frequency> zigzag(std::size_t axes);

// Returns the index of a frequency in a block of 8 along each axis, row-major.
std::size_t index_in_block(const Frequency& frequency);

// Returns an entry of JPEG's table: for two axes [K] fig. 4.13 (JPEG's example for luminance), for four axes the outer
// product of the table with itself. An odd last axis has the table's first row.
double table_entry(const Frequency& frequency);

// Blocks of an array. Blocks of equal extents are of one kind. Entries of a block are in row-major order.
class Blocks {
  public:
    struct Kind {
        std::vector<std::size_t> offsets;       // offsets of the entries in the array, from the first entry
        std::size_t run = 1;                    // number of entries that are contiguous in memory
        std::vector<std::uint16_t> position;    // [entry]: position in zigzag order
        std::vector<std::uint16_t> entry;       // [position in zigzag order]: entry
        std::vector<std::uint16_t> full_index;  // [entry]: index_in_block() of the comparable frequency
    };
    struct Block {
        std::size_t origin;  // offset of its first entry
        std::size_t kind;
    };

    explicit Blocks(const wavelets::Pyramid& pyramid);
    std::size_t count() const { return count_; }
    Block operator[](std::size_t number) const;
    // Kinds without blocks are empty.
    std::span<const Kind> kinds() const { return kinds_; }
    const Kind& kind(const Block& block) const { return kinds_[block.kind]; }
    // Returns the frequencies of a full block that occur in blocks of this array, in zigzag order.
    std::vector<Frequency> frequencies() const;
    std::size_t axes() const { return axes_.size(); }

  private:
    Kind make_kind(const std::vector<std::size_t>& extents, const std::vector<Frequency>& order) const;

    std::vector<std::size_t> shape_, strides_, axes_, grid_;  // grid_: blocks along each axis
    std::vector<std::size_t> bit_of_axis_;  // [axis]: bit in the index of the kind that marks blocks shorter along it
    std::vector<Kind> kinds_;
    std::size_t count_ = 1;
};

// Frequency k of n points is comparable with frequency 8k/n of eight.
constexpr std::size_t comparable_frequency(std::size_t k, std::size_t n) { return k * wavelets::dct_block / n; }

// Steps of the frequencies of a full block by index_in_block(), and the smallest fraction of a step that is rounded up.
struct Quantisation {
    std::vector<double> steps;
    double round_up;

    std::int32_t level(float value, std::size_t full_index) const {
        const auto magnitude = static_cast<std::int32_t>(std::abs(value) / steps[full_index] + (1 - round_up));
        return value < 0 ? -magnitude : magnitude;
    }
    // Returns the smallest magnitude with a nonzero level at an entry of a block.
    float min_magnitude(std::size_t full_index) const {
        constexpr double max_float = std::numeric_limits<float>::max();
        return static_cast<float>(std::min(round_up * (1 - 1e-6) * steps[full_index], max_float));
    }
};

Quantisation jpegs_quantisation(double scale, std::size_t axes);

// Calls visit(entry, value) for the values of a block with at least `min_magnitudes`, entry by entry.
template <class Visit>
void for_each_large(const Blocks::Kind& kind, const float* block, std::span<const float> min_magnitudes,
                    Visit&& visit) {
    for (std::size_t first = 0; first < kind.offsets.size(); first += kind.run) {
        const float* in = block + kind.offsets[first];
        const float* bound = &min_magnitudes[first];
        bool any = false;
        if (kind.run == wavelets::dct_block) {
            for (std::size_t i = 0; i < wavelets::dct_block; ++i) any |= std::abs(in[i]) >= bound[i];
            if (!any) continue;
        }
        for (std::size_t i = 0; i < kind.run; ++i)
            if (std::abs(in[i]) >= bound[i]) visit(first + i, in[i]);
    }
}

// Returns Quantisation::min_magnitude() of each entry, for each kind of block.
std::vector<std::vector<float>> min_values(const Blocks& blocks, const Quantisation& quantisation);

// Nonzero levels of a block, by position in zigzag order.
class SparseLevels {
  public:
    void clear() { used_ = {}; }
    void set(std::size_t position, std::int32_t level) {
        used_[position / 64] |= std::uint64_t{1} << position % 64;
        levels_[position] = level;
    }
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (std::size_t word = 0; word < used_.size(); ++word)
            for (std::uint64_t left = used_[word]; left != 0; left &= left - 1) {
                const std::size_t position = word * 64 + static_cast<std::size_t>(std::countr_zero(left));
                visit(position, levels_[position]);
            }
    }

  private:
    static constexpr std::size_t max_levels =
        wavelets::dct_block * wavelets::dct_block * wavelets::dct_block * wavelets::dct_block;
    std::array<std::uint64_t, max_levels / 64> used_{};
    std::array<std::int32_t, max_levels> levels_;
};

void quantise_block(const Blocks::Kind& kind, const float* block, std::span<const float> min_magnitudes,
                    const Quantisation& quantisation, SparseLevels& levels);

constexpr int z_max = 31;
struct Tuple {
    int zeros, bits;
    std::size_t symbol() const {
        return static_cast<std::size_t>(bits) * (z_max + 1) + static_cast<std::size_t>(zeros);
    }
    bool operator==(const Tuple&) const = default;
};

// Calls visit(tuple, level) for the tuples of a block of `count` entries; the level is 0 for tuples without bits.
template <class Visit>
void for_each_tuple(const SparseLevels& levels, std::size_t count, Visit&& visit) {
    std::size_t next = 0;
    levels.for_each([&](std::size_t position, std::int32_t level) {
        std::size_t zeros = position - next;
        for (; zeros > z_max; zeros -= z_max) visit(Tuple{z_max, 0}, 0);
        const int bits = std::bit_width(static_cast<std::uint32_t>(std::abs(level)));
        visit(Tuple{static_cast<int>(zeros), bits}, level);
        next = position + 1;
    });
    if (next < count) visit(Tuple{0, 0}, 0);
}

}  // namespace hogel::zerotrees
