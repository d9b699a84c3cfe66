// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/lanes.h"

#include <algorithm>

namespace hogel::camera::film {
namespace {

constexpr std::size_t lanes_per_row = math::SplitFft::together, row = math::SplitFft::row;

}  // namespace

void times_lens_plain(const math::PackedComplex* wave, const float* lens, std::size_t rows, float* to) {
    for (std::size_t i = 0; i < rows; ++i, wave += lanes_per_row, lens += row, to += row)
        for (std::size_t lane = 0; lane < lanes_per_row; ++lane) {
            const std::complex<float> value = math::unpacked(wave[lane]);
            const float a = value.real(), b = value.imag(), c = lens[lane], s = lens[lanes_per_row + lane];
            to[lane] = a * s + b * c;
            to[lanes_per_row + lane] = a * c - b * s;
        }
}

void pack_rows_plain(const float* rows, std::span<const std::uint32_t> indices, math::PackedComplex* to) {
    for (const std::uint32_t index : indices)
        for (std::size_t lane = 0; lane < lanes_per_row; ++lane) {
            const float* value = rows + index * row + lane;
            *to++ = math::pack({value[0], value[lanes_per_row]});
        }
}

void transpose_selected_plain(const float* rows, std::span<const std::uint32_t> indices, std::size_t lanes, float* to,
                              std::size_t block) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
        for (std::size_t part : {std::size_t{0}, lanes_per_row})
            for (std::size_t i = 0; i < (indices.size() + lanes_per_row - 1) / lanes_per_row * lanes_per_row; ++i)
                to[i / lanes_per_row * block + lane * row + part + i % lanes_per_row] =
                    i < indices.size() ? rows[indices[i] * row + part + lane] : 0;
}

void add_intensities_plain(const float* rows, std::span<const std::uint32_t> indices, const float* across,
                           std::span<const float> down, float* out) {
    for (std::size_t i = 0; i < indices.size(); ++i)
        for (std::size_t lane = 0; lane < lanes_per_row; ++lane) {
            const float *value = rows + indices[i] * row + lane, re = value[0], im = value[lanes_per_row];
            out[i * lanes_per_row + lane] += down[i] * across[lane] * (re * re + im * im);
        }
}

void interleave_rows_plain(const math::PackedComplex* squares, std::size_t count, float* to) {
    for (std::size_t square = 0; square < count; ++square, squares += lanes_per_row * lanes_per_row)
        for (std::size_t i = 0; i < lanes_per_row; ++i, to += row)
            for (std::size_t lane = 0; lane < lanes_per_row; ++lane) {
                const std::complex<float> value = math::unpacked(squares[lane * lanes_per_row + i]);
                to[lane] = value.real();
                to[lanes_per_row + lane] = value.imag();
            }
}

void transpose_block_plain(const float* rows, std::size_t from_row, std::size_t to_row, float* to) {
    for (std::size_t line = 0; line < lanes_per_row; ++line)
        for (std::size_t i = 0; i < lanes_per_row; ++i) to[i * to_row + line] = rows[line * from_row + i];
}

}  // namespace hogel::camera::film
