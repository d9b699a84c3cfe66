// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/lanes.h"

#include <algorithm>

namespace hogel::camera::film {
namespace {

constexpr std::size_t together = math::SplitFft::together, row = math::SplitFft::row;

}  // namespace

void times_lens_plain(const math::PackedComplex* wave, const float* lens, std::size_t rows, float* to) {
    for (std::size_t i = 0; i < rows; ++i, wave += together, lens += row, to += row)
        for (std::size_t lane = 0; lane < together; ++lane) {
            const std::complex<float> value = math::unpacked(wave[lane]);
            const float a = value.real(), b = value.imag(), c = lens[lane], s = lens[together + lane];
            to[lane] = a * s + b * c;
            to[together + lane] = a * c - b * s;
        }
}

void pack_rows_plain(const float* rows, std::span<const std::uint32_t> places, math::PackedComplex* to) {
    for (const std::uint32_t place : places)
        for (std::size_t lane = 0; lane < together; ++lane) {
            const float* value = rows + place * row + lane;
            *to++ = math::pack({value[0], value[together]});
        }
}

void transpose_selected_plain(const float* rows, std::span<const std::uint32_t> places, std::size_t lanes, float* to,
                              std::size_t block) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
        for (std::size_t part : {std::size_t{0}, together})
            for (std::size_t i = 0; i < (places.size() + together - 1) / together * together; ++i)
                to[i / together * block + lane * row + part + i % together] =
                    i < places.size() ? rows[places[i] * row + part + lane] : 0;
}

void add_intensities_plain(const float* rows, std::span<const std::uint32_t> places, const float* across,
                           std::span<const float> down, float* out) {
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t lane = 0; lane < together; ++lane) {
            const float *value = rows + places[i] * row + lane, re = value[0], im = value[together];
            out[i * together + lane] += down[i] * across[lane] * (re * re + im * im);
        }
}

void side_by_side_plain(const math::PackedComplex* squares, std::size_t count, float* to) {
    for (std::size_t square = 0; square < count; ++square, squares += together * together)
        for (std::size_t i = 0; i < together; ++i, to += row)
            for (std::size_t lane = 0; lane < together; ++lane) {
                const std::complex<float> value = math::unpacked(squares[lane * together + i]);
                to[lane] = value.real();
                to[together + lane] = value.imag();
            }
}

void transpose_block_plain(const float* rows, std::size_t from_row, std::size_t to_row, float* to) {
    for (std::size_t line = 0; line < together; ++line)
        for (std::size_t i = 0; i < together; ++i) to[i * to_row + line] = rows[line * from_row + i];
}

}  // namespace hogel::camera::film
