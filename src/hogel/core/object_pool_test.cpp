// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/object_pool.h"

#include <gtest/gtest.h>

#include <atomic>

#include "hogel/core/parallel.h"

namespace hogel::core {
namespace {

TEST(ObjectPool, what_is_given_back_is_taken_next) {
    ObjectPool<std::vector<int>> rooms;
    const int* first = nullptr;
    {
        auto room = rooms.take();
        room->assign(100, 3);
        first = room->data();
    }
    auto again = rooms.take(), other = rooms.take();
    EXPECT_EQ(again->data(), first);
    EXPECT_EQ(again->size(), 100u);
    EXPECT_TRUE(other->empty()) << "two at once are two";
}

TEST(ObjectPool, nobody_has_what_another_has) {
    struct Room {
        std::atomic<int> guests{0};
    };
    ObjectPool<Room> rooms;
    std::atomic<int> shared{0};
    parallel_for(1000, [&](std::size_t) {
        auto room = rooms.take();
        if (++room->guests != 1) ++shared;
        --room->guests;
    });
    EXPECT_EQ(shared, 0);
}

}  // namespace
}  // namespace hogel::core
