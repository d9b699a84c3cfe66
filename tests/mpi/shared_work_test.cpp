// SPDX-License-Identifier: Apache-2.0
// What the library does in a team: sums in the order of tiles, and planes that are transformed in parts.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <complex>
#include <numeric>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/optics/distributed/shared_plane.h"
#include "hogel/work/chunks.h"
#include "hogel/work/ordered_reduce.h"
#include "mpi/test_ranks.h"

namespace hogel::mpi {
namespace {

class SharedWorkTest : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Ranks, SharedWorkTest, testing::Values(2, 3, 4, 7));

TEST_P(SharedWorkTest, TheFirstMergesAllInOrder) {
    constexpr std::size_t n = 500, in_flight = 3;
    std::atomic<std::size_t> merged{0};
    std::atomic<bool> too_far{false};
    std::vector<std::atomic<int>> computed(n);
    run_ranks(GetParam(), [&](RankCommunicator& communicator) {
        work::ordered_reduce_in_ranks(
            communicator, n, in_flight,
            [&](std::size_t i) {
                ++computed[i];
                if (i >= merged + work::tiles_in_flight(in_flight) * GetParam()) too_far = true;
                if (i % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
                return std::string(i % 7, 'x') + std::to_string(i);
            },
            [&](std::size_t i, std::string_view bytes) {
                EXPECT_TRUE(communicator.is_root());
                EXPECT_EQ(i, merged);
                EXPECT_EQ(bytes, std::string(i % 7, 'x') + std::to_string(i));
                merged = i + 1;
            });
        EXPECT_EQ(communicator.broadcast(communicator.is_root() ? "done" : ""), "done");
        EXPECT_FALSE(communicator.settle({}, patience)->failed);
    });
    EXPECT_EQ(merged, n);
    EXPECT_FALSE(too_far) << "results beyond those that the first process has room for";
    for (const auto& times : computed) ASSERT_EQ(times, 1);
}

// One at a time in each process, and long results in parts.
TEST_P(SharedWorkTest, JobsAreDoneOneByOne) {
    constexpr std::size_t n = 20;
    const auto result = [](std::size_t i) { return std::string(i, 'x') + std::to_string(i); };
    std::vector<std::string> merged;
    std::vector<std::atomic<int>> computed(n);
    run_ranks(GetParam(), [&](RankCommunicator& communicator) {
        std::atomic<int> at_work = 0;
        work::ordered_reduce_in_ranks(
            communicator, n, 1,
            [&](std::size_t i) {
                EXPECT_EQ(++at_work, 1);
                ++computed[i];
                std::this_thread::sleep_for(std::chrono::microseconds(300));
                --at_work;
                return result(i);
            },
            [&](std::size_t i, std::string_view bytes) {
                EXPECT_EQ(i, merged.size());
                merged.emplace_back(bytes);
            },
            5);
        EXPECT_FALSE(communicator.settle({}, patience)->failed);
    });
    ASSERT_EQ(merged.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(merged[i], result(i));
        EXPECT_EQ(computed[i], 1);
    }
}

// Loops of the same team may overlap: those that are not the first begin the next while the first still merges.
TEST_P(SharedWorkTest, ResultsThatComeEarlyWaitForTheirLoop) {
    std::vector<std::size_t> merged;
    run_ranks(GetParam(), [&](RankCommunicator& communicator) {
        for (std::size_t loop = 0; loop < 5; ++loop) {
            work::ordered_reduce_in_ranks(
                communicator, 20, 2, [&](std::size_t i) { return std::to_string(100 * loop + i); },
                [&](std::size_t, std::string_view bytes) {
                    merged.push_back(std::stoul(std::string(bytes)));
                    std::this_thread::sleep_for(std::chrono::microseconds(300));
                });
        }
        EXPECT_FALSE(communicator.settle({}, patience)->failed);
    });
    ASSERT_EQ(merged.size(), 100U);
    for (std::size_t i = 0; i < merged.size(); ++i) EXPECT_EQ(merged[i], 100 * (i / 20) + i % 20);
}

// What fails in one process, in the work or in the merging, ends all of them with its message.
TEST_P(SharedWorkTest, AFailureEndsAll) {
    for (const bool merging : {false, true})
        run_ranks(GetParam(), [&](RankCommunicator& communicator) {
            Report own;
            std::stop_source stop;
            communicator.stop_with(stop);
            const core::StopScope scope(Progress(stop.get_token()));
            try {
                work::ordered_reduce_in_ranks(
                    communicator, 400, 2,
                    [&](std::size_t i) -> std::string {
                        if (!merging && i == 100) throw Error(ErrorCode::bad_input, "damaged");
                        return "x";
                    },
                    [&](std::size_t i, std::string_view) {
                        if (merging && i == 100) throw Error(ErrorCode::bad_input, "damaged");
                    });
                communicator.barrier();
            } catch (const Error& error) {
                own = {true, static_cast<int>(error.code()), error.code(), 0, error.what()};
            }
            const std::optional<Report> all = communicator.settle(own, patience);
            ASSERT_TRUE(all && all->failed);
            EXPECT_EQ(all->text, "damaged");
        });
}

std::complex<float> value(std::size_t y, std::size_t x) { return {static_cast<float>(y), static_cast<float>(x)}; }

TEST_P(SharedWorkTest, PlanesTurn) {
    for (const auto& [rows, later_rows, columns] :
         {std::array<std::size_t, 3>{100, 60, 75}, {33, 90, 16}, {5, 2, 3}, {900, 1100, 1200}})
        run_ranks(GetParam(),
                  [&, rows = rows, later_rows = later_rows, columns = columns](RankCommunicator& communicator) {
                      optics::distributed::SharedPlane plane(std::max(rows, later_rows), columns, 6, 16,
                                                             ScratchOptions(), &communicator);
                      plane.begin_rows(rows);
                      const optics::distributed::LineRange own = plane.local_rows(rows);
                      std::vector<std::complex<float>> row(columns);
                      for (std::size_t y = own.first; y < own.end(); ++y) {
                          for (std::size_t x = 0; x < columns; ++x) row[x] = value(y, x);
                          plane.put_row(y, row.data());
                      }
                      plane.to_columns(rows);
                      const optics::distributed::LineRange across = plane.local_columns();
                      const optics::distributed::LocalColumns later_places = plane.in_columns(later_rows);
                      for (std::size_t x = across.first; x < across.end(); ++x) {
                          for (std::size_t y = 0; y < rows; ++y) ASSERT_EQ(plane.at(y, x), value(y, x));
                          for (std::size_t y = 0; y < later_rows; ++y) later_places(y, x) = 2.0F * value(y, x);
                      }
                      plane.to_rows(later_rows);
                      const optics::distributed::LineRange later = plane.local_rows(later_rows);
                      for (std::size_t y = later.first; y < later.end(); ++y) {
                          plane.get_row(y, row.data());
                          for (std::size_t x = 0; x < columns; ++x) ASSERT_EQ(row[x], 2.0F * value(y, x));
                      }
                      EXPECT_FALSE(communicator.settle({}, patience)->failed);
                  });
}

// Each process wants rows that others want, too, and more than a message holds.
TEST_P(SharedWorkTest, RowsGoToAllThatWantThem) {
    constexpr std::size_t rows = 900, columns = 1500;
    run_ranks(GetParam(), [&](RankCommunicator& communicator) {
        const auto wanted = [&](std::size_t process) {
            const optics::distributed::LineRange own =
                optics::distributed::lines_of(process, communicator.size(), rows, 4);
            return optics::distributed::common_lines(
                {own.first - std::min<std::size_t>(own.first, 50), own.count + 100}, {0, rows});
        };
        const optics::distributed::LineRange mine = wanted(communicator.rank());
        std::vector<std::complex<float>> got(mine.count * columns);
        optics::distributed::send_rows(
            communicator, {rows, columns}, 16, wanted,
            [&](std::size_t y, std::complex<float>* row) {
                for (std::size_t x = 0; x < columns; ++x) row[x] = value(y, x);
            },
            [&](std::size_t y) { return &got[(y - mine.first) * columns]; });
        for (std::size_t y = 0; y < mine.count; ++y)
            for (std::size_t x = 0; x < columns; ++x) ASSERT_EQ(got[y * columns + x], value(mine.first + y, x));
        EXPECT_FALSE(communicator.settle({}, patience)->failed);
    });
}

TEST_P(SharedWorkTest, AllGetTheNumbersOfTheFirst) {
    run_ranks(GetParam(), [&](RankCommunicator& communicator) {
        for (const std::size_t count : {0, 1, 262'144, 262'145, 700'001}) {
            std::vector<float> numbers(count, static_cast<float>(communicator.rank()));
            if (communicator.is_root()) std::iota(numbers.begin(), numbers.end(), 3.0f);
            work::broadcast_in_chunks<float>(communicator, numbers);
            for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(numbers[i], static_cast<float>(i) + 3) << count;
        }
        EXPECT_FALSE(communicator.settle({}, patience)->failed);
    });
}

TEST(SharedPlane, LinesAreDividedEvenlyInGroups) {
    for (const std::size_t processes : {1, 2, 3, 7, 64})
        for (const std::size_t lines : {1, 15, 16, 17, 1000})
            for (const std::size_t together : {1, 10, 16}) {
                std::size_t next = 0, most = 0;
                for (std::size_t process = 0; process < processes; ++process) {
                    const optics::distributed::LineRange own =
                        optics::distributed::lines_of(process, processes, lines, together);
                    EXPECT_EQ(own.first, next);
                    EXPECT_EQ(own.first % together == 0 || own.count == 0, true);
                    most = std::max(most, own.count);
                    next = own.end();
                }
                EXPECT_EQ(next, lines);
                EXPECT_LE(most, (lines / processes / together + 2) * together);
            }
}

}  // namespace
}  // namespace hogel::mpi
