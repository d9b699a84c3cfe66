// SPDX-License-Identifier: Apache-2.0
// Vector twins of lanes.cpp, compiled for every SIMD target and chosen when first called.
#include <hwy/cache_control.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hogel/camera/hogel_spectra/lanes.h"
#include "hogel/core/half.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/core/with_count.h"
#include "hogel/math/transpose-inl.h"

// After simd_targets-inl.h:
#include "hogel/camera/hogel_spectra/spread_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::hogel_spectra::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using core::HWY_NAMESPACE::with_count;
using math::HWY_NAMESPACE::transpose_sixteen;

#if HWY_TARGET == HWY_SCALAR
void SumRow(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const float* waves, float* line) {
    sum_row_plain(basis, columns, waves, line);
}
void SumRowOfHalves(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const std::uint16_t* waves,
                    const NextRow&, float* line) {
    sum_row_of_halves_plain(basis, columns, waves, line);
}
void SumRows(const SlepianBasis& basis, const SlepianBasis::Weights& rows, float sign, const float* lines,
             const float* mask, float* numbers) {
    sum_rows_plain(basis, rows, sign, lines, mask, numbers);
}
void AddLanes(const SlepianBasis& basis, const float* numbers, std::span<const LaneTarget> targets) {
    add_lanes_plain(basis, numbers, targets);
}
void AddLooks(const SlepianBasis& basis, const float* numbers, const float* carrier, const LineTarget& line) {
    add_looks_plain(basis, numbers, carrier, line);
}
#else
using D = hn::CappedTag<float, lanes>;
using V = hn::Vec<D>;
using SymmetricPair = SlepianBasis::SymmetricPair;

// Number of functions with sums in registers, for both parts of a number. Targets with 16 registers process the parts
// one after the other for more than five functions.
constexpr std::size_t functions_per_pass = 8;
constexpr std::size_t parts_of(std::size_t functions) {
    return HWY_ARCH_X86 && HWY_TARGET > HWY_AVX3 && functions > 5 ? 1 : 2;
}
// Floats of a complex number of all lanes.
constexpr std::size_t complex_size = 2 * lanes;

// Loads a vector of numbers; binary16 becomes single precision.
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

// Sums over pairs of items, `stride` numbers apart, with the weights of `functions` functions from `first` on. Calls
// store(k, offset, sum) for the results, and fetch() once per pair.
template <std::size_t functions, class Number, class Fetch, class Store>
HWY_INLINE void sum_pairs(const Number* items, std::size_t stride, const SlepianBasis::Weights& weights,
                          std::size_t first, const Fetch& fetch, const Store& store) {
    const D d;
    constexpr std::size_t parts_per_pass = parts_of(functions);
    const std::size_t paired = weights.pairs.size() - weights.unpaired;
    for (std::size_t offset = 0; offset < complex_size; offset += parts_per_pass * lanes)
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
            V sums[parts_per_pass][functions];
            for (auto& part : sums)
                for (V& sum : part) sum = hn::Zero(d);
            for (const SymmetricPair& pair : weights.pairs.first(paired)) {
                if (offset + i == 0) fetch();
                const Number *a_item = items + stride * pair.first + offset + i,
                             *b_item = items + stride * pair.second + offset + i;
                const V sign = hn::Set(d, pair.sign_first), sign_second = hn::Set(d, pair.sign_second);
                V even[parts_per_pass], odd[parts_per_pass];
                for (std::size_t p = 0; p < parts_per_pass; ++p) {
                    const V a = hn::Xor(load(a_item + p * lanes), sign),
                            b = hn::Xor(load(b_item + p * lanes), sign_second);
                    even[p] = hn::Add(a, b);
                    odd[p] = hn::Sub(a, b);
                }
                const float* weight = pair.weights + first;
                for (std::size_t k = 0; k < functions; ++k) {
                    const V w = hn::Set(d, weight[k]);
                    for (std::size_t p = 0; p < parts_per_pass; ++p)
                        sums[p][k] = hn::MulAdd(w, k % 2 == 0 ? even[p] : odd[p], sums[p][k]);
                }
            }
            for (const SymmetricPair& pair : weights.pairs.subspan(paired)) {
                const Number* a_item = items + stride * pair.first + offset + i;
                const V sign = hn::Set(d, pair.sign_first);
                for (std::size_t p = 0; p < parts_per_pass; ++p) {
                    const V a = hn::Xor(load(a_item + p * lanes), sign);
                    for (std::size_t k = 0; k < functions; ++k)
                        sums[p][k] = hn::MulAdd(hn::Set(d, pair.weights[first + k]), a, sums[p][k]);
                }
            }
            for (std::size_t p = 0; p < parts_per_pass; ++p)
                for (std::size_t k = 0; k < functions; ++k) store(k, offset + p * lanes + i, sums[p][k]);
        }
}

