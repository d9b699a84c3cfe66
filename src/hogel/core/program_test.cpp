// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/program.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stop_token>
#include <thread>

#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/progress.h"

namespace hogel::core {
namespace {

TEST(Program, IsFoundByPathAndSaysHowItEnded) {
    EXPECT_EQ(find_program("no-such-program-anywhere"), "");
    const std::string shell = find_program("sh");
    ASSERT_NE(shell, "");
    EXPECT_TRUE(run_program({shell, "-c", "exit 0"}));
    EXPECT_FALSE(run_program({shell, "-c", "exit 3"}));
    EXPECT_FALSE(run_program({shell, "-c", "kill -9 $$"}));
    EXPECT_FALSE(run_program({"/no/such/program"}));
}

TEST(Program, EndsWhenTheWorkIsStopped) {
    std::stop_source stop;
    const Progress progress(stop.get_token());
    const StopScope scope(progress);
    const std::jthread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        stop.request_stop();
    });
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_THROW(run_program({find_program("sleep"), "20"}), Error);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

}  // namespace
}  // namespace hogel::core
