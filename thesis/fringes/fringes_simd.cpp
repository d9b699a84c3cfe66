// SPDX-License-Identifier: Apache-2.0
// Vector twin of sum_fringes_plain, compiled for every SIMD target and selected at the first call.
#include "hogel/core/simd_targets-inl.h"
#include "thesis/fringes/fringe_table.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::fringes::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Keeps eight vectors of the sum in registers while it adds all fringes.
void SumFringes(std::span<const WeightedFringe> fringes, std::span<std::complex<float>> sum) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d), size = 2 * sum.size();
    auto* out = reinterpret_cast<float*>(sum.data());
    std::size_t i = 0;
    for (; i + 8 * lanes <= size; i += 8 * lanes) {
        auto s0 = hn::Zero(d), s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0, s6 = s0, s7 = s0;
        for (const auto& [fringe, weight] : fringes) {
            const float* from = reinterpret_cast<const float*>(fringe) + i;
            const auto w = hn::Set(d, weight);
            s0 = hn::MulAdd(w, hn::LoadU(d, from), s0);
            s1 = hn::MulAdd(w, hn::LoadU(d, from + lanes), s1);
            s2 = hn::MulAdd(w, hn::LoadU(d, from + 2 * lanes), s2);
            s3 = hn::MulAdd(w, hn::LoadU(d, from + 3 * lanes), s3);
            s4 = hn::MulAdd(w, hn::LoadU(d, from + 4 * lanes), s4);
            s5 = hn::MulAdd(w, hn::LoadU(d, from + 5 * lanes), s5);
            s6 = hn::MulAdd(w, hn::LoadU(d, from + 6 * lanes), s6);
            s7 = hn::MulAdd(w, hn::LoadU(d, from + 7 * lanes), s7);
        }
        hn::StoreU(s0, d, out + i);
        hn::StoreU(s1, d, out + i + lanes);
        hn::StoreU(s2, d, out + i + 2 * lanes);
        hn::StoreU(s3, d, out + i + 3 * lanes);
        hn::StoreU(s4, d, out + i + 4 * lanes);
        hn::StoreU(s5, d, out + i + 5 * lanes);
        hn::StoreU(s6, d, out + i + 6 * lanes);
        hn::StoreU(s7, d, out + i + 7 * lanes);
    }
    for (; i < size; ++i) {
        float s = 0;
        for (const auto& [fringe, weight] : fringes) s += weight * reinterpret_cast<const float*>(fringe)[i];
        out[i] = s;
    }
}

}  // namespace hogel::fringes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::fringes {
HOGEL_DISPATCH(sum_fringes, SumFringes);
}  // namespace hogel::fringes
