// SPDX-License-Identifier: Apache-2.0
// All passes of a transform of sixteen adjacent lines, for the SIMD target that is being compiled.
#if defined(HOGEL_MATH_FOURIER_PASSES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_MATH_FOURIER_PASSES_INL_H
#undef HOGEL_MATH_FOURIER_PASSES_INL_H
#else
#define HOGEL_MATH_FOURIER_PASSES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hogel/math/fourier/butterflies-inl.h"
#include "hogel/math/fourier/plan.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::math::fourier::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR
// Rows in memory. `row`: number of floats between the starts of rows.
struct Source {
    const float* data;
    std::size_t row;
};
// Rows of a result. With an order, writes row i to row order[i].
struct Sink {
    float* data;
    std::size_t row;
    const std::uint32_t* order;
};

// One pass over `groups` groups of rows. In the last pass each group is one butterfly without factors.
template <std::size_t radix, class From>
HWY_NOINLINE void PassOver(std::size_t groups, std::size_t part, const float* factors, Source from, float* out,
                           std::size_t lanes) {
    const D d;
    for (std::size_t group = 0; group < groups; ++group) {
        const float* w = factors;
        for (std::size_t j = 0; j < part; ++j, w += 2 * (radix - 1)) {
            const float* in = from.data + (group * part * radix + j) * from.row;
            float* to = out + (group * part * radix + j) * split_row;
            for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
                Numbers x[radix];
#pragma GCC unroll 16
                for (std::size_t k = 0; k < radix; ++k) x[k] = From::Load(d, in + k * part * from.row, i);
                Butterfly<radix>::Run(d, x);
                InSplit::Store(d, x[0], to, i);
#pragma GCC unroll 16
                for (std::size_t k = 1; k < radix; ++k)
                    InSplit::Store(d, Times(x[k], hn::Set(d, w[2 * k - 2]), hn::Set(d, w[2 * k - 1])),
                                   to + k * part * split_row, i);
            }
        }
    }
}

template <std::size_t radix, class To>
HWY_NOINLINE void LastPass(std::size_t groups, const float* in, Sink to, std::size_t lanes) {
    const D d;
    for (std::size_t group = 0; group < groups; ++group, in += radix * split_row)
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
            Numbers x[radix];
#pragma GCC unroll 16
            for (std::size_t k = 0; k < radix; ++k) x[k] = InSplit::Load(d, in + k * split_row, i);
            Butterfly<radix>::Run(d, x);
#pragma GCC unroll 16
            for (std::size_t k = 0; k < radix; ++k) {
                const std::size_t row = to.order ? to.order[group * radix + k] : group * radix + k;
                To::Store(d, x[k], to.data + row * to.row, i);
            }
        }
}

template <class Run>
HWY_INLINE void WithRadix(std::size_t radix, const Run& run) {
    switch (radix) {
        case 2:
            return run.template operator()<2>();
        case 3:
            return run.template operator()<3>();
        case 4:
            return run.template operator()<4>();
        case 5:
            return run.template operator()<5>();
        case 7:
            return run.template operator()<7>();
        case 8:
            return run.template operator()<8>();
        case 11:
            return run.template operator()<11>();
        default:
            return run.template operator()<13>();
    }
}

// Maximum number of rows per pass. Above it the groups run one after the other, to stay in the first-level cache.
constexpr std::size_t max_rows_by_pass = 192;

template <class From, class To>
void Passes(const Plan& plan, std::size_t index, std::size_t rows, Source from, float* scratch, Sink to,
            std::size_t lanes) {
    const Plan::Pass& pass = plan.passes[index];
    const std::size_t groups = rows / pass.length, part = pass.length / pass.radix;
    if (index + 1 == plan.passes.size()) {
        WithRadix(pass.radix, [&]<std::size_t radix>() { LastPass<radix, To>(groups, scratch, to, lanes); });
        return;
    }
    WithRadix(pass.radix, [&]<std::size_t radix>() {
        PassOver<radix, From>(groups, part, plan.factors.data() + pass.factors, from, scratch, lanes);
    });
    const std::size_t step = rows > max_rows_by_pass ? part : rows;
    for (std::size_t row = 0; row < rows; row += step) {
        const Sink result{to.order ? to.data : to.data + row * to.row, to.row, to.order ? to.order + row : nullptr};
        float* group_scratch = scratch + row * split_row;
        Passes<InSplit, To>(plan, index + 1, step, {group_scratch, split_row}, group_scratch, result, lanes);
    }
}

// Transforms all rows. `scratch` may be the source if the source has split layout.
template <class From, class To>
void TransformRows(const Plan& plan, Source from, float* scratch, Sink to, std::size_t columns) {
    const D d;
    const std::size_t lanes = (columns + hn::Lanes(d) - 1) / hn::Lanes(d) * hn::Lanes(d);
    if (plan.passes.size() > 1) return Passes<From, To>(plan, 0, plan.length, from, scratch, to, lanes);
    for (std::size_t row = 0; row < plan.length; ++row)
        for (std::size_t i = 0; i < lanes; i += hn::Lanes(d))
            InSplit::Store(d, From::Load(d, from.data + row * from.row, i), scratch + row * split_row, i);
    if (plan.passes.size() == 1) return Passes<InSplit, To>(plan, 0, plan.length, {}, scratch, to, lanes);
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) To::Store(d, InSplit::Load(d, scratch, i), to.data, i);
}
// Transforms in place, without reordering: frequency f is in row plan.position[f].
HWY_INLINE void TransformInPlace(const Plan& plan, float* rows, std::size_t columns) {
    TransformRows<InSplit, InSplit>(plan, {rows, split_row}, rows, {rows, split_row, nullptr}, columns);
}

// Bluestein's convolution of rows in split layout. Frequency f of the result is in row plan.position[f] of `result`.
HWY_INLINE void Convolve(const Plan& plan, const Chirp& chirp, std::size_t length, float* rows, float* result,
                         std::size_t columns) {
    const D d;
    const auto times = [&](const float* x, const float* factor, float* out, bool exchange_x, bool exchange_out) {
        const V re = hn::Set(d, factor[0]), im = hn::Set(d, factor[1]);
        for (std::size_t i = 0; i < batch_lines; i += hn::Lanes(d)) {
            Numbers value = InSplit::Load(d, x, i);
            if (exchange_x) std::swap(value.re, value.im);
            value = Times(value, re, im);
            if (exchange_out) std::swap(value.re, value.im);
            InSplit::Store(d, value, out, i);
        }
    };
    for (std::size_t j = 0; j < length; ++j)
        times(rows + j * split_row, chirp.chirp.data() + 2 * j, rows + j * split_row, false, false);
    std::fill(rows + length * split_row, rows + plan.length * split_row, 0.0f);
    TransformInPlace(plan, rows, columns);
    for (std::size_t f = 0; f < plan.length; ++f)
        times(rows + plan.position[f] * split_row, chirp.spectrum.data() + 2 * f, result + f * split_row, false, true);
    TransformInPlace(plan, result, columns);
    for (std::size_t k = 0; k < length; ++k) {
        float* row = result + plan.position[k] * split_row;
        times(row, chirp.chirp.data() + 2 * k, row, true, false);
    }
}
#endif

}  // namespace hogel::math::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
