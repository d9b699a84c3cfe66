// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/freed_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <random>
#include <set>
#include <stop_token>
#include <thread>
#include <vector>

#include "hogel/array.h"
#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"

namespace hogel::core {
namespace {

constexpr std::size_t mega = std::size_t{1} << 20;

TEST(FreedBlocks, are_handed_out_again) {
    FreedBlocks blocks(64 * mega);
    void* first = blocks.allocate(10 * mega);
    EXPECT_EQ(blocks.kept(), 0u);
    blocks.free(first);
    EXPECT_EQ(blocks.in_use(), 0u);
    EXPECT_GE(blocks.kept(), 10 * mega);
    void* second = blocks.allocate(10 * mega - 5);
    EXPECT_EQ(second, first);
    EXPECT_EQ(blocks.kept(), 0u);
    blocks.free(second);
}

TEST(FreedBlocks, that_were_used_last_are_handed_out_first) {
    FreedBlocks blocks(64 * mega);
    void* first = blocks.allocate(10 * mega);
    void* second = blocks.allocate(10 * mega);
    blocks.free(first);
    blocks.free(second);
    for (int turn = 0; turn < 3; ++turn) {
        void* again = blocks.allocate(10 * mega);
        EXPECT_EQ(again, second);
        blocks.free(again);
    }
}

TEST(FreedBlocks, are_aligned_and_large_enough) {
    FreedBlocks blocks(64 * mega);
    for (std::size_t bytes : {std::size_t{1}, 2 * mega - 1, 2 * mega, 4 * mega, 7 * mega + 3}) {
        void* memory = blocks.allocate(bytes);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % (bytes < 4 * mega ? 64 : 2 * mega), 0u) << bytes;
        std::memset(memory, 1, bytes);
        EXPECT_GE(blocks.in_use(), bytes == 1 ? 0 : bytes);
        blocks.free(memory);
        EXPECT_EQ(blocks.in_use(), 0u);
    }
}

TEST(FreedBlocks, much_larger_ones_are_left_to_larger_requests) {
    FreedBlocks blocks(64 * mega, 8 * mega);
    void* large = blocks.allocate(3 * mega);
    blocks.free(large);
    void* small = blocks.allocate(mega);
    EXPECT_NE(small, large);
    EXPECT_LE(blocks.in_use(), 2 * mega);
    blocks.free(small);
}

TEST(FreedBlocks, larger_ones_are_used_before_they_have_to_go) {
    FreedBlocks blocks(1000 * mega);
    void* first = blocks.allocate(3 * mega);
    void* second = blocks.allocate(2 * mega);
    blocks.free(first);
    blocks.free(second);
    void* third = blocks.allocate(mega);
    EXPECT_EQ(third, second);
    blocks.free(third);
}

TEST(FreedBlocks, kept_and_used_are_no_more_than_was_used_before) {
    FreedBlocks blocks(1000 * mega);
    void* first = blocks.allocate(40 * mega);
    void* second = blocks.allocate(3 * mega);
    const std::size_t peak = blocks.in_use();
    blocks.free(first);
    blocks.free(second);
    // The kept block is too small: its size in pages is released.
    void* third = blocks.allocate(mega);
    EXPECT_LE(blocks.in_use() + blocks.kept(), peak);
    EXPECT_GE(blocks.kept(), 30 * mega);
    void* fourth = blocks.allocate(100 * mega);
    EXPECT_EQ(blocks.kept(), 0u);
    blocks.free(third);
    blocks.free(fourth);
}

// Returns whether each page of a block holds the mark.
bool has_marks(const std::byte* block, std::size_t bytes, int mark) {
    for (std::size_t i = 0; i < bytes; i += 4096)
        if (block[i] != static_cast<std::byte>(mark)) return false;
    return true;
}

// The sizes of each round match no block of the previous round.
TEST(FreedBlocks, pages_are_cut_and_joined_and_no_new_ones_are_taken) {
    FreedBlocks blocks(1000 * mega);
    std::vector<std::vector<std::size_t>> rounds = {{40, 40}};
    for (int turn = 0; turn < 10; ++turn)
        rounds.insert(rounds.end(), {{6, 50, 24}, {80}, {26, 26, 28}, {4, 4, 4, 68}, {40, 40}});
    std::size_t peak = 0;
    for (const auto& sizes : rounds) {
        std::vector<std::byte*> used;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            used.push_back(static_cast<std::byte*>(blocks.allocate(sizes[i] * mega)));
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(used[i]) % (2 * mega), 0u);
            std::memset(used[i], static_cast<int>(i) + 1, sizes[i] * mega);
        }
        for (std::size_t i = 0; i < sizes.size(); ++i)
            EXPECT_TRUE(has_marks(used[i], sizes[i] * mega, static_cast<int>(i) + 1)) << sizes[i];
        peak = std::max(peak, blocks.in_use());
        EXPECT_EQ(blocks.kept(), 0u);
        for (std::byte* block : used) blocks.free(block);
        EXPECT_EQ(blocks.new_pages(), 80 * mega);
    }
    EXPECT_EQ(peak, 80 * mega);
}

