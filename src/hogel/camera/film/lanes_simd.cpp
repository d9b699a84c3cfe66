// SPDX-License-Identifier: Apache-2.0
// The vector twins of lanes.cpp, compiled for every SIMD target and chosen when first called.
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

constexpr std::size_t together = math::SplitFft::together, row = math::SplitFft::row;
using D = hn::CappedTag<float, together>;

alignas(64) constexpr float dark[row] = {};

void TransposeSelected(const float* rows, std::span<const std::uint32_t> places, std::size_t lanes, float* to,
                       std::size_t block) {
    for (std::size_t first = 0; first < places.size(); first += together, to += block)
        for (std::size_t part : {std::size_t{0}, together})
            transpose_sixteen(
                [&](std::size_t i) {
                    return first + i < places.size() ? rows + std::size_t{places[first + i]} * row + part : dark;
                },
                lanes, [&](std::size_t lane) { return to + lane * row + part; });
}

void AddIntensities(const float* rows, std::span<const std::uint32_t> places, const float* across,
                    std::span<const float> down, float* out) {
    const D d;
    for (std::size_t lane = 0; lane < together; lane += hn::Lanes(d)) {
        const auto share = hn::Load(d, across + lane);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const float* value = rows + std::size_t{places[i]} * row + lane;
            const auto re = hn::Load(d, value), im = hn::Load(d, value + together);
            float* sum = out + i * together + lane;
            const auto weight = hn::Mul(share, hn::Set(d, down[i]));
            hn::Store(hn::MulAdd(weight, hn::MulAdd(im, im, hn::Mul(re, re)), hn::Load(d, sum)), d, sum);
        }
    }
}

#if HWY_TARGET == HWY_SCALAR
void TimesLens(const math::PackedComplex* wave, const float* lens, std::size_t rows, float* to) {
    times_lens_plain(wave, lens, rows, to);
}
void PackRows(const float* rows, std::span<const std::uint32_t> places, math::PackedComplex* to) {
    pack_rows_plain(rows, places, to);
}
void SideBySide(const math::PackedComplex* squares, std::size_t count, float* to) {
    side_by_side_plain(squares, count, to);
}
#else
void TimesLens(const math::PackedComplex* wave, const float* lens, std::size_t rows, float* to) {
    const D d;
    for (std::size_t i = 0; i < rows; ++i, wave += together, lens += row, to += row)
        for (std::size_t lane = 0; lane < together; lane += hn::Lanes(d)) {
            hn::Vec<D> a, b;
            unpack(d, hn::Load(hn::RebindToUnsigned<D>(), &wave[lane].bits), a, b);
            const auto c = hn::Load(d, lens + lane), s = hn::Load(d, lens + together + lane);
            hn::Store(hn::MulAdd(b, c, hn::Mul(a, s)), d, to + lane);
            hn::Store(hn::NegMulAdd(b, s, hn::Mul(a, c)), d, to + together + lane);
        }
}

void PackRows(const float* rows, std::span<const std::uint32_t> places, math::PackedComplex* to) {
    const D d;
    for (const std::uint32_t place : places)
        for (std::size_t lane = 0; lane < together; lane += hn::Lanes(d)) {
            const float* value = rows + std::size_t{place} * row + lane;
            hn::Store(pack(d, hn::Load(d, value), hn::Load(d, value + together)), hn::RebindToUnsigned<D>(), &to->bits);
            to += hn::Lanes(d);
        }
}

// Packed numbers are turned, as if they were floats, and then unpacked.
void SideBySide(const math::PackedComplex* squares, std::size_t count, float* to) {
    const D d;
    const hn::RebindToUnsigned<D> words;
    const auto* bits = reinterpret_cast<const float*>(squares);
    for (std::size_t square = 0; square < count; ++square, bits += together * together) {
        HWY_ALIGN float turned[together * together];
        transpose_sixteen([&](std::size_t lane) { return bits + lane * together; }, together,
                          [&](std::size_t i) { return turned + i * together; });
        for (std::size_t i = 0; i < together; ++i, to += row)
            for (std::size_t lane = 0; lane < together; lane += hn::Lanes(d)) {
                hn::Vec<D> re, im;
                unpack(d, hn::BitCast(words, hn::Load(d, turned + i * together + lane)), re, im);
                hn::Store(re, d, to + lane);
                hn::Store(im, d, to + together + lane);
            }
    }
}
#endif

void TransposeBlock(const float* rows, std::size_t from_row, std::size_t to_row, float* to) {
    transpose_sixteen([&](std::size_t line) { return rows + line * from_row; }, together,
                      [&](std::size_t i) { return to + i * to_row; });
}

}  // namespace hogel::camera::film::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::film {
HOGEL_DISPATCH(times_lens, TimesLens);
HOGEL_DISPATCH(pack_rows, PackRows);
HOGEL_DISPATCH(transpose_selected, TransposeSelected);
HOGEL_DISPATCH(add_intensities, AddIntensities);
HOGEL_DISPATCH(side_by_side, SideBySide);
HOGEL_DISPATCH(transpose_block, TransposeBlock);
}  // namespace hogel::camera::film