template <class Number, class Fetch>
HWY_INLINE void sum_numbers(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const Number* waves,
                            const Fetch& fetch, float* line) {
    const std::size_t functions = basis.functions();
    for (std::size_t first = 0; first < functions; first += functions_per_pass)
        with_count<functions_per_pass>(std::min(functions_per_pass, functions - first), [&](auto fixed_count) HWY_ATTR {
            sum_pairs<fixed_count()>(waves, complex_size, columns, first, fetch,
                                     [&](std::size_t k, std::size_t offset, V sum)
                                         HWY_ATTR { hn::Store(sum, D(), line + (first + k) * complex_size + offset); });
        });
}

void SumRow(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const float* waves, float* line) {
    sum_numbers(
        basis, columns, waves, [] {}, line);
}

void SumRowOfHalves(const SlepianBasis& basis, const SlepianBasis::Weights& columns, const std::uint16_t* waves,
                    const NextRow& next, float* line) {
    // Pairs are not in the order of memory. The next row is prefetched in that order, two waves per pair.
    const std::size_t n = basis.samples();
    std::size_t column = next.first_column;
    const auto fetch = [&]() HWY_ATTR {
        for (int wave = 0; wave < 2; ++wave) {
            hwy::Prefetch(next.waves + column * complex_size);
            column = column + 1 == n ? 0 : column + 1;
        }
    };
    sum_numbers(basis, columns, waves, fetch, line);
}

void SumRows(const SlepianBasis& basis, const SlepianBasis::Weights& rows, float sign, const float* lines,
             const float* mask, float* numbers) {
    const D d;
    const std::size_t functions = basis.functions(), line = functions * complex_size, size = functions * line;
    // A partial mask needs a buffer for the sums of all lanes.
    const bool all = std::all_of(mask, mask + lanes, [](float one) { return one != 0; });
    const core::ThreadBuffer<float> scratch(all ? 0 : size);
    float* sums = all ? numbers : scratch.data();
    const V factor = hn::Set(d, sign);
    for (std::size_t first = 0; first < functions; first += functions_per_pass)
        with_count<functions_per_pass>(std::min(functions_per_pass, functions - first), [&](auto fixed_count) HWY_ATTR {
            for (std::size_t k = 0; k < functions; ++k) {
                float* to = sums + first * line + k * complex_size;
                sum_pairs<fixed_count()>(
                    lines + k * complex_size, line, rows, first, [] {},
                    [=](std::size_t l, std::size_t offset, V sum)
                        HWY_ATTR { hn::Store(hn::Mul(sum, factor), D(), to + l * line + offset); });
            }
        });
    for (std::size_t i = 0; !all && i < size; i += hn::Lanes(d)) {
        const auto is_stored = hn::Ne(hn::Load(d, mask + i % lanes), hn::Zero(d));
        hn::BlendedStore(hn::Load(d, sums + i), is_stored, d, numbers + i);
    }
}

// Transposes numbers of nodes, [node][lane], into rows of each lane, `lane_stride` floats from lane to lane.
HWY_INLINE void transpose_nodes(const float* nodes, std::size_t across, std::size_t count, float* transposed,
                                std::size_t lane_stride) {
    for (std::size_t x = 0; x < across; x += lanes)
        transpose_sixteen([&](std::size_t i) { return nodes + (x + i) * lanes; }, lanes,
                          [&](std::size_t lane) { return transposed + std::min(lane, count) * lane_stride + x; });
}

