// SPDX-License-Identifier: Apache-2.0
// Loops with a compile-time number of sums, compiled once per SIMD target. Include it after hwy/highway.h.
#if defined(HOGEL_CORE_WITH_COUNT) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_CORE_WITH_COUNT
#undef HOGEL_CORE_WITH_COUNT
#else
#define HOGEL_CORE_WITH_COUNT
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace hogel::core::HWY_NAMESPACE {

// Calls use(std::integral_constant<count>) for a count of 1 … max.
template <std::size_t max, class Use>
HWY_INLINE void with_count(std::size_t count, const Use& use) {
    if constexpr (max > 0) {
        if (count == max)
            use(std::integral_constant<std::size_t, max>());
        else
            with_count<max - 1>(count, use);
    }
}

}  // namespace hogel::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
