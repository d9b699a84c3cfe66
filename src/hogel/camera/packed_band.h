// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hogel/array.h"
#include "hogel/field.h"
#include "hogel/math/packed_complex.h"

namespace hogel::camera {

/// A pupil band in packed numbers, which round by at most 1/2047 of a value. Bands of many looks and viewpoints take
/// most of the memory of a photograph, and the system clears memory before its first use. The numbers form squares of
/// 16 × 16: a part of a hologram then touches few pages, and sixteen rows are read sequentially.
class PackedBand {
  public:
    static constexpr std::size_t side = 16;
    /// Numbers in a square, the stride between squares of a row.
    static constexpr std::size_t square = side * side;

    PackedBand() = default;
    PackedBand(std::size_t height, std::size_t width) : PackedBand(std::move(dark(1, height, width).front())) {}
    explicit PackedBand(View<const std::complex<float>, 2> band);
    PackedBand(const PackedBand&) = delete;
    PackedBand& operator=(const PackedBand&) = delete;
    PackedBand(PackedBand&&) = default;
    PackedBand& operator=(PackedBand&&) = default;
    ~PackedBand() = default;

    /// Returns bands of zeros in one block of memory, cleared on all threads. The block has huge pages, which the
    /// system clears in a fraction of the time of small ones. The last band that is destroyed frees it.
    static std::vector<PackedBand> dark(std::size_t count, std::size_t height, std::size_t width);

    static double bytes(const Grid& plane) {
        return static_cast<double>(sizeof(math::PackedComplex) * plane.samples());
    }

    std::size_t height() const { return height_; }
    std::size_t width() const { return width_; }

    /// Returns the address of a number; the rest of its row in the same square follows.
    math::PackedComplex* at(std::size_t row, std::size_t column) { return squares_ + offset(row, column); }
    const math::PackedComplex* at(std::size_t row, std::size_t column) const { return squares_ + offset(row, column); }

    bool is_active(std::size_t row) const;

    friend bool operator==(const PackedBand& a, const PackedBand& b) {
        return a.height_ == b.height_ && a.width_ == b.width_ && std::ranges::equal(a.numbers(), b.numbers());
    }

  private:
    static constexpr std::size_t count_squares(std::size_t numbers) { return (numbers + side - 1) / side; }
    static constexpr std::size_t padded_size(std::size_t height, std::size_t width) {
        return count_squares(height) * count_squares(width) * square;
    }
    std::span<const math::PackedComplex> numbers() const { return {squares_, padded_size(height_, width_)}; }
    std::size_t offset(std::size_t row, std::size_t column) const {
        return (row / side * count_squares(width_) + column / side) * square + row % side * side + column % side;
    }

    std::size_t height_ = 0, width_ = 0;
    std::shared_ptr<math::PackedComplex> storage_;  // shared by all bands of one dark()
    math::PackedComplex* squares_ = nullptr;        // [row / 16][column / 16][row mod 16][column mod 16]
};

}  // namespace hogel::camera
