// SPDX-License-Identifier: Apache-2.0
// Vector versions of hogel_tiles.h, compiled for every SIMD target. The first call selects the target.
#include <type_traits>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/math/transpose-inl.h"
#include "hogel/stereogram/hogel_tiles.h"
#include "hogel/stereogram/philox_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::stereogram::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using math::HWY_NAMESPACE::transpose_sixteen;

#if HWY_TARGET == HWY_SCALAR
void RandomWaves(const PhaseSeries& series, std::size_t first_row, const float* moduli, std::size_t columns,
                 float* out) {
    random_waves_plain(series, first_row, moduli, columns, out);
}
void RandomRow(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli, std::size_t columns,
               float* out) {
    random_row_plain(series, row, shared, moduli, columns, out);
}
void RandomRowOfAnySide(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                        std::size_t column_stride, std::span<const float> middle, std::size_t columns, float* out) {
    random_row_of_any_side_plain(series, row, shared, moduli, column_stride, middle, columns, out);
}
#else
using D = hn::CappedTag<float, rows_at_once>;
using V = hn::Vec<D>;

// Returns the root of unity for the byte of each word that begins at bit `shift`.
template <int shift>
HWY_INLINE void Root(D d, const PhaseRoots& roots, hn::VFromD<hn::RebindToUnsigned<D> > words, V& re, V& im) {
    const hn::RebindToUnsigned<D> integers;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
    // Product of the roots of the byte's halves, from tables of one vector.
    const auto half = hn::Set(integers, 15u);
    const auto upper = hn::IndicesFromVec(d, hn::And(hn::ShiftRight<shift + 4>(words), half));
    const auto lower = hn::IndicesFromVec(d, hn::And(hn::ShiftRight<shift>(words), half));
    const V a = hn::TableLookupLanes(hn::Load(d, roots.upper_re), upper),
            b = hn::TableLookupLanes(hn::Load(d, roots.upper_im), upper),
            c = hn::TableLookupLanes(hn::Load(d, roots.lower_re), lower),
            e = hn::TableLookupLanes(hn::Load(d, roots.lower_im), lower);
    re = hn::NegMulAdd(b, e, hn::Mul(a, c));
    im = hn::MulAdd(b, c, hn::Mul(a, e));
#else
    const hn::RebindToSigned<D> index;
    const auto byte = hn::BitCast(index, hn::And(hn::ShiftRight<shift>(words), hn::Set(integers, 255u)));
    re = hn::GatherIndex(d, roots.re, byte);
    im = hn::GatherIndex(d, roots.im, byte);
#endif
}

template <int shift>
HWY_INLINE void Wave(D d, const PhaseRoots& roots, hn::VFromD<hn::RebindToUnsigned<D> > words, V r, float* out) {
    V re, im;
    Root<shift>(d, roots, words, re, im);
    hn::Store(hn::Mul(r, re), d, out);
    hn::Store(hn::Mul(r, im), d, out + rows_at_once);
}

// One draw gives the phases of sixteen columns of a row. Lanes are rows.
void RandomWaves(const PhaseSeries& series, std::size_t first_row, const float* moduli, std::size_t columns,
                 float* out) {
    const PhaseRoots& roots = phase_roots();
    const D d;
    const hn::RebindToUnsigned<D> words;
    const hn::Repartition<std::uint64_t, decltype(words)> wide;
    const std::size_t half = hn::Lanes(wide), draws = columns / 16;
    HWY_ALIGN std::uint64_t first_draws[rows_at_once];
    for (std::size_t row = 0; row < rows_at_once; ++row) first_draws[row] = (first_row + row) * draws;
    for (std::size_t draw = 0; draw < draws; ++draw)
        for (std::size_t i = 0; i < rows_at_once; i += hn::Lanes(d)) {
            const auto number = hn::Set(wide, draw);
            auto a0 = hn::Add(hn::Load(wide, first_draws + i), number),
                 b0 = hn::Add(hn::Load(wide, first_draws + i + half), number);
            auto a1 = hn::Set(wide, series.position[0]), b1 = a1;
            auto a2 = hn::Set(wide, series.position[1]), b2 = a2;
            auto a3 = hn::Set(wide, series.position[2]), b3 = a3;
            philox_lanes(wide, a0, a1, a2, a3, series.key);
            philox_lanes(wide, b0, b1, b2, b3, series.key);
            const auto four = [&](auto lower, auto upper, std::size_t x) {
                const auto word = hn::ConcatEven(words, hn::BitCast(words, upper), hn::BitCast(words, lower));
                const float* modulus = moduli + x * rows_at_once + i;
                float* to = out + x * square_column + i;
                Wave<0>(d, roots, word, hn::Load(d, modulus), to);
                Wave<8>(d, roots, word, hn::Load(d, modulus + rows_at_once), to + square_column);
                Wave<16>(d, roots, word, hn::Load(d, modulus + 2 * rows_at_once), to + 2 * square_column);
                Wave<24>(d, roots, word, hn::Load(d, modulus + 3 * rows_at_once), to + 3 * square_column);
            };
            four(a0, b0, 16 * draw);
            four(a1, b1, 16 * draw + 4);
            four(a2, b2, 16 * draw + 8);
            four(a3, b3, 16 * draw + 12);
        }
}

