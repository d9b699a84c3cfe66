// SPDX-License-Identifier: Apache-2.0
// Masks as bits of an integer. To be included after hwy/highway.h, once for every SIMD target.
#if defined(HOGEL_RENDER_EPI_LANE_BITS) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_RENDER_EPI_LANE_BITS
#undef HOGEL_RENDER_EPI_LANE_BITS
#else
#define HOGEL_RENDER_EPI_LANE_BITS
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace hogel::render::epi::HWY_NAMESPACE {

// Returns a mask as bits: bit i is lane i.
template <class D>
HWY_INLINE std::uint64_t bits_of(D d, hwy::HWY_NAMESPACE::Mask<D> mask) {
    std::uint8_t bytes[8] = {};
    hwy::HWY_NAMESPACE::StoreMaskBits(d, mask, bytes);
    std::uint64_t bits;
    std::memcpy(&bits, bytes, sizeof(bits));
    return bits;
}

}  // namespace hogel::render::epi::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
