// SPDX-License-Identifier: Apache-2.0
#include "view/answers.h"

#include <gtest/gtest.h>

#include <vector>

namespace hogel::view {
namespace {

using Names = std::vector<std::string>;

Json failure_of(const Error& error) { return Json::parse(failure(error).body); }

TEST(Answers, list_the_parameters_of_an_error) {
    const Json both = failure_of(Error(ErrorCode::usage, "eye, pitch", "seen from too far"));
    EXPECT_EQ(both["message"], "seen from too far");
    EXPECT_EQ(both["parameter"], Names({"eye", "pitch"}));
    EXPECT_EQ(failure_of(Error(ErrorCode::usage, "focus", "no"))["parameter"], Names({"focus"}));
    EXPECT_EQ(failure_of(Error(ErrorCode::usage, "no"))["parameter"], Json::array());
    EXPECT_EQ(failure_of(Error(ErrorCode::bad_input, "focus", "no"))["parameter"], Json::array());
    EXPECT_EQ(Json::parse(failure(404, "no").body)["parameter"], Json::array());
}

}  // namespace
}  // namespace hogel::view
