// SPDX-License-Identifier: Apache-2.0
// One lane per cell. Samples exceed the cache by far and are read in memory order.
#include "hogel/core/simd_targets-inl.h"
#include "hogel/render/cell_sums.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Floats = hn::Rebind<float, Doubles>;
using Sums = hn::Vec<Doubles>;

HWY_INLINE Sums Add(Sums sums, hn::Vec<Floats> samples) { return hn::Add(sums, hn::PromoteTo(Doubles(), samples)); }

template <std::size_t n>
HWY_INLINE Sums AddGroups(const float* row, Sums sums) {
    const Floats floats;
    hn::Vec<Floats> a, b, c, d;
    if constexpr (n == 1) {
        return Add(sums, hn::LoadU(floats, row));
    } else if constexpr (n == 2) {
        hn::LoadInterleaved2(floats, row, a, b);
        return Add(Add(sums, a), b);
    } else if constexpr (n == 3) {
        hn::LoadInterleaved3(floats, row, a, b, c);
        return Add(Add(Add(sums, a), b), c);
    } else {
        hn::LoadInterleaved4(floats, row, a, b, c, d);
        return Add(Add(Add(Add(sums, a), b), c), d);
    }
}

template <std::size_t n>
void AddRows(View<const float, 2> samples, View<double, 2> sums) {
    const Doubles doubles;
    const std::size_t lanes = hn::Lanes(doubles);
    for (std::size_t v = 0; v < sums.extent(0); ++v)
        for (std::size_t a = 0; a < n; ++a) {
            const float* row = &samples(n * v + a, 0);
            double* const sum = &sums(v, 0);
            std::size_t u = 0;
            for (; u + lanes <= sums.extent(1); u += lanes)
                hn::StoreU(AddGroups<n>(row + n * u, hn::LoadU(doubles, sum + u)), doubles, sum + u);
            for (; u < sums.extent(1); ++u)
                for (std::size_t b = 0; b < n; ++b) sum[u] += double{row[n * u + b]};
        }
}

void AddCells(View<const float, 2> samples, std::size_t n, View<double, 2> sums) {
    switch (n) {
        case 1:
            return AddRows<1>(samples, sums);
        case 2:
            return AddRows<2>(samples, sums);
        case 3:
            return AddRows<3>(samples, sums);
        case 4:
            return AddRows<4>(samples, sums);
        default:
            return add_cells_plain(samples, n, sums);
    }
}

}  // namespace hogel::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::render {

HOGEL_DISPATCH(add_cells, AddCells);

void add_cells_plain(View<const float, 2> samples, std::size_t n, View<double, 2> sums) {
    for (std::size_t v = 0; v < sums.extent(0); ++v)
        for (std::size_t a = 0; a < n; ++a) {
            const float* sample = &samples(n * v + a, 0);
            for (std::size_t u = 0; u < sums.extent(1); ++u) {
                double sum = sums(v, u);
                for (std::size_t b = 0; b < n; ++b) sum += double{*sample++};
                sums(v, u) = sum;
            }
        }
}

}  // namespace hogel::render
#endif
