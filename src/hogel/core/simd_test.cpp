// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/simd.h"

#include <gtest/gtest.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/core/simd_test.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hogel::core {
namespace HWY_NAMESPACE {

std::int64_t Target() { return HWY_TARGET; }

}  // namespace HWY_NAMESPACE
}  // namespace hogel::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "hogel/error.h"

namespace hogel::core {
namespace {

HWY_EXPORT(Target);

TEST(Targets, each_one_runs_and_afterwards_the_best_again) {
    const std::vector<std::int64_t> all = targets();
    for (const std::int64_t target : all) {
        use_target(target);
        EXPECT_EQ(HWY_DYNAMIC_DISPATCH(Target)(), target) << target_name(target);
        EXPECT_EQ(targets(), all) << "whatever is in use";
        use_target(0);
        EXPECT_EQ(HWY_DYNAMIC_DISPATCH(Target)(), all.front());
    }
    EXPECT_THROW(use_target(1), Error);
}

}  // namespace
}  // namespace hogel::core
#endif
