// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "hogel/error.h"

namespace hogel::core {

// Returns the code of the Error that a call throws. Fails the test if the call throws none.
ErrorCode code_of(const auto& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.code();
    }
    ADD_FAILURE() << "no error";
    return ErrorCode::internal;
}

// Returns whether a call is cancelled. Any other Error fails the test.
bool is_cancelled(const auto& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
        return true;
    }
    return false;
}

}  // namespace hogel::core