TEST(FreedBlocks, pages_in_use_stay_where_they_are_and_as_they_are) {
    FreedBlocks blocks(1000 * mega);
    auto* low = static_cast<std::byte*>(blocks.allocate(10 * mega));
    auto* middle = static_cast<std::byte*>(blocks.allocate(10 * mega));
    auto* high = static_cast<std::byte*>(blocks.allocate(10 * mega));
    std::memset(middle, 7, 10 * mega);
    blocks.free(low);
    blocks.free(high);
    void* joined = blocks.allocate(24 * mega);
    std::memset(joined, 9, 24 * mega);
    EXPECT_TRUE(has_marks(middle, 10 * mega, 7));
    EXPECT_EQ(blocks.in_use(), 34 * mega);
    EXPECT_EQ(blocks.kept(), 0u);
    blocks.free(joined);
    blocks.free(middle);
    EXPECT_EQ(blocks.kept(), 34 * mega);
}

// Films have 1 to 4 MiB and follow work with larger arrays.
TEST(FreedBlocks, those_of_megabytes_are_of_kept_pages) {
    FreedBlocks blocks(1000 * mega);
    void* large = blocks.allocate(40 * mega);
    std::memset(large, 1, 40 * mega);
    blocks.free(large);
    std::vector<void*> used;
    for (const std::size_t kilo : {2376u, 1100u, 3000u, 2048u, 1848u, 3568u, 1024u, 4000u}) {
        used.push_back(blocks.allocate(kilo << 10));
        std::memset(used.back(), 2, kilo << 10);
        EXPECT_EQ(blocks.in_use() + blocks.kept(), 40 * mega) << kilo;
    }
    EXPECT_EQ(blocks.new_pages(), 40 * mega);
    for (void* block : used) blocks.free(block);
    EXPECT_EQ(blocks.kept(), 40 * mega);
    // Most of the page would be unused.
    void* small = blocks.allocate(900 << 10);
    EXPECT_LT(blocks.in_use(), mega);
    blocks.free(small);
}

TEST(FreedBlocks, threads_get_blocks_of_their_own) {
    FreedBlocks blocks(200 * mega, 30 * mega);
    const auto work = [&](int mark) {
        std::minstd_rand random(static_cast<unsigned>(mark));
        for (int turn = 0; turn < 60; ++turn) {
            const std::size_t bytes = (std::size_t{1} << (16 + random() % 9)) + random() % mega;
            auto* block = static_cast<std::byte*>(blocks.allocate(bytes));
            for (std::size_t i = 0; i < bytes; i += 4096) block[i] = static_cast<std::byte>(mark);
            EXPECT_TRUE(has_marks(block, bytes, mark));
            blocks.free(block);
        }
    };
    std::vector<std::jthread> threads;
    for (int mark = 1; mark <= 4; ++mark) threads.emplace_back(work, mark);
    threads.clear();
    EXPECT_EQ(blocks.in_use(), 0u);
    EXPECT_LE(blocks.kept(), 200 * mega);
}

