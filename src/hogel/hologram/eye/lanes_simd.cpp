// SPDX-License-Identifier: Apache-2.0
// The vector twins of lanes.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/hologram/eye/lanes_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hogel/core/half.h"
#include "hogel/core/with_count.h"
#include "hogel/hologram/eye/add_nodes-inl.h"
#include "hogel/hologram/eye/lanes.h"
#include "hogel/math/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::hologram::eye {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using core::HWY_NAMESPACE::with_count;
using math::HWY_NAMESPACE::transpose_sixteen;

#if HWY_TARGET == HWY_SCALAR
void SumRow(const HogelBasis& basis, const HogelBasis::Weights& columns, const float* waves, float* line) {
    sum_row_plain(basis, columns, waves, line);
}
void SumRowOfHalves(const HogelBasis& basis, const HogelBasis::Weights& columns, const std::uint16_t* waves,
                    const NextRow&, float* line) {
    sum_row_of_halves_plain(basis, columns, waves, line);
}
void SumRows(const HogelBasis& basis, const HogelBasis::Weights& rows, float sign, const float* lines,
             const float* chosen, float* numbers) {
    sum_rows_plain(basis, rows, sign, lines, chosen, numbers);
}
void AddLanes(const HogelBasis& basis, const float* numbers, std::span<const LaneTarget> targets) {
    add_lanes_plain(basis, numbers, targets);
}
#else
using D = hn::CappedTag<float, lanes>;
using V = hn::Vec<D>;
using WavePair = HogelBasis::WavePair;

// Functions whose sums are held in registers: both parts of a number with 32 registers, otherwise one after the other.
constexpr std::size_t together = 8;
constexpr std::size_t parts_together = HWY_ARCH_X86 && HWY_TARGET > HWY_AVX3 ? 1 : 2;
// Floats of a complex number of all lanes.
constexpr std::size_t both = 2 * lanes;

// Numbers of sixteen lanes; binary16 becomes single precision.
HWY_INLINE V load(const float* numbers) { return hn::Load(D(), numbers); }
HWY_INLINE V load(const std::uint16_t* numbers) {
    const D d;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
    const hn::Rebind<hwy::float16_t, D> halves;
    return hn::PromoteTo(d, hn::BitCast(halves, hn::Load(hn::Rebind<std::uint16_t, D>(), numbers)));
#else
    HWY_ALIGN float values[lanes];
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) values[i] = core::float_of(numbers[i]);
    return hn::Load(d, values);
#endif
}

// Sums over pairs of items, `stride` numbers apart, of weights of some functions from `first` on; store(k, part, i,
// sum). fetch() is called once for each pair.
template <std::size_t functions, class Number, class Fetch, class Store>
HWY_INLINE void sum_pairs(const Number* items, std::size_t stride, const HogelBasis::Weights& weights,
                          std::size_t first, const Fetch& fetch, const Store& store) {
    const D d;
    const std::size_t two = weights.pairs.size() - weights.alone;
    for (std::size_t at = 0; at < both; at += parts_together * lanes)
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
            V sums[parts_together][functions];
            for (auto& part : sums)
                for (V& sum : part) sum = hn::Zero(d);
            for (const WavePair& pair : weights.pairs.first(two)) {
                if (at + i == 0) fetch();
                const Number *one = items + stride * pair.one + at + i, *other = items + stride * pair.other + at + i;
                const V sign = hn::Set(d, pair.sign_one), sign_other = hn::Set(d, pair.sign_other);
                V even[parts_together], odd[parts_together];
                for (std::size_t p = 0; p < parts_together; ++p) {
                    const V a = hn::Xor(load(one + p * lanes), sign), b = hn::Xor(load(other + p * lanes), sign_other);
                    even[p] = hn::Add(a, b);
                    odd[p] = hn::Sub(a, b);
                }
                const float* weight = pair.weights + first;
                for (std::size_t k = 0; k < functions; ++k) {
                    const V w = hn::Set(d, weight[k]);
                    for (std::size_t p = 0; p < parts_together; ++p)
                        sums[p][k] = hn::MulAdd(w, k % 2 == 0 ? even[p] : odd[p], sums[p][k]);
                }
            }
            for (const WavePair& pair : weights.pairs.subspan(two)) {
                const Number* one = items + stride * pair.one + at + i;
                const V sign = hn::Set(d, pair.sign_one);
                for (std::size_t p = 0; p < parts_together; ++p) {
                    const V a = hn::Xor(load(one + p * lanes), sign);
                    for (std::size_t k = 0; k < functions; ++k)
                        sums[p][k] = hn::MulAdd(hn::Set(d, pair.weights[first + k]), a, sums[p][k]);
                }
            }
            for (std::size_t p = 0; p < parts_together; ++p)
                for (std::size_t k = 0; k < functions; ++k) store(k, at + p * lanes + i, i, sums[p][k]);
        }
}

