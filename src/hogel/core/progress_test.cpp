// SPDX-License-Identifier: Apache-2.0
#include "hogel/progress.h"

#include <gtest/gtest.h>

#include <vector>

#include "hogel/core/test_errors.h"

namespace hogel {
namespace {

using core::is_cancelled;

TEST(Progress, without_a_callback_or_a_token_goes_on_for_ever) {
    const Progress progress;
    EXPECT_FALSE(progress);
    EXPECT_TRUE(progress(0.5));
    EXPECT_NO_THROW(progress.report(0.5));
    EXPECT_FALSE(progress.part(std::size_t{1}, std::size_t{4}));
}

TEST(Progress, stops_when_its_token_is_asked_to) {
    std::stop_source source;
    const Progress progress(source.get_token());
    const Progress part = progress.part(0.2, 0.4);
    EXPECT_TRUE(progress);
    EXPECT_TRUE(part);
    EXPECT_FALSE(is_cancelled([&] { progress.report(0.1); }));
    source.request_stop();
    EXPECT_FALSE(progress(0.1));
    EXPECT_TRUE(is_cancelled([&] { progress.report(0.1); }));
    EXPECT_TRUE(is_cancelled([&] { part.report(0.1); }));
}

TEST(Progress, calls_back_with_the_fraction_and_stops_when_the_callback_says_so) {
    std::vector<double> fractions;
    const Progress progress([&](double fraction) {
        fractions.push_back(fraction);
        return fraction < 0.5;
    });
    EXPECT_TRUE(progress);
    EXPECT_FALSE(is_cancelled([&] { progress.report(0.25); }));
    EXPECT_TRUE(is_cancelled([&] { progress.report(0.75); }));
    EXPECT_EQ(fractions, (std::vector<double>{0.25, 0.75}));
}

TEST(Progress, of_a_callback_that_returns_nothing_goes_on) {
    int calls = 0;
    const Progress progress([&](double) { ++calls; });
    EXPECT_TRUE(progress(1));
    EXPECT_EQ(calls, 1);
}

TEST(Progress, has_a_token_and_a_callback_together) {
    std::stop_source source;
    int calls = 0;
    const Progress progress(source.get_token(), [&](double) { return ++calls < 3; });
    EXPECT_TRUE(progress(0));
    EXPECT_TRUE(progress(0));
    EXPECT_FALSE(progress(0)) << "the callback's word";
    source.request_stop();
    EXPECT_FALSE(progress(0));
    EXPECT_EQ(calls, 3) << "the callback hears nothing of work that has been stopped";
}

TEST(Progress, parts_are_stretches_of_the_whole) {
    double seen = -1;
    const Progress progress([&](double fraction) { seen = fraction; });
    progress.part(0.5, 1)(0.5);
    EXPECT_DOUBLE_EQ(seen, 0.75);
    progress.part(std::size_t{1}, std::size_t{4})(0);
    EXPECT_DOUBLE_EQ(seen, 0.25);
    progress.part(std::size_t{1}, std::size_t{4})(1);
    EXPECT_DOUBLE_EQ(seen, 0.5);
    progress.part(0.5, 1).part(0, 0.5).part(std::size_t{1},
                                            std::size_t{2})(0.5);  // 0.5 + 0.5 · 0.5 · (0.5 + 0.5 · 0.5)
    EXPECT_DOUBLE_EQ(seen, 0.6875);
}

TEST(Progress, a_part_outlives_the_whole) {
    int calls = 0;
    const Progress part = [&] { return Progress([&](double) { ++calls; }).part(0, 0.5); }();
    part(1);
    EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace hogel
