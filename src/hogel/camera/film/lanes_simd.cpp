// SPDX-License-Identifier: Apache-2.0
// Vector twins of lanes.cpp, compiled for every SIMD target and chosen when first called.
#include <algorithm>

#include "hogel/camera/film/lanes.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/math/packed_complex-inl.h"
#include "hogel/math/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::film::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using math::HWY_NAMESPACE::transpose_sixteen;
#if HWY_TARGET != HWY_SCALAR
using math::HWY_NAMESPACE::pack;
using math::HWY_NAMESPACE::unpack;
#endif

constexpr std::size_t lanes_per_row = math::SplitFft::together, row = math::SplitFft::row;
using D = hn::CappedTag<float, lanes_per_row>;

alignas(64) constexpr float dark[row] = {};

void TransposeSelected(const float* rows, std::span<const std::uint32_t> indices, std::size_t lanes, float* to,
                       std::size_t block) {
    for (std::size_t first = 0; first < indices.size(); first += lanes_per_row, to += block)
        for (std::size_t part : {std::size_t{0}, lanes_per_row})
            transpose_sixteen(
                [&](std::size_t i) {
                    return first + i < indices.size() ? rows + std::size_t{indices[first + i]} * row + part : dark;
                },
                lanes, [&](std::size_t lane) { return to + lane * row + part; });
}

void AddIntensities(const float* rows, std::span<const std::uint32_t> indices, const float* across,
                    std::span<const float> down, float* out) {
    const D d;
    for (std::size_t lane = 0; lane < lanes_per_row; lane += hn::Lanes(d)) {
        const auto share = hn::Load(d, across + lane);
        for (std::size_t i = 0; i < indices.size(); ++i) {
            const float* value = rows + std::size_t{indices[i]} * row + lane;
            const auto re = hn::Load(d, value), im = hn::Load(d, value + lanes_per_row);
            float* sum = out + i * lanes_per_row + lane;
            const auto weight = hn::Mul(share, hn::Set(d, down[i]));
            hn::Store(hn::MulAdd(weight, hn::MulAdd(im, im, hn::Mul(re, re)), hn::Load(d, sum)), d, sum);
        }
    }
}

#if HWY_TARGET == HWY_SCALAR
void TimesLens(const math::PackedComplex* wave, const float* lens, std::size_t rows, float* to) {
    times_lens_plain(wave, lens, rows, to);
}
void PackRows(const float* rows, std::span<const std::uint32_t> indices, math::PackedComplex* to) {
    pack_rows_plain(rows, indices, to);
}
void InterleaveRows(const math::PackedComplex* squares, std::size_t count, float* to) {
    interleave_rows_plain(squares, count, to);
}
#else
void TimesLens(const math::PackedComplex* wave, const float* lens, std::size_t rows, float* to) {
    const D d;
    for (std::size_t i = 0; i < rows; ++i, wave += lanes_per_row, lens += row, to += row)
        for (std::size_t lane = 0; lane < lanes_per_row; lane += hn::Lanes(d)) {
            hn::Vec<D> a, b;
            unpack(d, hn::Load(hn::RebindToUnsigned<D>(), &wave[lane].bits), a, b);
            const auto c = hn::Load(d, lens + lane), s = hn::Load(d, lens + lanes_per_row + lane);
            hn::Store(hn::MulAdd(b, c, hn::Mul(a, s)), d, to + lane);
            hn::Store(hn::NegMulAdd(b, s, hn::Mul(a, c)), d, to + lanes_per_row + lane);
        }
}

void PackRows(const float* rows, std::span<const std::uint32_t> indices, math::PackedComplex* to) {
    const D d;
    for (const std::uint32_t index : indices)
        for (std::size_t lane = 0; lane < lanes_per_row; lane += hn::Lanes(d)) {
            const float* value = rows + std::size_t{index} * row + lane;
            hn::Store(pack(d, hn::Load(d, value), hn::Load(d, value + lanes_per_row)), hn::RebindToUnsigned<D>(),
                      &to->bits);
            to += hn::Lanes(d);
        }
}

// Transposes packed numbers as if they were floats, and unpacks them afterwards.
void InterleaveRows(const math::PackedComplex* squares, std::size_t count, float* to) {
    const D d;
    const hn::RebindToUnsigned<D> words;
    const auto* bits = reinterpret_cast<const float*>(squares);
    for (std::size_t square = 0; square < count; ++square, bits += lanes_per_row * lanes_per_row) {
        HWY_ALIGN float transposed[lanes_per_row * lanes_per_row];
        transpose_sixteen([&](std::size_t lane) { return bits + lane * lanes_per_row; }, lanes_per_row,
                          [&](std::size_t i) { return transposed + i * lanes_per_row; });
        for (std::size_t i = 0; i < lanes_per_row; ++i, to += row)
            for (std::size_t lane = 0; lane < lanes_per_row; lane += hn::Lanes(d)) {
                hn::Vec<D> re, im;
                unpack(d, hn::BitCast(words, hn::Load(d, transposed + i * lanes_per_row + lane)), re, im);
                hn::Store(re, d, to + lane);
                hn::Store(im, d, to + lanes_per_row + lane);
            }
    }
}
#endif

void TransposeBlock(const float* rows, std::size_t from_row, std::size_t to_row, float* to) {
    transpose_sixteen([&](std::size_t line) { return rows + line * from_row; }, lanes_per_row,
                      [&](std::size_t i) { return to + i * to_row; });
}

}  // namespace hogel::camera::film::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::film {
HOGEL_DISPATCH(times_lens, TimesLens);
HOGEL_DISPATCH(pack_rows, PackRows);
HOGEL_DISPATCH(transpose_selected, TransposeSelected);
HOGEL_DISPATCH(add_intensities, AddIntensities);
HOGEL_DISPATCH(interleave_rows, InterleaveRows);
HOGEL_DISPATCH(transpose_block, TransposeBlock);
}  // namespace hogel::camera::film
