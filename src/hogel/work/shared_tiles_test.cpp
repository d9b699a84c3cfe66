// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/shared_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hogel/error.h"

namespace hogel::work {
namespace {

// Gives this rank two of every six tiles, as if two other ranks had the rest.
class ThirdOfThreeRanks final : public Communicator, public SharedSink {
  public:
    std::size_t rank() const override { return 0; }
    std::size_t size() const override { return 3; }
    std::optional<std::uint64_t> next_tile(std::uint64_t queue, std::uint64_t tiles, std::uint64_t) override {
        EXPECT_EQ(queue, 9U);
        if (next_ >= tiles) return std::nullopt;
        const std::uint64_t given = next_;
        next_ += given % 6 == 0 ? 1 : 5;
        return given;
    }
    void pass(std::uint64_t, std::uint64_t) override {}
    std::uint64_t sum(std::uint64_t number) override { return number; }
    void send(std::uint64_t, std::string) override {}
    void listen(std::uint64_t, std::function<void(std::string)>) override {}
    void send_to(std::size_t, std::string) override {}
    std::string receive_from(std::size_t) override { return {}; }
    std::unique_ptr<TileQueue> share_tiles(std::size_t tiles) override {
        return std::make_unique<TileQueue>(*this, 9, tiles);
    }

  private:
    std::uint64_t next_ = 0;
};

TEST(SharedTiles, alone_a_process_has_all_of_them) {
    std::vector<std::atomic<int>> done(100);
    double last = 0;
    for_each_tile(done.size(), nullptr, Progress([&](double fraction) { last = fraction; }),
                  [&](std::size_t tile) { ++done[tile]; });
    for (const auto& count : done) EXPECT_EQ(count, 1);
    EXPECT_EQ(last, 1);
}

TEST(SharedTiles, one_of_a_team_has_those_that_it_is_handed) {
    ThirdOfThreeRanks communicator;
    std::vector<std::atomic<int>> done(100);
    std::vector<double> fractions;
    for_each_tile(done.size(), &communicator, Progress([&](double fraction) { fractions.push_back(fraction); }),
                  [&](std::size_t tile) { ++done[tile]; });
    for (std::size_t tile = 0; tile < done.size(); ++tile) EXPECT_EQ(done[tile], tile % 6 < 2 ? 1 : 0) << tile;
    EXPECT_TRUE(std::ranges::is_sorted(fractions));
    EXPECT_GE(fractions.back(), 0.96);
}

TEST(SharedTiles, a_process_is_in_one_team_at_a_time) {
    EXPECT_EQ(communicator(), nullptr);
    ThirdOfThreeRanks one, two;
    {
        const CommunicatorScope scope(one);
        EXPECT_EQ(communicator(), &one);
        EXPECT_THROW(CommunicatorScope{two}, Error);
        EXPECT_EQ(communicator(), &one);
    }
    EXPECT_EQ(communicator(), nullptr);
}

}  // namespace
}  // namespace hogel::work
