// SPDX-License-Identifier: Apache-2.0
#include "mpi/rank_team.h"

#include <gtest/gtest.h>

#include <deque>
#include <numeric>
#include <random>

namespace hogel::mpi {
namespace {

// Links between threads of this process.
class Post {
  public:
    explicit Post(std::size_t size) : size_(size) {}

    class Box final : public Link {
      public:
        Box(Post& post, std::size_t rank) : post_(post), rank_(rank) {}
        std::size_t rank() const override { return rank_; }
        std::size_t size() const override { return post_.size_; }
        void send(std::size_t to, Kind kind, std::string bytes) override {
            const std::lock_guard lock(post_.mutex_);
            post_.boxes_[{to, kind}].push_back({rank_, std::move(bytes)});
        }
        std::optional<Message> receive(Kind kind) override {
            const std::lock_guard lock(post_.mutex_);
            std::deque<Message>& box = post_.boxes_[{rank_, kind}];
            if (box.empty()) return std::nullopt;
            Message message = std::move(box.front());
            box.pop_front();
            return message;
        }

      private:
        Post& post_;
        std::size_t rank_;
    };

  private:
    std::size_t size_;
    std::mutex mutex_;
    std::map<std::pair<std::size_t, Kind>, std::deque<Message>> boxes_;
};

// Runs work(team) in as many ranks. Teams end together, as processes do after MPI_Finalize.
template <class Work>
void run_ranks(std::size_t size, const Work& work) {
    Post post(size);
    std::vector<std::unique_ptr<Post::Box>> boxes;
    std::vector<std::unique_ptr<RankTeam>> teams;
    for (std::size_t rank = 0; rank < size; ++rank) boxes.push_back(std::make_unique<Post::Box>(post, rank));
    for (const auto& box : boxes) teams.push_back(std::make_unique<RankTeam>(*box));
    std::vector<std::jthread> ranks;
    for (const auto& team : teams) ranks.emplace_back([&] { work(*team); });
    ranks.clear();
}

constexpr std::chrono::seconds patience{10};

class RanksTest : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Ranks, RanksTest, testing::Values(1, 2, 3, 4, 7));

TEST_P(RanksTest, EveryTileIsHandedOutOnce) {
    for (const std::uint64_t tiles : {1, 5, 64, 1000}) {
        std::vector<std::atomic<int>> taken(2 * tiles);
        run_ranks(GetParam(), [&](RankTeam& team) {
            std::mt19937 random(static_cast<unsigned>(team.rank()));
            for (const std::uint64_t queue : {0, 1}) {
                for (Team::Tiles some = team.next_tiles(queue, tiles); some.count > 0;
                     some = team.next_tiles(queue, tiles)) {
                    for (std::uint64_t i = 0; i < some.count; ++i) ++taken[queue * tiles + some.first + i];
                    if (random() % 8 == 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
                }
                team.meet();
            }
            EXPECT_FALSE(team.settle({}, patience)->failed);
        });
        for (const auto& count : taken) ASSERT_EQ(count, 1) << tiles << " tiles";
    }
}

TEST_P(RanksTest, AllGetTheSumAndWhatTheFirstShares) {
    const std::size_t size = GetParam();
    run_ranks(size, [&](RankTeam& team) {
        for (std::uint64_t round = 1; round < 20; ++round) {
            EXPECT_EQ(team.sum(round * (team.rank() + 1)), round * size * (size + 1) / 2);
            const std::string text(1000 * round, static_cast<char>('a' + round));
            EXPECT_EQ(team.share(team.is_first() ? text : "of another"), text);
        }
        EXPECT_FALSE(team.settle({}, patience)->failed);
    });
}

// A rank that fails gives its error to all, those that wait and those that take tiles, and all end with it.
TEST_P(RanksTest, AFailureOfOneIsThatOfAll) {
    const std::size_t size = GetParam();
    for (std::size_t failing = 0; failing < size; ++failing)
        run_ranks(size, [&](RankTeam& team) {
            Report own;
            try {
                if (team.rank() == failing) throw Error(ErrorCode::bad_input, "the file is damaged");
                if (team.rank() % 2 == 0) team.meet();
                while (team.next_tiles(7, std::uint64_t{1} << 40).count > 0)
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                team.meet();
            } catch (const Error& error) {
                own = {true, static_cast<int>(error.code()), error.code(), 0, error.what()};
            }
            const std::optional<Report> all = team.settle(own, patience);
            ASSERT_TRUE(all && all->failed);
            EXPECT_EQ(all->status, 3);
            EXPECT_EQ(all->code, ErrorCode::bad_input);
            EXPECT_EQ(all->text, "the file is damaged");
        });
}

// A signal that reaches one process stops all of them within a second.
TEST_P(RanksTest, AStopOfOneStopsAll) {
    const std::size_t size = GetParam();
    run_ranks(size, [&](RankTeam& team) {
        std::stop_source stop;
        team.stop_with(stop);
        team.meet();
        const auto began = std::chrono::steady_clock::now();
        if (team.rank() == size - 1) stop.request_stop();
        while (!stop.stop_requested() && std::chrono::steady_clock::now() - began < std::chrono::seconds(5))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(1));
        const Report own{true, team.rank() == size - 1 ? 143 : 6, ErrorCode::cancelled, 0, "stopped"};
        EXPECT_EQ(team.settle(own, patience)->status, 143);
    });
}

TEST(RankTeam, TheFirstHearsWhatOthersSendInTheirOrder) {
    std::mutex mutex;
    std::map<int, std::vector<int>> heard;
    run_ranks(4, [&](RankTeam& team) {
        if (team.is_first())
            team.listen(5, [&](const std::string& text) {
                const std::lock_guard lock(mutex);
                heard[text.at(0)].push_back(text.at(1));
            });
        team.meet();
        if (!team.is_first())
            for (int i = 0; i < 100; ++i) team.send(5, {static_cast<char>(team.rank()), static_cast<char>(i)});
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
        for (std::size_t all = 0; team.is_first() && all < 300 && std::chrono::steady_clock::now() < end;) {
            const std::lock_guard lock(mutex);
            all = heard[1].size() + heard[2].size() + heard[3].size();
        }
        if (team.is_first()) team.listen(5, {});
        team.settle({}, patience);
    });
    std::vector<int> in_order(100);
    std::iota(in_order.begin(), in_order.end(), 0);
    for (int rank = 1; rank < 4; ++rank) EXPECT_EQ(heard[rank], in_order);
}

}  // namespace
}  // namespace hogel::mpi
