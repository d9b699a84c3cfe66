// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/packed_band.h"

#include <algorithm>

namespace hogel::optics {
namespace {

constexpr std::size_t squares_of(std::size_t numbers) { return (numbers + PackedBand::side - 1) / PackedBand::side; }

}  // namespace

PackedBand::PackedBand(std::size_t height, std::size_t width)
    : height_(height), width_(width), squares_({squares_of(height), squares_of(width), square}) {}

PackedBand::PackedBand(View<const std::complex<float>, 2> band) : PackedBand(band.extent(0), band.extent(1)) {
    for (std::size_t row = 0; row < height_; ++row)
        for (std::size_t column = 0; column < width_; column += side)
            math::pack(&band(row, column), at(row, column), std::min(side, width_ - column));
}

bool PackedBand::is_lit(std::size_t row) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < squares_.extent(1) && bits == 0; ++i)
        for (const math::PackedComplex* number = at(row, i * side); number < at(row, i * side) + side; ++number)
            bits |= number->bits;
    return bits != 0;
}

}  // namespace hogel::optics
