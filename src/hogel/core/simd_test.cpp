// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/simd.h"

#include <gtest/gtest.h>

#include "hogel/core/simd_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::core::HWY_NAMESPACE {

std::int64_t Target() { return HWY_TARGET; }

}  // namespace hogel::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "hogel/error.h"

namespace hogel::core {
namespace {

extern std::int64_t (&target_in_use)();
HOGEL_DISPATCH(target_in_use, Target);

TEST(Targets, each_one_runs_and_afterwards_the_best_again) {
    const std::vector<std::int64_t> all = targets();
    for (const std::int64_t target : all) {
        use_target(target);
        EXPECT_EQ(target_in_use(), target) << target_name(target);
        EXPECT_EQ(targets(), all) << "whatever is in use";
        use_target(0);
        EXPECT_EQ(target_in_use(), all.front());
    }
    EXPECT_THROW(use_target(1), Error);
}

}  // namespace
}  // namespace hogel::core
#endif
