// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/packed_band.h"

#include <algorithm>

namespace hogel::optics {
namespace {

constexpr std::size_t squares_of(std::size_t numbers) { return (numbers + PackedBand::side - 1) / PackedBand::side; }

// Calls each(row, column, count) for the numbers of a row that are in one square.
void for_squares(View<const std::complex<float>, 2> some, const auto& each) {
    for (std::size_t row = 0; row < some.extent(0); ++row)
        for (std::size_t column = 0; column < some.extent(1); column += PackedBand::side)
            each(row, column, std::min(PackedBand::side, some.extent(1) - column));
}

}  // namespace

PackedBand::PackedBand(std::size_t height, std::size_t width)
    : height_(height), width_(width), squares_({squares_of(height), squares_of(width), square}) {}

PackedBand::PackedBand(View<const std::complex<float>, 2> band) : PackedBand(band.extent(0), band.extent(1)) {
    for_squares(band, [&](std::size_t row, std::size_t column, std::size_t count) {
        math::pack(&band(row, column), at(row, column), count);
    });
}

bool PackedBand::is_lit(std::size_t row) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < squares_.extent(1) && bits == 0; ++i)
        for (const math::PackedComplex* number = at(row, i * side); number < at(row, i * side) + side; ++number)
            bits |= number->bits;
    return bits != 0;
}

void PackedBand::add(View<const std::complex<float>, 2> some, std::size_t first_row, std::size_t first_column) {
    for_squares(some, [&](std::size_t row, std::size_t column, std::size_t count) {
        math::add_to_packed(&some(row, column), at(first_row + row, first_column + column), count);
    });
}

}  // namespace hogel::optics