// malloc may return more than requested: a block that was not counted at allocation must not be counted when freed.
TEST(FreedBlocks, all_sizes_about_the_smallest_that_is_kept_are_counted_alike) {
    FreedBlocks blocks(64 * mega);
    std::vector<void*> used;
    for (int turn = 0; turn < 2; ++turn) {
        for (std::size_t bytes = 120000; bytes < 132000; bytes += 7) used.push_back(blocks.allocate(bytes));
        for (void* block : used) blocks.free(block);
        used.clear();
        ASSERT_EQ(blocks.in_use(), 0u);
    }
}

TEST(FreedBlocks, that_are_needed_in_turns_do_not_drive_out_each_other) {
    FreedBlocks blocks(1000 * mega, 30 * mega);
    void* result = blocks.allocate(100 * mega);
    void* large = blocks.allocate(3 * mega);
    blocks.free(large);
    void* small = blocks.allocate(mega);
    blocks.free(small);
    for (int turn = 0; turn < 3; ++turn) {
        void* again = blocks.allocate(3 * mega);
        EXPECT_EQ(again, large);
        blocks.free(again);
        again = blocks.allocate(mega);
        EXPECT_EQ(again, small);
        blocks.free(again);
    }
    EXPECT_LE(blocks.in_use() + blocks.kept(), 150 * mega);
    blocks.free(result);
}

TEST(FreedBlocks, no_more_are_kept_than_allowed) {
    FreedBlocks blocks(30 * mega);
    void* first = blocks.allocate(20 * mega);
    void* second = blocks.allocate(20 * mega);
    void* third = blocks.allocate(100 * mega);
    blocks.free(first);
    blocks.free(second);
    EXPECT_LE(blocks.kept(), 30 * mega);
    EXPECT_GE(blocks.kept(), 20 * mega);
    blocks.free(third);
    EXPECT_LE(blocks.kept(), 30 * mega);
}

TEST(FreedBlocks, more_or_fewer_are_kept_when_told) {
    FreedBlocks blocks(0);
    blocks.free(blocks.allocate(20 * mega));
    EXPECT_EQ(blocks.kept(), 0u);
    blocks.set_max_kept(40 * mega);
    blocks.free(blocks.allocate(20 * mega));
    EXPECT_GE(blocks.kept(), 20 * mega);
    blocks.set_max_kept(10 * mega);
    EXPECT_EQ(blocks.kept(), 10 * mega);
}

TEST(FreedBlocks, more_than_there_is_throws_and_counts_nothing) {
    FreedBlocks blocks(30 * mega);
    EXPECT_THROW(blocks.allocate(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
    EXPECT_THROW(blocks.allocate(std::size_t{1} << 60), std::bad_alloc);
    EXPECT_EQ(blocks.in_use(), 0u);
    EXPECT_EQ(blocks.new_pages(), 0u);
}

TEST(FreedBlocks, spare_arrays_the_faults_of_fresh_pages) {
    FreedBlocks blocks(64 * mega);
    for (int i = 0; i < 10; ++i) blocks.free(blocks.allocate(32 * mega));
    EXPECT_EQ(blocks.new_pages(), 32 * mega);
}

// Blocks have unspecified content; arrays are zero.
TEST(FreedBlocks, are_cleared_for_arrays) {
    for (int i = 0; i < 3; ++i) {
        Array<float, 2> array({1024, 1024});
        EXPECT_EQ(array(1023, 1023), 0.0F);
        array(1023, 1023) = 1.0F;
    }
}

// With a sanitizer every array has its own memory, so that the sanitizer sees its lifetime.
TEST(FreedBlocks, are_the_memory_of_arrays) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "arrays of a sanitized program do not use them";
#endif
    std::set<const float*> places;
    for (int i = 0; i < 3; ++i) places.insert(Array<float, 2>({1024, 1024}).data());
    EXPECT_EQ(places.size(), 1u);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Array, of_hundreds_of_megabytes_is_not_cleared_to_the_end_when_a_stop_is_requested) {
    std::stop_source stop;
    const StopScope scope{Progress(stop.get_token())};
    stop.request_stop();
    EXPECT_FALSE(is_cancelled([] { const Array<std::byte, 1> small({mega}); }));
    EXPECT_TRUE(is_cancelled([] { const Array<std::byte, 1> large({1024 * mega}); }));
}
#endif

}  // namespace
}  // namespace hogel::core