void AddLanes(const SlepianBasis& basis, const float* numbers, std::span<const LaneTarget> targets) {
    const D d;
    const std::size_t functions = basis.functions(), nodes = basis.nodes(), across = padded(nodes);
    const std::size_t part = across * lanes,
                      lane_stride = 2 * functions * across;  // floats of a row of all lanes, and of one lane
    const core::ThreadBuffer<float> scratch(2 * part + (targets.size() + 1) * lane_stride);
    float *rows = scratch.data(), *transposed = rows + 2 * part;
    for (std::size_t p = 0; p < 2; ++p) std::fill(rows + p * part + nodes * lanes, rows + (p + 1) * part, 0.0f);
    for (std::size_t l = 0; l < functions; ++l) {
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d))
            spread_pairs(basis, numbers + l * functions * complex_size + i, lanes,
                         [&](std::size_t x, V even_re, V even_im, V odd_re, V odd_im) HWY_ATTR {
                             // i for odd functions across and down.
                             const auto store_node = [&](std::size_t node, V re, V im) HWY_ATTR {
                                 float* to = rows + node * lanes + i;
                                 hn::Store(l % 2 == 0 ? re : hn::Neg(im), d, to);
                                 hn::Store(l % 2 == 0 ? im : re, d, to + part);
                             };
                             store_node(x, hn::Sub(even_re, odd_im), hn::Add(even_im, odd_re));
                             store_node(nodes - 1 - x, hn::Add(even_re, odd_im), hn::Sub(even_im, odd_re));
                         });
        for (std::size_t p = 0; p < 2; ++p)
            transpose_nodes(rows + p * part, across, targets.size(), transposed + (2 * l + p) * across, lane_stride);
    }
    // Lane by lane, so that neighbours that share a line do not wait for each other's stores.
    for (std::size_t lane = 0; lane < targets.size(); ++lane) {
        const auto& [carrier, line] = targets[lane];
        for (std::size_t x = 0; x < across; x += hn::Lanes(d)) {
            const V c = hn::Load(d, carrier + x), s = hn::Load(d, carrier + across + x);
            for (std::size_t l = 0; l < functions; ++l) {
                const float* from = transposed + lane * lane_stride + 2 * l * across + x;
                const V re = hn::Load(d, from), im = hn::Load(d, from + across);
                float* real = line.first + 2 * l * line.row + x;
                add_product(re, im, c, s, real, real + line.row);
            }
        }
    }
}

void AddLooks(const SlepianBasis& basis, const float* numbers, const float* carrier, const LineTarget& line) {
    const D d;
    const std::size_t functions = basis.functions(), nodes = basis.nodes();
    for (std::size_t l = 0; l < functions; ++l)
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
            float* to = line.first + 2 * l * line.row + i;
            const auto add = [=](std::size_t x, V first, V second) HWY_ATTR {
                // i for odd functions down.
                const V re = l % 2 == 0 ? first : hn::Neg(second), im = l % 2 == 0 ? second : first;
                const V c = hn::Set(D(), carrier[x]), s = hn::Set(D(), carrier[padded(nodes) + x]);
                float* real = to + x * lanes;
                add_product(re, im, c, s, real, real + line.row);
            };
            spread_pairs(basis, numbers + l * functions * complex_size + i, lanes,
                         [=](std::size_t x, V even_re, V even_im, V odd_re, V odd_im) HWY_ATTR {
                             add(x, hn::Sub(even_re, odd_im), hn::Add(even_im, odd_re));
                             if (const std::size_t other = nodes - 1 - x; other != x)
                                 add(other, hn::Add(even_re, odd_im), hn::Sub(even_im, odd_re));
                         });
        }
}
#endif

}  // namespace hogel::camera::hogel_spectra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::hogel_spectra {
HOGEL_DISPATCH(sum_row, SumRow);
HOGEL_DISPATCH(sum_row_of_halves, SumRowOfHalves);
HOGEL_DISPATCH(sum_rows, SumRows);
HOGEL_DISPATCH(add_lanes, AddLanes);
HOGEL_DISPATCH(add_looks, AddLooks);
}  // namespace hogel::camera::hogel_spectra
