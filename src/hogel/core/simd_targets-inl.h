// SPDX-License-Identifier: Apache-2.0
// Compiles the including source once for every SIMD target: Highway includes it again by the name HWY_TARGET_INCLUDE,
// which cmake/HogelModule.cmake defines for all *_simd.cpp. No include guard: each target reads this header.
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

// HOGEL_DISPATCH(name, Target) defines the function reference `name`, declared in a header with the same type as
// Target. Each call goes to Target of the active SIMD target. Place the macro after HWY_AFTER_NAMESPACE(), in the
// namespace of `name`:
//     float sum_plain(const float* values, std::size_t count);    // in sum.h
//     extern decltype(sum_plain)& sum;
//     HOGEL_DISPATCH(sum, Sum);                                   // in sum_simd.cpp
#undef HOGEL_DISPATCH
#if HWY_ONCE
#include <utility>

namespace hogel::core {

/// Calls the function pointer that Choose()() returns.
template <class Choose, class Result, class... Arguments>
Result call_chosen(Arguments... arguments) {
    Result (*const function)(Arguments...) = Choose()();
    return function(std::forward<Arguments>(arguments)...);
}

}  // namespace hogel::core

// NOLINTBEGIN(bugprone-macro-parentheses): a name is declared.
#define HOGEL_DISPATCH(name, Target) \
    HWY_EXPORT(Target);              \
    constinit decltype(name) name = ::hogel::core::call_chosen<decltype([] { return &HWY_DYNAMIC_DISPATCH(Target); })>
// NOLINTEND(bugprone-macro-parentheses)
#else
#define HOGEL_DISPATCH(name, Target) static_assert(true)
#endif
