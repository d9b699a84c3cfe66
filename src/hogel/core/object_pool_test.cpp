// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/object_pool.h"

#include <gtest/gtest.h>

#include <atomic>

#include "hogel/work/parallel.h"

namespace hogel::core {
namespace {

TEST(ObjectPool, the_object_returned_last_is_taken_next) {
    ObjectPool<std::vector<int>> buffers;
    const int* first = nullptr;
    {
        auto buffer = buffers.take();
        buffer->assign(100, 3);
        first = buffer->data();
    }
    auto again = buffers.take(), other = buffers.take();
    EXPECT_EQ(again->data(), first);
    EXPECT_EQ(again->size(), 100u);
    EXPECT_TRUE(other->empty()) << "two at once are two";
}

TEST(ObjectPool, an_object_has_one_user_at_a_time) {
    struct Buffer {
        std::atomic<int> users{0};
    };
    ObjectPool<Buffer> buffers;
    std::atomic<int> shared{0};
    work::parallel_for(1000, [&](std::size_t) {
        auto buffer = buffers.take();
        if (++buffer->users != 1) ++shared;
        --buffer->users;
    });
    EXPECT_EQ(shared, 0);
}

}  // namespace
}  // namespace hogel::core
