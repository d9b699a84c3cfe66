// SPDX-License-Identifier: Apache-2.0
// The last step of projections, for files that are compiled once for every SIMD target. To be included after
// hwy/highway.h.
#if defined(HOGEL_HOLOGRAM_EYE_ADD_NODES) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_HOLOGRAM_EYE_ADD_NODES
#undef HOGEL_HOLOGRAM_EYE_ADD_NODES
#else
#define HOGEL_HOLOGRAM_EYE_ADD_NODES
#endif

#include <hwy/highway.h>

#include "hogel/hologram/eye/project.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::hologram::eye {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
// Adds up to sixteen floats, complex numbers times their phases, to a row of a band.
HWY_INLINE void add_nodes(const float* nodes, const float* cosines, const float* sines, std::size_t floats,
                          float* band) {
    const hn::CappedTag<float, lanes> d;
    for (std::size_t i = 0; i < floats; i += hn::Lanes(d)) {
        const auto value = hn::Load(d, nodes + i);
        const auto turned =
            hn::MulAdd(hn::Shuffle2301(value), hn::Load(d, sines + i), hn::Mul(value, hn::Load(d, cosines + i)));
        if (floats - i >= hn::Lanes(d)) {
            hn::StoreU(hn::Add(hn::LoadU(d, band + i), turned), d, band + i);
        } else {
            const auto some = hn::FirstN(d, floats - i);
            hn::BlendedStore(hn::Add(hn::MaskedLoad(some, d, band + i), turned), some, d, band + i);
        }
    }
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::hologram::eye
HWY_AFTER_NAMESPACE();
#endif
