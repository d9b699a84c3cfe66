// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/freed_blocks.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <new>

#include "hogel/array.h"

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
        EXPECT_GE(blocks.in_use(), bytes);
        blocks.free(memory);
        EXPECT_EQ(blocks.in_use(), 0u);
    }
}

TEST(FreedBlocks, much_larger_ones_are_left_to_larger_requests) {
    FreedBlocks blocks(64 * mega);
    void* large = blocks.allocate(40 * mega);
    blocks.free(large);
    void* small = blocks.allocate(10 * mega);
    EXPECT_NE(small, large);
    EXPECT_LE(blocks.in_use(), 12 * mega);
    blocks.free(small);
}

TEST(FreedBlocks, larger_ones_are_used_before_they_have_to_go) {
    FreedBlocks blocks(1000 * mega);
    void* first = blocks.allocate(40 * mega);
    void* second = blocks.allocate(20 * mega);
    blocks.free(first);
    blocks.free(second);
    void* third = blocks.allocate(10 * mega);
    EXPECT_EQ(third, second);
    blocks.free(third);
}

TEST(FreedBlocks, kept_and_used_are_no_more_than_was_used_before) {
    FreedBlocks blocks(1000 * mega);
    void* first = blocks.allocate(40 * mega);
    void* second = blocks.allocate(30 * mega);
    const std::size_t peak = blocks.in_use();
    blocks.free(first);
    blocks.free(second);
    // None of the kept blocks suits it; the largest has to go.
    void* third = blocks.allocate(10 * mega);
    EXPECT_LE(blocks.in_use() + blocks.kept(), peak);
    EXPECT_GT(blocks.kept(), 0u);
    void* fourth = blocks.allocate(100 * mega);
    EXPECT_EQ(blocks.kept(), 0u);
    blocks.free(third);
    blocks.free(fourth);
}

TEST(FreedBlocks, that_are_needed_in_turns_do_not_drive_out_each_other) {
    FreedBlocks blocks(1000 * mega, 30 * mega);
    void* result = blocks.allocate(100 * mega);
    void* large = blocks.allocate(20 * mega);
    blocks.free(large);
    void* small = blocks.allocate(10 * mega);
    blocks.free(small);
    for (int turn = 0; turn < 3; ++turn) {
        void* again = blocks.allocate(20 * mega);
        EXPECT_EQ(again, large);
        blocks.free(again);
        again = blocks.allocate(10 * mega);
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
    EXPECT_EQ(blocks.kept(), 0u);
}

// A sanitizer ends the program at a request that cannot be met, and sees pages of its own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(FreedBlocks, more_than_there_is_throws_and_counts_nothing) {
    FreedBlocks blocks(30 * mega);
    EXPECT_THROW(blocks.allocate(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
    EXPECT_THROW(blocks.allocate(std::size_t{1} << 60), std::bad_alloc);
    EXPECT_EQ(blocks.in_use(), 0u);
}

TEST(FreedBlocks, spare_arrays_the_faults_of_fresh_pages) {
    const auto faults = [] {
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        return usage.ru_minflt;
    };
    const Shape<2> shape{2048, 4096};
    { const Array<float, 2> first(shape); }
    const auto before = faults();
    for (int i = 0; i < 10; ++i) {
        Array<float, 2> again(shape);
        EXPECT_EQ(again(2047, 4095), 0.0F);
        again(2047, 4095) = 1.0F;
    }
    EXPECT_LT(faults() - before, 16);
}
#endif

}  // namespace
}  // namespace hogel::core
