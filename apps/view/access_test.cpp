// SPDX-License-Identifier: Apache-2.0
#include "view/access.h"

#include <gtest/gtest.h>

namespace hogel::view {
namespace {

const Access local("127.0.0.1", 8080, "");

TEST(Access, the_own_page_sees_pictures) {
    for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080"}) {
        const std::string origin = "http://" + std::string(host);
        EXPECT_EQ(local.refusal({host, "", "", ""}), "") << host;
        EXPECT_EQ(local.refusal({host, origin, "same-origin", ""}), "") << host;
        EXPECT_EQ(local.refusal({host, "", "none", ""}), "") << host;
    }
}

// DNS rebinding: a foreign host name resolves to this machine.
TEST(Access, a_rebound_name_is_refused) {
    for (const char* host : {"evil.example:8080", "evil.example", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:18080", "",
                             "127.0.0.1:8080.evil.example", "evil127.0.0.1:8080", "127.0.0.1:8080:8080"}) {
        EXPECT_NE(local.refusal({host, "", "", ""}), "") << host;
        EXPECT_NE(local.refusal_of_page({host, "", "", ""}), "") << host;
    }
}

TEST(Access, a_page_from_elsewhere_is_refused) {
    for (const char* origin : {"http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1:8081", "null",
                               "http://localhost:8080", "http://127.0.0.1:8080.evil.example"})
        EXPECT_NE(local.refusal({"127.0.0.1:8080", origin, "", ""}), "") << origin;
    for (const char* site : {"cross-site", "same-site"})
        EXPECT_NE(local.refusal({"127.0.0.1:8080", "", site, ""}), "") << site;
    // Links from other pages are allowed.
    EXPECT_EQ(local.refusal_of_page({"127.0.0.1:8080", "", "cross-site", ""}), "");
}

TEST(Access, a_token_is_asked_for_whatever_the_name) {
    const Access open("0.0.0.0", 8080, "0123456789abcdef");
    EXPECT_EQ(open.refusal({"192.168.1.5:8080", "http://192.168.1.5:8080", "same-origin", "0123456789abcdef"}), "");
    for (const char* token : {"", "0123456789abcdeg", "0123456789abcde", "0123456789abcdef0"})
        EXPECT_NE(open.refusal({"192.168.1.5:8080", "", "", token}), "") << token;
    EXPECT_NE(open.refusal({"192.168.1.5:8080", "http://evil.example", "", "0123456789abcdef"}), "");
}

TEST(Access, texts_are_equal_or_not) {
    EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
    EXPECT_TRUE(equal_in_constant_time("", ""));
    for (const auto& [a, b] :
         {std::pair{"abc", "abd"}, {"abc", "ab"}, {"ab", "abc"}, {"", "a"}, {"a", ""}, {"aa", "a"}})
        EXPECT_FALSE(equal_in_constant_time(a, b)) << a << " " << b;
}

}  // namespace
}  // namespace hogel::view
