// SPDX-License-Identifier: Apache-2.0
// Compiled for every SIMD target and dispatched at run time. The reference version is math/fourier/plain.cpp.
#include "hogel/math/column_fft.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstdint>

#include "hogel/array.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/math/numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::math::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
bool HasVectors() { return false; }
void TransformColumns(const ColumnFft::Plan&, bool, const float*, std::size_t, float*, std::size_t, std::size_t) {}
void TransformSplit(const ColumnFft::Plan&, float*) {}
void TransformSplitToInterleaved(const ColumnFft::Plan&, const float*, float*, std::size_t, std::size_t) {}
#else
bool HasVectors() { return true; }

constexpr std::size_t batch_columns = ColumnFft::batch_columns;
HWY_INLINE Numbers Times(D d, const Numbers& x, const ColumnFft::Factor& factor) {
    return Times(x, hn::Set(d, factor.re), hn::Set(d, factor.im));
}

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
// Interleaved layout with non-temporal stores of whole cache lines: a large result is not read again soon, and a normal
// store would first fetch the line.
struct Streamed {
    static HWY_INLINE void Store(D d, const Numbers& x, float* row, std::size_t i) {
        alignas(64) static constexpr std::int32_t order[] = {0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7, 12, 13, 14, 15};
        const auto indices = hn::SetTableIndices(d, order);
        const V lower = hn::InterleaveLower(d, x.re, x.im), upper = hn::InterleaveUpper(d, x.re, x.im);
        hn::Stream(hn::TableLookupLanes(hn::ConcatLowerLower(d, upper, lower), indices), d, row + 2 * i);
        hn::Stream(hn::TableLookupLanes(hn::ConcatUpperUpper(d, upper, lower), indices), d,
                   row + 2 * i + batch_columns);
    }
};
#else
using Streamed = Interleaved;
#endif

struct Four {
    Numbers a, b, c, d;
};

// Radix-4 butterfly of four rows: sums with powers of i, or of −i if forward.
template <bool forward, class Layout>
HWY_INLINE Four Butterfly(D d, const float* rows, std::size_t stride, std::size_t i) {
    const Numbers a = Layout::Load(d, rows, i), b = Layout::Load(d, rows + stride, i),
                  c = Layout::Load(d, rows + 2 * stride, i), e = Layout::Load(d, rows + 3 * stride, i);
    const Numbers sum_ac = a + c, difference_ac = a - c, sum_be = b + e, difference_be = b - e;
    const Numbers plus = PlusTurned(difference_ac, difference_be), minus = MinusTurned(difference_ac, difference_be);
    return {sum_ac + sum_be, forward ? minus : plus, sum_ac - sum_be, forward ? plus : minus};
}

constexpr std::size_t scratch_row = 2 * batch_columns;

template <bool forward, class Layout>
HWY_INLINE void Step(const ColumnFft::Plan& plan, std::size_t length, const ColumnFft::Factor* factors, const float* in,
                     std::size_t in_row, float* scratch) {
    const D d;
    const std::size_t part = length / 4;
    for (std::size_t group = 0; group < plan.length; group += length)
        for (std::size_t j = 0; j < part; ++j) {
            const ColumnFft::Factor* w = factors + 3 * j;
            float* y = scratch + (group + j) * scratch_row;
            for (std::size_t i = 0; i < batch_columns; i += hn::Lanes(d)) {
                const Four four = Butterfly<forward, Layout>(d, in + (group + j) * in_row, part * in_row, i);
                InSplit::Store(d, four.a, y, i);
                InSplit::Store(d, Times(d, four.b, w[0]), y + part * scratch_row, i);
                InSplit::Store(d, Times(d, four.c, w[1]), y + 2 * part * scratch_row, i);
                InSplit::Store(d, Times(d, four.d, w[2]), y + 3 * part * scratch_row, i);
            }
        }
}

// All steps for sixteen columns. The first step reads the source; the last step writes the result.
template <bool forward, class From, class To>
void TransformBlock(const ColumnFft::Plan& plan, const float* from, std::size_t from_row, float* to, std::size_t to_row,
                    float* scratch) {
    const D d;
    const ColumnFft::Factor* factors = plan.factors[forward ? 1 : 0].data();
    std::size_t length = plan.length;
    Step<forward, From>(plan, length, factors, from, from_row, scratch);
    for (factors += 3 * (length / 4), length /= 4; length > 4; factors += 3 * (length / 4), length /= 4)
        Step<forward, InSplit>(plan, length, factors, scratch, scratch_row, scratch);
    const auto put = [&](const Numbers& x, std::size_t row_index, std::size_t i) {
        To::Store(d, x, to + plan.order[row_index] * to_row, i);
    };
    for (std::size_t row = 0; row < plan.length; row += length)
        for (std::size_t i = 0; i < batch_columns; i += hn::Lanes(d)) {
            const float* x = scratch + row * scratch_row;
            if (length == 4) {
                const Four four = Butterfly<forward, InSplit>(d, x, scratch_row, i);
                put(four.a, row, i);
                put(four.b, row + 1, i);
                put(four.c, row + 2, i);
                put(four.d, row + 3, i);
            } else {
                const Numbers a = InSplit::Load(d, x, i), b = InSplit::Load(d, x + scratch_row, i);
                put(a + b, row, i);
                put(a - b, row + 1, i);
            }
        }
}

