// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/paged_array.h"

#include <gtest/gtest.h>

#include "hogel/error.h"

namespace hogel::core {
namespace {

TEST(PagedArray, is_zero_at_first_and_keeps_values_in_memory_or_in_an_unnamed_file) {
    const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "paged_array";
    std::filesystem::create_directories(folder);
    for (const std::size_t memory : {std::size_t{1} << 20, std::size_t{0}}) {
        PagedArray array({30, 70}, {memory, folder});
        for (const auto& value : array.view().elements()) EXPECT_EQ(value, std::complex<float>(0));
        array.view()(29, 69) = {1, 2};
        PagedArray moved = std::move(array);
        EXPECT_EQ(moved.view()(29, 69), std::complex<float>(1, 2));
        EXPECT_TRUE(std::filesystem::is_empty(folder));
    }
}

TEST(PagedArray, refuses_sizes_that_cannot_be_held) {
    const auto code = [](const Shape<2>& shape, const ScratchOptions& scratch) {
        try {
            PagedArray array(shape, scratch);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::internal;
    };
    EXPECT_EQ(code({10, 10}, {799, ""}), ErrorCode::usage);
    EXPECT_EQ(code({0, 10}, {}), ErrorCode::usage);
    EXPECT_EQ(code({std::size_t{1} << 40, std::size_t{1} << 40}, {}), ErrorCode::usage);
    EXPECT_EQ(code({10, 10}, {0, "/no/such/folder"}), ErrorCode::cannot_write);
    EXPECT_EQ(code({std::size_t{1} << 25, std::size_t{1} << 25}, {0, ::testing::TempDir()}), ErrorCode::cannot_write);
}

}  // namespace
}  // namespace hogel::core
