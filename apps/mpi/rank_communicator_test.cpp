// SPDX-License-Identifier: Apache-2.0
#include "mpi/rank_communicator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <random>

#include "mpi/test_ranks.h"

namespace hogel::mpi {
namespace {

class RanksTest : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Ranks, RanksTest, testing::Values(1, 2, 3, 4, 7));

TEST_P(RanksTest, EveryTileIsHandedOutOnce) {
    for (const std::uint64_t tiles : {1, 5, 64, 1000}) {
        std::vector<std::atomic<int>> taken(2 * tiles);
        run_ranks(GetParam(), [&](RankCommunicator& communicator) {
            std::mt19937 random(static_cast<unsigned>(communicator.rank()));
            for (const std::uint64_t queue : {0, 1}) {
                while (const std::optional<std::uint64_t> tile = communicator.next_tile(queue, tiles)) {
                    ++taken[queue * tiles + *tile];
                    if (random() % 8 == 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
                }
                communicator.barrier();
            }
            EXPECT_FALSE(communicator.settle({}, patience)->failed);
        });
        for (const auto& count : taken) ASSERT_EQ(count, 1) << tiles << " tiles";
    }
}

TEST_P(RanksTest, AllGetTheSumAndWhatTheFirstShares) {
    const std::size_t size = GetParam();
    run_ranks(size, [&](RankCommunicator& communicator) {
        for (std::uint64_t round = 1; round < 20; ++round) {
            EXPECT_EQ(communicator.sum(round * (communicator.rank() + 1)), round * size * (size + 1) / 2);
            const std::string text(1000 * round, static_cast<char>('a' + round));
            EXPECT_EQ(communicator.broadcast(communicator.is_root() ? text : "of another"), text);
        }
        EXPECT_FALSE(communicator.settle({}, patience)->failed);
    });
}

// The error of one rank ends all ranks, whether they wait at a barrier or take tiles.
TEST_P(RanksTest, AFailureOfOneIsThatOfAll) {
    const std::size_t size = GetParam();
    for (std::size_t failing = 0; failing < size; ++failing)
        run_ranks(size, [&](RankCommunicator& communicator) {
            Report local;
            try {
                if (communicator.rank() == failing) throw Error(ErrorCode::bad_input, "the file is damaged");
                if (communicator.rank() % 2 == 0) communicator.barrier();
                while (communicator.next_tile(7, std::uint64_t{1} << 40))
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                communicator.barrier();
            } catch (const Error& error) {
                local = {true, static_cast<int>(error.code()), error.code(), 0, error.what()};
            }
            const std::optional<Report> all = communicator.settle(local, patience);
            ASSERT_TRUE(all && all->failed);
            EXPECT_EQ(all->status, 3);
            EXPECT_EQ(all->code, ErrorCode::bad_input);
            EXPECT_EQ(all->text, "the file is damaged");
        });
}

// A stop of one rank stops all, even in work without communication.
TEST_P(RanksTest, AStopOfOneStopsAll) {
    const std::size_t size = GetParam();
    run_ranks(size, [&](RankCommunicator& communicator) {
        std::stop_source stop;
        communicator.stop_with(stop);
        communicator.barrier();
        if (communicator.rank() == size - 1) stop.request_stop();
        EXPECT_TRUE(comes_true([&] { return stop.stop_requested(); }));
        const Report local{true, communicator.rank() == size - 1 ? 143 : 6, ErrorCode::cancelled, 0, "stopped"};
        EXPECT_EQ(communicator.settle(local, patience)->status, 143);
    });
}

// After a stop, ranks do not wait for a lost rank, and report which one it is.
TEST(RankCommunicator, StopsWithoutOneThatIsLost) {
    for (const std::size_t lost : {0, 1, 2}) {
        std::atomic<bool> other_has_given_up = false;
        run_ranks(3, [&](RankCommunicator& communicator) {
            std::stop_source stop;
            communicator.stop_with(stop);
            communicator.barrier();
            if (communicator.rank() == lost) return;
            // The root receives the other's report before it collects the silent ranks, and vice versa.
            if (lost == 0 || communicator.is_root()) stop.request_stop();
            EXPECT_TRUE(comes_true([&] { return stop.stop_requested(); }));
            EXPECT_TRUE(comes_true([&] { return !communicator.is_root() || other_has_given_up; }));
            EXPECT_THROW(communicator.barrier(), Error);
            other_has_given_up = true;
            std::vector<std::size_t> silent;
            const Report local{true, 143, ErrorCode::cancelled, 0, "stopped"};
            const auto record_silent = [&](const std::vector<std::size_t>& ranks) { silent = ranks; };
            if (lost == 0) return;
            EXPECT_FALSE(communicator.settle(local, std::chrono::seconds(0), record_silent));
            EXPECT_EQ(silent, communicator.is_root() ? std::vector<std::size_t>{lost} : std::vector<std::size_t>{});
        });
    }
}

// A rank that reaches a barrier after all others have stopped waiting is still stopped by their failure.
TEST_P(RanksTest, StopsOneThatComesLate) {
    const std::size_t others = GetParam() - 1;
    for (std::size_t late = 0; late < GetParam(); ++late) {
        std::atomic<std::size_t> have_given_up = 0;
        run_ranks(GetParam(), [&](RankCommunicator& communicator) {
            std::stop_source stop;
            communicator.stop_with(stop);
            communicator.barrier();
            if (communicator.rank() != late) stop.request_stop();
            EXPECT_TRUE(comes_true([&] { return communicator.rank() != late || have_given_up == others; }));
            try {
                communicator.barrier();
            } catch (const Error&) {
                ++have_given_up;
            }
            const Report local{true, 143, ErrorCode::cancelled, 0, "stopped"};
            const std::optional<Report> all = communicator.settle(local, patience);
            EXPECT_TRUE(all && all->failed && all->status == 143);
        });
    }
}

TEST(RankCommunicator, TheFirstHearsWhatOthersSendInTheirOrder) {
    std::mutex mutex;
    std::map<int, std::vector<int>> heard;
    run_ranks(4, [&](RankCommunicator& communicator) {
        if (communicator.is_root())
            communicator.listen(5, [&](const std::string& text) {
                const std::lock_guard lock(mutex);
                heard[text.at(0)].push_back(text.at(1));
            });
        communicator.barrier();
        if (!communicator.is_root())
            for (int i = 0; i < 100; ++i)
                communicator.send(5, {static_cast<char>(communicator.rank()), static_cast<char>(i)});
        const auto all_were_heard = [&] {
            const std::lock_guard lock(mutex);
            return heard[1].size() + heard[2].size() + heard[3].size() == 300;
        };
        if (communicator.is_root()) {
            EXPECT_TRUE(comes_true(all_were_heard));
            communicator.listen(5, {});
        }
        communicator.settle({}, patience);
    });
    std::vector<int> in_order(100);
    std::iota(in_order.begin(), in_order.end(), 0);
    for (int rank = 1; rank < 4; ++rank) EXPECT_EQ(heard[rank], in_order);
}

}  // namespace
}  // namespace hogel::mpi
