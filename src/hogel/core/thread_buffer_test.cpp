// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/thread_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

namespace hogel::core {
namespace {

TEST(ThreadBuffer, has_memory_of_its_own_while_others_exist) {
    const ThreadBuffer<float> outer(1000);
    std::ranges::fill(outer, 1.0f);
    const float* inner_memory = nullptr;
    {
        const ThreadBuffer<float> inner(2000);
        std::ranges::fill(inner, 2.0f);
        inner_memory = inner.data();
    }
    EXPECT_EQ(std::ranges::count(outer, 1.0f), 1000);
    const ThreadBuffer<float> next(1500);  // not larger than the inner one
    EXPECT_EQ(next.data(), inner_memory);
    EXPECT_EQ(next.size(), 1500u);
}

TEST(ThreadBuffer, belongs_to_a_thread) {
    const ThreadBuffer<int> here(100);
    const int* there = nullptr;
    std::jthread([&] { there = ThreadBuffer<int>(100).data(); }).join();
    EXPECT_NE(there, here.data());
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(here.data()) % 64, 0u);
}

}  // namespace
}  // namespace hogel::core
