#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/transform/pyramid.h"

namespace hogel {

// An entry of a block: its frequency along each transformed axis.
using Frequency = std::vector<std::size_t>;

// All frequencies of a block of 8 along each of `axes` axes, in the zigzag of [K] fig. 4.14 carried to any dimensions:
// by the sum of the frequencies, and in alternating directions within a sum. In 2D it is JPEG's.
std::vector<Frequency> zigzag(std::size_t axes);

// [K] fig. 4.13 (JPEG's example for luminance) for two axes; for four, the outer product of two copies, the first for
// the first two axes. An odd last axis has the table's first row.
double table_entry(const Frequency& frequency);

constexpr int z_max = 31;
struct Tuple {
    int zeros, bits;
    bool operator==(const Tuple&) const = default;
};

// The tuples of a block whose levels stand in zigzag order, and for each with bits > 0 the level that follows it.
struct BlockSymbols {
    std::vector<Tuple> tuples;
    std::vector<std::int32_t> levels;
};
BlockSymbols block_symbols(std::span<const std::int32_t> levels);

// The blocks of an array: for each the offsets of its entries in zigzag order and the table's entries for them.
class Blocks {
  public:
    explicit Blocks(const Pyramid& pyramid);
    std::size_t count() const { return count_; }
    struct Block {
        std::vector<std::size_t> offsets;
        std::vector<double> table;
    };
    // Fills in a block, reusing its memory.
    void get(std::size_t number, Block& block) const;

  private:
    std::vector<std::size_t> shape_, strides_, axes_, grid_;  // grid_: blocks along each axis
    std::vector<Frequency> order_;
    std::size_t count_ = 1;
};

}  // namespace hogel
