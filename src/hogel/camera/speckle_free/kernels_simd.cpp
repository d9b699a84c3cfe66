// SPDX-License-Identifier: Apache-2.0
// Vector twins of kernels.cpp, compiled for every SIMD target and chosen when first called.
#include <algorithm>
#include <vector>

#include "hogel/camera/speckle_free/kernels.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/core/with_count.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::speckle_free::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using core::HWY_NAMESPACE::with_count;

using D = hn::CappedTag<float, PsfBasis::lanes>;
using V = hn::Vec<D>;
constexpr std::size_t lanes = PsfBasis::lanes;

// Number of sums in registers; some targets have 32 registers.
constexpr std::size_t sums_per_pass = HWY_ARCH_X86 && HWY_TARGET > HWY_AVX3 ? 8 : 12;

// out[i][…] = Σ_j weights[j · stride + i] in[j][…], sixteen numbers per row.
template <std::size_t count>
HWY_INLINE void weighted_sums(const float* in, std::size_t in_row, std::size_t length, const float* weights,
                              std::size_t stride, std::size_t weight, float* out, std::size_t out_row) {
    const D d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        V sum[count];
        for (V& accumulator : sum) accumulator = hn::Zero(d);
        for (std::size_t j = 0; j < length; ++j) {
            const V value = hn::LoadU(d, in + j * in_row + i);
            for (std::size_t k = 0; k < count; ++k)
                sum[k] = hn::MulAdd(hn::Set(d, weights[j * stride + k * weight]), value, sum[k]);
        }
        for (std::size_t k = 0; k < count; ++k) hn::StoreU(sum[k], d, out + k * out_row + i);
    }
}

void SumPowers(const PsfBasis& basis, const PsfBasis::Weights& columns, const PsfBasis::Weights& rows,
               const float* powers, float* out) {
    const std::size_t n = basis.samples(), count = basis.count(), padded = basis.padded_count();
    const std::size_t blocks = (n + lanes - 1) / lanes;
    const core::ThreadBuffer<float> scratch(count * blocks * lanes);
    float* lines = scratch.data();  // [wave across][row]
    for (std::size_t first = 0; first < count; first += sums_per_pass)
        with_count<sums_per_pass>(std::min(sums_per_pass, count - first), [&](auto fixed_count) {
            for (std::size_t block = 0; block < blocks; ++block)
                weighted_sums<fixed_count()>(powers + block * n * lanes, lanes, n, columns.first + first,
                                             columns.stride, 1, lines + first * blocks * lanes + block * lanes,
                                             blocks * lanes);
            for (std::size_t y = 0; y < padded; y += lanes)
                weighted_sums<fixed_count()>(rows.first + y, rows.stride, n, lines + first * blocks * lanes, 1,
                                             blocks * lanes, out + first * padded + y, padded);
        });
}

void Multiply(View<const float, 2> weights, View<const float, 2> in, View<float, 2> out) {
    const std::size_t width = out.extent(1);
    for (std::size_t first = 0; first < out.extent(0); first += sums_per_pass)
        with_count<sums_per_pass>(std::min(sums_per_pass, out.extent(0) - first), [&](auto fixed_count) {
            for (std::size_t x = 0; x < width; x += lanes)
                weighted_sums<fixed_count()>(&in(0, x), width, in.extent(0), &weights(first, 0), 1, weights.extent(1),
                                             &out(first, x), width);
        });
}

// Few sums have several accumulators each, because an addition waits for the one before.
template <std::size_t a_count, std::size_t b_count>
HWY_INLINE void products(const Lines& lines, float* sums) {
    constexpr std::size_t count = a_count * b_count, parts = count >= 8 ? 1 : count >= 3 ? 2 : 4;
    const D d;
    const std::size_t width = hn::Lanes(d);
    V sum[count][parts];
    for (auto& accumulator : sum)
        for (V& part : accumulator) part = hn::Zero(d);
    float tail_sums[count] = {};
    for (std::size_t row = 0; row < lines.rows; ++row) {
        const float *a[a_count], *b[b_count];
        for (std::size_t k = 0; k < a_count; ++k) a[k] = lines.a[k] + row * lines.a_row;
        for (std::size_t k = 0; k < b_count; ++k) b[k] = lines.b[k] + row * lines.b_row;
        const auto add = [&](std::size_t i, std::size_t part) HWY_ATTR {
            V factors[b_count];
            for (std::size_t k = 0; k < b_count; ++k) factors[k] = hn::LoadU(d, b[k] + i);
            for (std::size_t k = 0; k < a_count; ++k) {
                const V value = hn::LoadU(d, a[k] + i);
                for (std::size_t l = 0; l < b_count; ++l)
                    sum[k * b_count + l][part] = hn::MulAdd(value, factors[l], sum[k * b_count + l][part]);
            }
        };
        std::size_t i = 0;
        for (; i + parts * width <= lines.length; i += parts * width)
            for (std::size_t part = 0; part < parts; ++part) add(i + part * width, part);
        for (; i + width <= lines.length; i += width) add(i, 0);
        for (; i < lines.length; ++i)
            for (std::size_t k = 0; k < count; ++k) tail_sums[k] += a[k / b_count][i] * b[k % b_count][i];
    }
    for (std::size_t k = 0; k < count; ++k) {
        V total = sum[k][0];
        for (std::size_t part = 1; part < parts; ++part) total = hn::Add(total, sum[k][part]);
        sums[k] = hn::GetLane(hn::SumOfLanes(d, total)) + tail_sums[k];
    }
}

void SumProducts(const Lines& lines, float* sums) {
    with_count<max_b_per_pass>(lines.b.size(), [&](auto b) HWY_ATTR {
        with_count<max_a_per_pass(b())>(lines.a.size(), [&](auto a) HWY_ATTR { products<a(), b()>(lines, sums); });
    });
}

}  // namespace hogel::camera::speckle_free::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::camera::speckle_free {

HWY_EXPORT(SumProducts);

HOGEL_DISPATCH(sum_powers, SumPowers);
void sum_products(const Lines& lines, float* sums) { HWY_DYNAMIC_DISPATCH(SumProducts)(lines, sums); }
HOGEL_DISPATCH(multiply, Multiply);

}  // namespace hogel::camera::speckle_free
#endif
