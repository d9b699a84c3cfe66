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

/// The narrow band of an eye, packed: many looks to several eyes are most of the memory of a photograph, which the
/// system clears before it is used, and what that rounds away is no more than 1/2047 of a number. In squares of
/// 16 x 16 numbers, so that a part of a hologram lights few pages of memory, and so that sixteen rows are read one
/// after the other.
class PackedBand {
  public:
    /// Numbers along a side of a square.
    static constexpr std::size_t side = 16;
    /// From one square of a row of them to the next, in numbers.
    static constexpr std::size_t square = side * side;

    PackedBand() = default;
    /// A dark band.
    PackedBand(std::size_t height, std::size_t width) : PackedBand(std::move(dark(1, height, width).front())) {}
    explicit PackedBand(View<const std::complex<float>, 2> band);
    PackedBand(const PackedBand&) = delete;
    PackedBand& operator=(const PackedBand&) = delete;
    PackedBand(PackedBand&&) = default;
    PackedBand& operator=(PackedBand&&) = default;
    ~PackedBand() = default;

    /// Bands of one size in one block of memory, which is freed with the last of them: it has huge pages, which the
    /// system clears in a fraction of the time that small ones take. They are cleared on all threads.
    static std::vector<PackedBand> dark(std::size_t count, std::size_t height, std::size_t width);

    static double bytes(const Grid& plane) {
        return static_cast<double>(sizeof(math::PackedComplex) * plane.samples());
    }

    std::size_t height() const { return height_; }
    std::size_t width() const { return width_; }

    /// A number; those of the same row and square follow.
    math::PackedComplex* at(std::size_t row, std::size_t column) { return squares_ + offset(row, column); }
    const math::PackedComplex* at(std::size_t row, std::size_t column) const { return squares_ + offset(row, column); }

    /// Whether a row has a number that is not zero.
    bool is_active(std::size_t row) const;

    friend bool operator==(const PackedBand& a, const PackedBand& b) {
        return a.height_ == b.height_ && a.width_ == b.width_ && std::ranges::equal(a.numbers(), b.numbers());
    }

  private:
    static constexpr std::size_t squares_of(std::size_t numbers) { return (numbers + side - 1) / side; }
    // The numbers of a band of this size.
    static constexpr std::size_t size(std::size_t height, std::size_t width) {
        return squares_of(height) * squares_of(width) * square;
    }
    std::span<const math::PackedComplex> numbers() const { return {squares_, size(height_, width_)}; }
    std::size_t offset(std::size_t row, std::size_t column) const {
        return (row / side * squares_of(width_) + column / side) * square + row % side * side + column % side;
    }

    std::size_t height_ = 0, width_ = 0;
    std::shared_ptr<math::PackedComplex> memory_;  // of all bands that were made with it
    math::PackedComplex* squares_ = nullptr;       // [row / 16][column / 16][row mod 16][column mod 16]
};

}  // namespace hogel::camera
