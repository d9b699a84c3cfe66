// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/cell_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "hogel/core/test_targets.h"

namespace hogel::render {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(CellSums);

TEST_P(CellSums, are_the_plain_ones_to_the_bit) {
    std::minstd_rand random(5);
    std::normal_distribution<float> normal;
    std::uniform_int_distribution<int> exponent(-40, 40);
    for (const std::size_t n : {1, 2, 3, 4, 5, 8})
        for (const std::size_t columns : {1, 3, 4, 8, 31, 64, 67}) {
            Array<float, 2> samples({3 * n, columns * n});
            for (float& value : samples.elements()) value = std::ldexp(normal(random), exponent(random));
            Array<double, 2> plain({3, columns});
            for (double& sum : plain.elements()) sum = normal(random);
            Array<double, 2> fast = plain;
            add_cells_plain(samples, n, plain);
            add_cells(samples, n, fast);
            EXPECT_TRUE(std::ranges::equal(fast.elements(), plain.elements())) << n << ", " << columns << " columns";
        }
}

// Integers have sums that are exact in any order: Σ over the cell of (index in the row + 1000 × row).
TEST_P(CellSums, are_of_the_samples_of_each_cell) {
    for (const std::size_t n : {1, 2, 3, 4, 7}) {
        Array<float, 2> samples({2 * n, 19 * n});
        for (std::size_t y = 0; y < 2 * n; ++y)
            for (std::size_t x = 0; x < 19 * n; ++x) samples(y, x) = static_cast<float>(x + 1000 * y);
        Array<double, 2> sums({2, 19});
        for (int turn = 1; turn <= 2; ++turn) {
            add_cells(samples, n, sums);
            const double size = static_cast<double>(n), middle = 0.5 * (size - 1);
            for (std::size_t v = 0; v < 2; ++v)
                for (std::size_t u = 0; u < 19; ++u)
                    ASSERT_EQ(sums(v, u), turn * size * size *
                                              (size * static_cast<double>(u) + middle +
                                               1000 * (size * static_cast<double>(v) + middle)));
        }
    }
}

}  // namespace
}  // namespace hogel::render
