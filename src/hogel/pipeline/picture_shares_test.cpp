// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_shares.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <random>
#include <utility>

#include "hogel/field.h"

namespace hogel::pipeline {
namespace {

// Where all pictures of a colour take equally long.
class PictureSharesTest : public testing::Test {
  protected:
    std::vector<PictureShares> divide(const PictureShares& pictures, const std::vector<double>& parts) const {
        return divided(pictures, parts, colours_, cameras_, {});
    }
    PictureShare all_of(std::size_t colour) const { return by_all_cameras(colour, cameras_.size()); }
    static std::vector<std::pair<std::size_t, std::size_t>> pictures_of(const std::vector<PictureShares>& shares) {
        std::vector<std::pair<std::size_t, std::size_t>> pictures;
        for (const PictureShares& own : shares)
            for (const PictureShare& share : own)
                for (const std::size_t camera : share.cameras) pictures.emplace_back(share.colour, camera);
        return pictures;
    }
    static std::vector<std::size_t> counts_of(const std::vector<PictureShares>& shares) {
        std::vector<std::size_t> counts;
        for (const PictureShares& own : shares) counts.push_back(pictures_of({own}).size());
        return counts;
    }

    std::vector<Camera> cameras_ = std::vector<Camera>(6);
    Fields colours_ = Fields(3, std::make_shared<Field>(FieldGrid{{4, 4, 1e-6, 1e-6, 0, 0}, 532e-9}));
};

TEST_F(PictureSharesTest, are_as_large_as_the_parts_and_each_picture_is_in_one) {
    const PictureShares all{all_of(2), all_of(0), all_of(1)};
    EXPECT_EQ(counts_of(divide(all, {0.5, 0.5})), (std::vector<std::size_t>{9, 9}));
    EXPECT_EQ(counts_of(divide(all, {0.0, 1.0})), (std::vector<std::size_t>{0, 18}));
    std::mt19937 random;
    for (int turn = 0; turn < 100; ++turn) {
        std::vector<double> parts(1 + random() % 9);
        for (double& part : parts) part = random() % 4 == 0 ? 0 : std::generate_canonical<double, 32>(random);
        parts.back() += 1e-3;
        const double sum = std::accumulate(parts.begin(), parts.end(), 0.0);
        for (double& part : parts) part /= sum;
        const std::vector<PictureShares> shares = divide(all, parts);
        const auto pictures = pictures_of(shares);
        EXPECT_EQ(pictures, pictures_of({all})) << "in their order";
        const std::vector<std::size_t> counts = counts_of(shares);
        for (std::size_t process = 0; process < parts.size(); ++process)
            EXPECT_NEAR(static_cast<double>(counts[process]), 18 * parts[process], 1.0 + 1e-9);
    }
}

TEST_F(PictureSharesTest, of_colours_that_are_divided_are_taken_where_each_process_has_another_colour) {
    std::vector<PictureShares> shares = divide({all_of(2), all_of(0), all_of(1)}, {0.6, 0.4});
    const PictureShares taken = take_divided(shares, cameras_.size());
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken.front().colour, 0u);
    EXPECT_EQ(taken.front().cameras, all_of(0).cameras);
    ASSERT_EQ(counts_of(shares), (std::vector<std::size_t>{6, 6}));
    EXPECT_EQ(shares[0].front().colour, 2u);
    EXPECT_EQ(shares[1].front().colour, 1u);
}

TEST_F(PictureSharesTest, stay_where_a_process_has_no_whole_colour) {
    for (const std::vector<double>& parts : {std::vector<double>(7, 1.0 / 7), std::vector<double>{0.3, 0.1, 0.6}}) {
        std::vector<PictureShares> shares = divide({all_of(0), all_of(1), all_of(2)}, parts);
        const std::vector<std::size_t> before = counts_of(shares);
        EXPECT_TRUE(take_divided(shares, cameras_.size()).empty());
        EXPECT_EQ(counts_of(shares), before);
    }
}

}  // namespace
}  // namespace hogel::pipeline