// One draw gives the phases of sixteen columns of a lane.
template <bool shared>
HWY_INLINE void random_row_as(const SeriesOfLanes& series, const PhaseRoots& roots, std::size_t row,
                              const float* moduli, std::size_t columns, float* out) {
    const D d;
    const hn::RebindToUnsigned<D> words;
    const hn::Repartition<std::uint64_t, decltype(words)> wide;
    const hn::Repartition<std::uint8_t, decltype(words)> bytes;
    const std::size_t half = hn::Lanes(wide), draws = columns / 16, step = 128 - 128 / columns;
    for (std::size_t draw = 0; draw < draws; ++draw)
        for (std::size_t i = 0; i < rows_at_once; i += hn::Lanes(d)) {
            auto a0 = hn::Set(wide, row * draws + draw), b0 = a0;
            auto a1 = hn::Load(wide, series.position[0] + i), b1 = hn::Load(wide, series.position[0] + i + half);
            auto a2 = hn::Load(wide, series.position[1] + i), b2 = hn::Load(wide, series.position[1] + i + half);
            auto a3 = hn::Load(wide, series.position[2] + i), b3 = hn::Load(wide, series.position[2] + i + half);
            philox_lanes(wide, a0, a1, a2, a3, series.key);
            philox_lanes(wide, b0, b1, b2, b3, series.key);
            const auto four = [&](auto lower, auto upper, std::size_t x) HWY_ATTR {
                std::uint32_t middle = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    middle |= static_cast<std::uint32_t>((row + x + k) * step % 256) << (8 * k);
                const auto word =
                    hn::BitCast(words, hn::Add(hn::BitCast(bytes, hn::ConcatEven(words, hn::BitCast(words, upper),
                                                                                 hn::BitCast(words, lower))),
                                               hn::BitCast(bytes, hn::Set(words, middle))));
                const auto modulus = [&](std::size_t k) HWY_ATTR {
                    const float* from = moduli + (x + k) * rows_at_once;
                    if constexpr (shared)
                        return hn::Set(d, *from);
                    else
                        return hn::Load(d, from + i);
                };
                float* to = out + x * square_column + i;
                Wave<0>(d, roots, word, modulus(0), to);
                Wave<8>(d, roots, word, modulus(1), to + square_column);
                Wave<16>(d, roots, word, modulus(2), to + 2 * square_column);
                Wave<24>(d, roots, word, modulus(3), to + 3 * square_column);
            };
            four(a0, b0, 16 * draw);
            four(a1, b1, 16 * draw + 4);
            four(a2, b2, 16 * draw + 8);
            four(a3, b3, 16 * draw + 12);
        }
}

void RandomRow(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli, std::size_t columns,
               float* out) {
    if (shared)
        random_row_as<true>(series, phase_roots(), row, moduli, columns, out);
    else
        random_row_as<false>(series, phase_roots(), row, moduli, columns, out);
}