template <class Number, class Fetch>
HWY_INLINE void sum_numbers(const HogelBasis& basis, const HogelBasis::Weights& columns, const Number* waves,
                            const Fetch& fetch, float* line) {
    const std::size_t functions = basis.functions();
    for (std::size_t first = 0; first < functions; first += together)
        with_count<together>(std::min(together, functions - first), [&](auto some) HWY_ATTR {
            sum_pairs<some()>(waves, both, columns, first, fetch,
                              [&](std::size_t k, std::size_t at, std::size_t, V sum)
                                  HWY_ATTR { hn::Store(sum, D(), line + (first + k) * both + at); });
        });
}

void SumRow(const HogelBasis& basis, const HogelBasis::Weights& columns, const float* waves, float* line) {
    sum_numbers(
        basis, columns, waves, [] {}, line);
}

void SumRowOfHalves(const HogelBasis& basis, const HogelBasis::Weights& columns, const std::uint16_t* waves,
                    const NextRow& next, float* line) {
    // Pairs are not in the order of memory, in which the waves of the next row are fetched, two for each pair.
    const std::size_t n = basis.samples();
    std::size_t column = next.first_column;
    const auto fetch = [&]() HWY_ATTR {
        for (int wave = 0; wave < 2; ++wave) {
            hwy::Prefetch(next.waves + column * both);
            column = column + 1 == n ? 0 : column + 1;
        }
    };
    sum_numbers(basis, columns, waves, fetch, line);
}

void SumRows(const HogelBasis& basis, const HogelBasis::Weights& rows, float sign, const float* lines,
             const float* chosen, float* numbers) {
    const D d;
    const std::size_t functions = basis.functions(), line = functions * both;
    const bool all = std::all_of(chosen, chosen + lanes, [](float one) { return one != 0; });
    const V factor = hn::Set(d, sign);
    for (std::size_t first = 0; first < functions; first += together)
        with_count<together>(std::min(together, functions - first), [&](auto some) HWY_ATTR {
            for (std::size_t k = 0; k < functions; ++k)
                sum_pairs<some()>(
                    lines + k * both, line, rows, first, [] {},
                    [&](std::size_t l, std::size_t at, std::size_t i, V sum) HWY_ATTR {
                        float* to = numbers + (first + l) * line + k * both + at;
                        sum = hn::Mul(sum, factor);
                        if (!all)
                            sum = hn::IfThenElse(hn::Ne(hn::Load(d, chosen + i), hn::Zero(d)), sum, hn::Load(d, to));
                        hn::Store(sum, d, to);
                    });
        });
}

// Pairs of nodes whose sums are held in registers.
constexpr std::size_t pairs_together = parts_together == 2 ? 4 : 2;

// Sums over functions for pairs of nodes from `first` on, at the same distance from the middle, which have the same
// even functions and opposite odd ones: store(pair, i, even re, even im, odd re, odd im).
template <std::size_t pairs, class Store>
HWY_INLINE void spread_pairs(const HogelBasis& basis, std::size_t first, const float* in, const Store& store) {
    const D d;
    const std::size_t functions = basis.functions();
    const float* spread = basis.spread().data() + first * functions;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        V sums[2][pairs][2];  // [odd][pair][part]
        for (auto& parity : sums)
            for (auto& sum : parity) sum[0] = sum[1] = hn::Zero(d);
        const auto add = [&](std::size_t k, V(&to)[pairs][2]) HWY_ATTR {
            const V re = hn::Load(d, in + k * both + i), im = hn::Load(d, in + k * both + lanes + i);
            for (std::size_t p = 0; p < pairs; ++p) {
                const V weight = hn::Set(d, spread[p * functions + k]);
                to[p][0] = hn::MulAdd(weight, re, to[p][0]);
                to[p][1] = hn::MulAdd(weight, im, to[p][1]);
            }
        };
        for (std::size_t k = 0; k + 1 < functions; k += 2) {
            add(k, sums[0]);
            add(k + 1, sums[1]);
        }
        if (functions % 2 != 0) add(functions - 1, sums[0]);
        for (std::size_t p = 0; p < pairs; ++p) store(p, i, sums[0][p][0], sums[0][p][1], sums[1][p][0], sums[1][p][1]);
    }
}

// Row l of the numbers at the nodes across: nodes[x][function down][part][lane], with i for odd functions, also down.
template <std::size_t pairs>
HWY_INLINE void spread_across(const HogelBasis& basis, std::size_t first, std::size_t l, const float* row,
                              float* nodes) {
    const D d;
    const std::size_t column = basis.functions() * both, last = basis.nodes() - 1;
    spread_pairs<pairs>(basis, first, row,
                        [&](std::size_t p, std::size_t i, V even_re, V even_im, V odd_re, V odd_im) HWY_ATTR {
                            const auto put = [&](std::size_t x, V re, V im) HWY_ATTR {
                                float* to = nodes + x * column + l * both + i;
                                hn::Store(l % 2 == 0 ? re : hn::Neg(im), d, to);
                                hn::Store(l % 2 == 0 ? im : re, d, to + lanes);
                            };
                            put(first + p, hn::Sub(even_re, odd_im), hn::Add(even_im, odd_re));
                            put(last - first - p, hn::Add(even_re, odd_im), hn::Sub(even_im, odd_re));
                        });
}

