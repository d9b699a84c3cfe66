// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/forest.h"

#include <gtest/gtest.h>

#include <set>

#include "hogel/error.h"

namespace hogel::zerotrees {
namespace {

using Extents = std::vector<std::size_t>;

std::vector<wavelets::Pyramid> pyramids() {
    std::vector<wavelets::Pyramid> all;
    for (std::size_t n = 1; n <= 40; ++n) all.push_back(wavelets::Pyramid::interleaved({n}));
    for (std::size_t n = 1; n <= 13; ++n)
        for (std::size_t m = 1; m <= 13; ++m) all.push_back(wavelets::Pyramid::interleaved({n, m}));
    all.push_back(wavelets::Pyramid::interleaved({5, 1, 17, 8}));
    all.push_back(wavelets::Pyramid(Extents{2, 3, 33, 31}, {{{0, 1, 2, 3}, 9}}));
    all.push_back(wavelets::Pyramid::separate({6, 7, 9, 16}, {{0, 1}, {2, 3}}));
    all.push_back(wavelets::Pyramid::separate({6, 7, 9, 16}, {{3}, {2, 0}}));
    all.push_back(wavelets::Pyramid(Extents{4, 5}, {}));
    return all;
}

TEST(Forest, holds_every_coefficient_once_and_parents_come_first) {
    for (const wavelets::Pyramid& pyramid : pyramids()) {
        const Forest forest(pyramid);
        std::vector<bool> seen(pyramid.size()), has_child(pyramid.size());
        for (const Forest::Band& band : forest.bands())
            forest.for_each(band, [&](std::size_t index, std::size_t parent) {
                ASSERT_LT(index, seen.size());
                EXPECT_FALSE(seen[index]);
                seen[index] = true;
                EXPECT_EQ(parent == Forest::no_parent, band.depth == 0);
                if (parent != Forest::no_parent) {
                    ASSERT_LT(parent, seen.size());
                    EXPECT_TRUE(seen[parent]);
                    has_child[parent] = true;
                }
            });
        for (bool one : seen) EXPECT_TRUE(one);
        for (const Forest::Band& band : forest.bands())
            if (band.leaf)
                forest.for_each(band, [&](std::size_t index, std::size_t) { EXPECT_FALSE(has_child[index]); });
    }
}

// [K] fig. 4.15: the parent of gamma_{j+1,2k} and gamma_{j+1,2k+1} is gamma_{j,k}; in 2D four children each.
TEST(Forest, of_powers_of_two_are_binary_and_quad_trees) {
    const Forest line{wavelets::Pyramid(Extents{16}, {{{0}, 4}})};
    for (const Forest::Band& band : line.bands())
        line.for_each(band, [&](std::size_t index, std::size_t parent) {
            EXPECT_EQ(parent, index == 0 ? Forest::no_parent : index / 2);
        });
    const Forest square{wavelets::Pyramid(Extents{8, 8}, {{{0, 1}, 3}})};
    std::vector<int> children(64);
    for (const Forest::Band& band : square.bands())
        square.for_each(band, [&](std::size_t index, std::size_t parent) {
            if (index == 0) return;
            EXPECT_EQ(parent, index / 8 / 2 * 8 + index % 8 / 2);
            ++children[parent];
        });
    EXPECT_EQ(children[0], 3);
    for (std::size_t i = 1; i < 64; ++i) EXPECT_EQ(children[i], i / 8 < 4 && i % 8 < 4 ? 4 : 0) << i;
}

TEST(Forest, too_many_dimensions_are_refused) {
    EXPECT_THROW(Forest(wavelets::Pyramid::interleaved(Extents(9, 2))), Error);
}

}  // namespace
}  // namespace hogel::zerotrees
