// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "hogel/core/simd.h"

namespace hogel::core {

/// A fixture whose tests (TEST_P) run once on each SIMD target of this machine. A test file declares it so:
///     HOGEL_TEST_ON_EVERY_TARGET(ColumnFft);
///     TEST_P(ColumnFft, …) { … }
class OnEveryTarget : public ::testing::TestWithParam<std::int64_t> {
  protected:
    OnEveryTarget() { use_target(GetParam()); }
    ~OnEveryTarget() override { use_target(0); }
};

}  // namespace hogel::core

// NOLINTBEGIN(bugprone-macro-parentheses): a name is declared.
#define HOGEL_TEST_ON_EVERY_TARGET(suite)                                                   \
    class suite : public ::hogel::core::OnEveryTarget {};                                   \
    INSTANTIATE_TEST_SUITE_P(Targets, suite, ::testing::ValuesIn(::hogel::core::targets()), \
                             [](const auto& test) { return ::hogel::core::target_name(test.param); })
// NOLINTEND(bugprone-macro-parentheses)