void TransformColumns(const ColumnFft::Plan& plan, bool forward, const float* from, std::size_t from_row, float* to,
                      std::size_t to_row, std::size_t floats) {
    const core::ThreadBuffer<float> scratch(plan.length * scratch_row);
    for (std::size_t i = 0; i < floats; i += scratch_row)
        if (forward)
            TransformBlock<true, Interleaved, Interleaved>(plan, from + i, from_row, to + i, to_row, scratch.data());
        else
            TransformBlock<false, Interleaved, Interleaved>(plan, from + i, from_row, to + i, to_row, scratch.data());
}

void TransformSplit(const ColumnFft::Plan& plan, float* columns) {
    TransformBlock<false, InSplit, InSplit>(plan, columns, scratch_row, columns, scratch_row,
                                            core::ThreadBuffer<float>(plan.length * scratch_row).data());
}

void TransformSplitToInterleaved(const ColumnFft::Plan& plan, const float* from, float* to, std::size_t to_row,
                                 std::size_t floats) {
    const core::ThreadBuffer<float> scratch(plan.length * scratch_row);
    const bool aligned = (reinterpret_cast<std::uintptr_t>(to) | to_row * sizeof(float)) % 64 == 0;
    const bool streamed = aligned && to_row > floats;
    for (std::size_t i = 0; i < floats; i += scratch_row, from += plan.length * scratch_row)
        if (streamed)
            TransformBlock<false, InSplit, Streamed>(plan, from, scratch_row, to + i, to_row, scratch.data());
        else
            TransformBlock<false, InSplit, Interleaved>(plan, from, scratch_row, to + i, to_row, scratch.data());
    if (streamed) hwy::FlushStream();
}
#endif

}  // namespace hogel::math::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <bit>
#include <cmath>
#include <numbers>

namespace hogel::math {
namespace {

ColumnFft::Factor factor_of(double cycles) {
    return {static_cast<float>(std::cos(2 * std::numbers::pi * cycles)),
            static_cast<float>(std::sin(2 * std::numbers::pi * cycles))};
}

}  // namespace

HWY_EXPORT(HasVectors);
HWY_EXPORT(TransformColumns);
HWY_EXPORT(TransformSplit);
HWY_EXPORT(TransformSplitToInterleaved);

bool ColumnFft::can(std::size_t length, std::size_t columns) {
    return length >= shortest && std::has_single_bit(length) && columns > 0 && columns % batch_columns == 0 &&
           HWY_DYNAMIC_DISPATCH(HasVectors)();
}

ColumnFft::ColumnFft(std::size_t length) : plan_{length, {0}, {}} {
    std::size_t rest = length;
    for (; rest > 4; rest /= 4)
        for (std::size_t j = 0; j < rest / 4; ++j)
            for (std::size_t k = 1; k < 4; ++k) {
                const double cycles = static_cast<double>(j * k) / static_cast<double>(rest);
                plan_.factors[0].push_back(factor_of(cycles));
                plan_.factors[1].push_back(factor_of(-cycles));
            }
    // Each step orders frequencies by their remainder modulo its radix: frequency f of part k is frequency k + radix ·
    // f.
    std::size_t parts = 1;
    for (std::size_t step = rest;; step = 4) {
        std::vector<std::uint32_t> order;
        for (std::size_t k = 0; k < step; ++k)
            for (const std::uint32_t f : plan_.order) order.push_back(static_cast<std::uint32_t>(k + step * f));
        plan_.order = std::move(order);
        parts *= step;
        if (parts == length) break;
    }
}

void ColumnFft::transform(bool forward, const std::complex<float>* from, std::size_t from_row, std::complex<float>* to,
                          std::size_t to_row, std::size_t columns) const {
    HWY_DYNAMIC_DISPATCH(TransformColumns)
    (plan_, forward, reinterpret_cast<const float*>(from), 2 * from_row, reinterpret_cast<float*>(to), 2 * to_row,
     2 * columns);
}

void ColumnFft::backward_split(float* columns) const { HWY_DYNAMIC_DISPATCH(TransformSplit)(plan_, columns); }

void ColumnFft::backward_split(const float* from, std::complex<float>* to, std::size_t to_row,
                               std::size_t columns) const {
    HWY_DYNAMIC_DISPATCH(TransformSplitToInterleaved)
    (plan_, from, reinterpret_cast<float*>(to), 2 * to_row, 2 * columns);
}

}  // namespace hogel::math
#endif