// The first draw may begin before the row and the last end after it: all rows share one sequence.
template <bool shared>
HWY_INLINE void random_row_of_any_side_as(const SeriesOfLanes& series, const PhaseRoots& roots, std::size_t row,
                                          const float* moduli, std::size_t column_stride, const float* middle,
                                          std::size_t columns, float* out) {
    const D d;
    const hn::RebindToUnsigned<D> words;
    const hn::Repartition<std::uint64_t, decltype(words)> wide;
    const std::size_t half = hn::Lanes(wide), first = row * columns, last = first + columns - 1;
    for (std::size_t draw = first / 16; draw <= last / 16; ++draw)
        for (std::size_t i = 0; i < rows_at_once; i += hn::Lanes(d)) {
            auto a0 = hn::Set(wide, draw), b0 = a0;
            auto a1 = hn::Load(wide, series.position[0] + i), b1 = hn::Load(wide, series.position[0] + i + half);
            auto a2 = hn::Load(wide, series.position[1] + i), b2 = hn::Load(wide, series.position[1] + i + half);
            auto a3 = hn::Load(wide, series.position[2] + i), b3 = hn::Load(wide, series.position[2] + i + half);
            philox_lanes(wide, a0, a1, a2, a3, series.key);
            philox_lanes(wide, b0, b1, b2, b3, series.key);
            const auto wave = [&](auto shift, auto word, std::size_t index) HWY_ATTR {
                if (index < first || index > last) return;
                const std::size_t x = index - first;
                V re, im, modulus;
                Root<shift()>(d, roots, word, re, im);
                if constexpr (shared)
                    modulus = hn::Set(d, moduli[x * column_stride]);
                else
                    modulus = hn::Load(d, moduli + x * column_stride + i);
                const V c = hn::Set(d, middle[2 * (row + x)]), s = hn::Set(d, middle[2 * (row + x) + 1]);
                float* to = out + x * square_column + i;
                hn::Store(hn::Mul(modulus, hn::NegMulAdd(im, s, hn::Mul(re, c))), d, to);
                hn::Store(hn::Mul(modulus, hn::MulAdd(im, c, hn::Mul(re, s))), d, to + rows_at_once);
            };
            const auto four = [&](auto lower, auto upper, std::size_t index) HWY_ATTR {
                const auto word = hn::ConcatEven(words, hn::BitCast(words, upper), hn::BitCast(words, lower));
                wave(std::integral_constant<int, 0>(), word, index);
                wave(std::integral_constant<int, 8>(), word, index + 1);
                wave(std::integral_constant<int, 16>(), word, index + 2);
                wave(std::integral_constant<int, 24>(), word, index + 3);
            };
            four(a0, b0, 16 * draw);
            four(a1, b1, 16 * draw + 4);
            four(a2, b2, 16 * draw + 8);
            four(a3, b3, 16 * draw + 12);
        }
}

void RandomRowOfAnySide(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                        std::size_t column_stride, std::span<const float> middle, std::size_t columns, float* out) {
    if (shared)
        random_row_of_any_side_as<true>(series, phase_roots(), row, moduli, column_stride, middle.data(), columns, out);
    else
        random_row_of_any_side_as<false>(series, phase_roots(), row, moduli, column_stride, middle.data(), columns,
                                         out);
}
#endif

void TransposeRows(const float* from, std::size_t columns, float* to, std::size_t block_stride) {
    for (std::size_t x0 = 0; x0 < columns; x0 += 16, to += block_stride)
        for (const std::size_t part : {std::size_t{0}, rows_at_once})
            transpose_sixteen([&](std::size_t i) { return from + (x0 + i) * square_column + part; }, rows_at_once,
                              [&](std::size_t row) { return to + row * square_column + part; });
}

void GatherRows(std::span<const float* const> from, std::size_t offset, float* to, std::size_t to_stride) {
    alignas(64) static constexpr float zeros[rows_at_once] = {};
    transpose_sixteen([&](std::size_t i) { return i < from.size() ? from[i] + offset : zeros; }, rows_at_once,
                      [&](std::size_t row) { return to + row * to_stride; });
}

void TransposeHogels(const float* from, std::size_t columns, std::size_t hogels, float* to, std::size_t hogel_stride) {
    for (std::size_t x = 0; x < columns; ++x)
        transpose_sixteen([&](std::size_t row) { return from + (row * columns + x) * 16; }, hogels,
                          [&](std::size_t h) { return to + h * hogel_stride + x * rows_at_once; });
}

}  // namespace hogel::stereogram::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::stereogram {
HOGEL_DISPATCH(random_waves, RandomWaves);
HOGEL_DISPATCH(random_row, RandomRow);
HOGEL_DISPATCH(random_row_of_any_side, RandomRowOfAnySide);
HOGEL_DISPATCH(transpose_rows, TransposeRows);
HOGEL_DISPATCH(gather_rows, GatherRows);
HOGEL_DISPATCH(transpose_hogels, TransposeHogels);
}  // namespace hogel::stereogram
