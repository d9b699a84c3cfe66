// SPDX-License-Identifier: Apache-2.0
// The vector twins of kernels.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/optics/expected/kernels_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <vector>

#include "hogel/core/with_count.h"
#include "hogel/optics/expected/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::optics::expected {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using core::HWY_NAMESPACE::with_count;

using D = hn::CappedTag<float, SpotBasis::lanes>;
using V = hn::Vec<D>;
constexpr std::size_t lanes = SpotBasis::lanes;

// Sums that are held in registers.
constexpr std::size_t together = 8;

// out[i][…] = Σ_j weights[j · stride + i] in[j][…], sixteen numbers in a row.
template <std::size_t count>
HWY_INLINE void weighted(const float* in, std::size_t in_row, std::size_t length, const float* weights,
                         std::size_t stride, std::size_t weight, float* out, std::size_t out_row) {
    const D d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        V sum[count];
        for (V& one : sum) one = hn::Zero(d);
        for (std::size_t j = 0; j < length; ++j) {
            const V value = hn::LoadU(d, in + j * in_row + i);
            for (std::size_t k = 0; k < count; ++k)
                sum[k] = hn::MulAdd(hn::Set(d, weights[j * stride + k * weight]), value, sum[k]);
        }
        for (std::size_t k = 0; k < count; ++k) hn::StoreU(sum[k], d, out + k * out_row + i);
    }
}

void SumPowers(const SpotBasis& basis, const SpotBasis::Weights& columns, const SpotBasis::Weights& rows,
               const float* powers, float* out) {
    const std::size_t n = basis.samples(), count = basis.count(), padded = basis.padded_count();
    const std::size_t blocks = (n + lanes - 1) / lanes;
    thread_local std::vector<float> scratch;
    if (scratch.size() < count * blocks * lanes) scratch.resize(count * blocks * lanes);
    float* lines = scratch.data();  // [wave across][row]
    for (std::size_t first = 0; first < count; first += together)
        with_count<together>(std::min(together, count - first), [&](auto some) {
            for (std::size_t block = 0; block < blocks; ++block)
                weighted<some()>(powers + block * n * lanes, lanes, n, columns.first + first, columns.stride, 1,
                                 lines + first * blocks * lanes + block * lanes, blocks * lanes);
            for (std::size_t y = 0; y < padded; y += lanes)
                weighted<some()>(rows.first + y, rows.stride, n, lines + first * blocks * lanes, 1, blocks * lanes,
                                 out + first * padded + y, padded);
        });
}

float SumProducts(const Lines& lines) {
    const D d;
    const std::size_t width = hn::Lanes(d);
    V first = hn::Zero(d), second = first, third = first, fourth = first;
    float rest = 0;
    for (std::size_t row = 0; row < lines.rows; ++row) {
        const float *a = lines.a + row * lines.a_row, *b = lines.b + row * lines.b_row;
        std::size_t i = 0;
        for (; i + 4 * width <= lines.length; i += 4 * width) {
            first = hn::MulAdd(hn::LoadU(d, a + i), hn::LoadU(d, b + i), first);
            second = hn::MulAdd(hn::LoadU(d, a + i + width), hn::LoadU(d, b + i + width), second);
            third = hn::MulAdd(hn::LoadU(d, a + i + 2 * width), hn::LoadU(d, b + i + 2 * width), third);
            fourth = hn::MulAdd(hn::LoadU(d, a + i + 3 * width), hn::LoadU(d, b + i + 3 * width), fourth);
        }
        for (; i + width <= lines.length; i += width)
            first = hn::MulAdd(hn::LoadU(d, a + i), hn::LoadU(d, b + i), first);
        for (; i < lines.length; ++i) rest += a[i] * b[i];
    }
    const V sum = hn::Add(hn::Add(first, second), hn::Add(third, fourth));
    return hn::GetLane(hn::SumOfLanes(d, sum)) + rest;
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel::optics::expected
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::optics::expected {

HWY_EXPORT(SumPowers);
HWY_EXPORT(SumProducts);

void sum_powers(const SpotBasis& basis, const SpotBasis::Weights& columns, const SpotBasis::Weights& rows,
                const float* powers, float* out) {
    HWY_DYNAMIC_DISPATCH(SumPowers)(basis, columns, rows, powers, out);
}
float sum_products(const Lines& lines) { return HWY_DYNAMIC_DISPATCH(SumProducts)(lines); }

}  // namespace hogel::optics::expected
#endif