// Column x of the nodes: rows[mirrored][pair][x][part][lane].
template <std::size_t pairs>
HWY_INLINE void spread_down(const HogelBasis& basis, std::size_t first, const float* column, float* to,
                            std::size_t row) {
    const D d;
    spread_pairs<pairs>(basis, first, column,
                        [&](std::size_t p, std::size_t i, V even_re, V even_im, V odd_re, V odd_im) HWY_ATTR {
                            float *one = to + p * row + i, *other = one + pairs_together * row;
                            hn::Store(hn::Add(even_re, odd_re), d, one);
                            hn::Store(hn::Add(even_im, odd_im), d, one + lanes);
                            hn::Store(hn::Sub(even_re, odd_re), d, other);
                            hn::Store(hn::Sub(even_im, odd_im), d, other + lanes);
                        });
}

// Turns a row of nodes, [x][part][lane], into rows of each lane, `apart` floats from one lane to the next.
HWY_INLINE void turn_row(const float* row, std::size_t floats, std::size_t count, float* turned, std::size_t apart) {
    for (std::size_t i = 0; i < floats; i += lanes)
        transpose_sixteen([&](std::size_t j) { return row + (i + j) * lanes; }, lanes,
                          [&](std::size_t lane) { return turned + std::min(lane, count) * apart + i; });
}

void AddLanes(const HogelBasis& basis, const float* numbers, std::span<const LaneTarget> targets) {
    const std::size_t functions = basis.functions(), nodes = basis.nodes(), line = functions * both;
    const std::size_t row = phase_row(nodes) * lanes, pairs = (nodes + 1) / 2;
    thread_local std::vector<float, CacheLineAllocator<float> > scratch;
    const std::size_t floats = phase_row(nodes), apart = nodes * floats;  // of a row of one lane, and of one lane
    const std::size_t needed = nodes * line + 2 * pairs_together * row + (targets.size() + 1) * apart;
    if (scratch.size() < needed) scratch.resize(needed);
    float *columns = scratch.data(), *rows = columns + nodes * line, *turned = rows + 2 * pairs_together * row;
    for (std::size_t l = 0; l < functions; ++l)
        for (std::size_t first = 0; first < pairs; first += pairs_together)
            with_count<pairs_together>(std::min(pairs_together, pairs - first), [&](auto some) HWY_ATTR {
                spread_across<some()>(basis, first, l, numbers + l * line, columns);
            });
    for (std::size_t r = 0; r < 2 * pairs_together; ++r)
        std::fill(rows + r * row + nodes * both, rows + (r + 1) * row, 0.0f);
    for (std::size_t first = 0; first < pairs; first += pairs_together) {
        const std::size_t count = std::min(pairs_together, pairs - first);
        with_count<pairs_together>(count, [&](auto some) HWY_ATTR {
            for (std::size_t x = 0; x < nodes; ++x)
                spread_down<some()>(basis, first, columns + x * line, rows + x * both, row);
        });
        for (std::size_t p = 0; p < count; ++p) {
            const std::size_t one = first + p, other = nodes - 1 - one;
            turn_row(rows + p * row, floats, targets.size(), turned + one * floats, apart);
            if (other != one)
                turn_row(rows + (pairs_together + p) * row, floats, targets.size(), turned + other * floats, apart);
        }
    }
    // Lane by lane, so that neighbours that share a band wait for no store.
    for (std::size_t lane = 0; lane < targets.size(); ++lane) {
        const LaneTarget& target = targets[lane];
        for (std::size_t y = 0; y < nodes; ++y) {
            const float *from = turned + lane * apart + y * floats, *phase = target.phases + 2 * y * floats;
            auto* to = reinterpret_cast<float*>(target.band.first + y * target.band.row);
            for (std::size_t i = 0; i < 2 * nodes; i += lanes)
                add_nodes(from + i, phase + i, phase + floats + i, std::min(lanes, 2 * nodes - i), to + i);
        }
    }
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::hologram::eye
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::hologram::eye {

HWY_EXPORT(SumRow);
HWY_EXPORT(SumRowOfHalves);
HWY_EXPORT(SumRows);
HWY_EXPORT(AddLanes);

void sum_row(const HogelBasis& basis, const HogelBasis::Weights& columns, const float* waves, float* line) {
    HWY_DYNAMIC_DISPATCH(SumRow)(basis, columns, waves, line);
}
void sum_row_of_halves(const HogelBasis& basis, const HogelBasis::Weights& columns, const std::uint16_t* waves,
                       const NextRow& next, float* line) {
    HWY_DYNAMIC_DISPATCH(SumRowOfHalves)(basis, columns, waves, next, line);
}
void sum_rows(const HogelBasis& basis, const HogelBasis::Weights& rows, float sign, const float* lines,
              const float* chosen, float* numbers) {
    HWY_DYNAMIC_DISPATCH(SumRows)(basis, rows, sign, lines, chosen, numbers);
}
void add_lanes(const HogelBasis& basis, const float* numbers, std::span<const LaneTarget> targets) {
    HWY_DYNAMIC_DISPATCH(AddLanes)(basis, numbers, targets);
}

}  // namespace hogel::hologram::eye
#endif
