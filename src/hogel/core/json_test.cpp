// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/json.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <stop_token>

#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"

namespace hogel::core {
namespace {

void throw_fault(const std::string& fault) { throw Error(ErrorCode::bad_input, fault); }

nlohmann::json parsed(const std::string& text) { return parse_json(text, throw_fault); }

std::string fault_of(const std::string& text) {
    try {
        parsed(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        return error.what();
    }
    return "none";
}

std::string repeated(std::size_t count, const std::string& value) {
    std::string text = "[" + value;
    for (std::size_t i = 1; i < count; ++i) text += "," + value;
    return text + "]";
}

TEST(ParseJson, gives_what_the_library_gives) {
    for (const char* text :
         {"null", "[]", "{}", " -12 ", "1.5e3", R"("a\u00e9")", R"({"a":[1,-2,3.5,true,false,null,"x"],"b":{"c":{}}})",
          R"([[[]],[{"k":[{}]}],{"":""}])", "18446744073709551615", "123456789012345678901234567890"})
        EXPECT_EQ(parsed(text), nlohmann::json::parse(text)) << text;
}

TEST(ParseJson, names_the_fault) {
    EXPECT_EQ(fault_of("[1,]"), "its JSON has an error at byte 4");
    EXPECT_EQ(fault_of(""), "its JSON has an error at byte 1");
    EXPECT_EQ(fault_of("[1] 2"), "its JSON has an error at byte 5");
    EXPECT_EQ(fault_of("[\"\xff\"]"), "its JSON has an error at byte 3");
    EXPECT_EQ(fault_of("[1e999]"), "its JSON has a number out of range");
    EXPECT_EQ(fault_of(R"({"a":{"b":1,"c":2,"b":3}})"), R"(the key "b" occurs twice in one object of its JSON)");
    EXPECT_EQ(fault_of(R"([{"a":1},{"a":2}])"), "none");
    const std::string deepest = std::string(max_json_depth, '[') + std::string(max_json_depth, ']');
    EXPECT_EQ(fault_of(deepest), "none");
    EXPECT_EQ(fault_of("[" + deepest + "]"), "its JSON nests deeper than 100");
    EXPECT_EQ(fault_of(std::string(200000, '[')), "its JSON nests deeper than 100");
}

// With the parser's callbacks this took half an hour: each element searched all earlier ones.
TEST(ParseJson, takes_linear_time) {
    constexpr std::size_t count = max_json_values / 2;
    EXPECT_EQ(parsed(repeated(count, "{}")).size(), count);
}

TEST(ParseJson, takes_as_many_values_as_it_says) {
    EXPECT_EQ(parsed(repeated(max_json_values - 1, "0")).size(), max_json_values - 1);
    EXPECT_EQ(fault_of(repeated(max_json_values, "0")), "its JSON has more than 4194304 values");
}

TEST(ParseJson, stops_inside_one_text) {
    std::stop_source stop;
    const StopScope scope{Progress(stop.get_token())};
    const std::string text = "\"" + std::string(1 << 20, 'a') + "\"";
    EXPECT_EQ(parsed(text).get_ref<const std::string&>().size(), std::size_t{1} << 20);
    stop.request_stop();
    try {
        parsed(text);
        ADD_FAILURE() << "read to the end";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace hogel::core
