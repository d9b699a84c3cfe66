// SPDX-License-Identifier: Apache-2.0
// Runs of many ranks, simulated from what the tiles of three light fields took (tile_costs.txt).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <numeric>
#include <queue>
#include <string>
#include <vector>

#include "mpi/hand_out.h"

namespace hogel::mpi {
namespace {

struct Costs {
    std::string scene;
    std::size_t across = 0, down = 0;
    std::vector<double> seconds;  // row by row
};

// `hogel-bench render --tiles` wrote the file.
std::vector<Costs> recorded() {
    std::ifstream file(HOGEL_TILE_COSTS);
    std::vector<Costs> all;
    for (Costs costs; file >> costs.scene >> costs.across >> costs.down;) {
        costs.seconds.resize(costs.across * costs.down);
        for (double& second : costs.seconds) {
            file >> second;
            second *= 1e-6;
        }
        all.push_back(costs);
    }
    return all;
}

// The same scene with `times` as many tiles across and down, each as costly as the one there.
Costs finer(const Costs& costs, std::size_t times) {
    Costs result{costs.scene, times * costs.across, times * costs.down, {}};
    for (std::size_t j = 0; j < result.down; ++j)
        for (std::size_t i = 0; i < result.across; ++i)
            result.seconds.push_back(costs.seconds[j / times * costs.across + i / times]);
    return result;
}

// Messages between processes, as measured between two ranks of one machine: how long the first process takes to answer
// a request, and how long a request and its answer are under way.
struct Messages {
    double answer = 10e-6, travel = 0.7e-3;
};

struct Request {
    double time = 0;  // when it is sent
    std::size_t rank = 0;
    double free = 0;  // when the rank has worked on all tiles that it has
    friend bool operator>(const Request& a, const Request& b) { return a.time > b.time; }
};

// The fraction of all ranks' time in which they work on tiles, by the hand-out that hogel-mpi has: ranks ask for tiles
// when they begin the last one that they have.
double balance(const Costs& costs, std::size_t ranks, const Messages& messages) {
    std::priority_queue<Request, std::vector<Request>, std::greater<>> requests;
    for (std::size_t rank = 0; rank < ranks; ++rank) requests.push({0, rank, 0});
    double server = 0, end = 0;
    std::uint64_t next = 0;
    const std::uint64_t tiles = costs.seconds.size();
    while (!requests.empty()) {
        const Request request = requests.top();
        requests.pop();
        server = std::max(server, request.time) + messages.answer;
        double at = std::max(request.free, server + (request.rank == 0 ? 0 : messages.travel)), last = at;
        end = std::max(end, at);
        if (next == tiles) continue;
        for (std::uint64_t given = tiles_at_once(tiles - next, ranks); given > 0; --given) {
            last = at;
            at += costs.seconds[next++];
        }
        requests.push({last, request.rank, at});
    }
    const double work = std::accumulate(costs.seconds.begin(), costs.seconds.end(), 0.0);
    return work / (static_cast<double>(ranks) * end);
}

TEST(Schedule, ranks_end_together) {
    const std::vector<Costs> all = recorded();
    ASSERT_EQ(all.size(), 3U);
    for (const Costs& costs : all) {
        const auto [least, most] = std::ranges::minmax_element(costs.seconds);
        // 1,024 ranks: a square metre of hogels a quarter of a millimetre wide, in as many tiles.
        const double few = balance(finer(costs, 4), 64, {}), many = balance(finer(costs, 16), 1024, {});
        std::cout << costs.scene << ": tiles of " << 1e3 * *least << " to " << 1e3 * *most << " ms; 64 ranks "
                  << 100 * few << " %, 1,024 ranks " << 100 * many << " %\n";
        EXPECT_GT(few, 0.95) << costs.scene;
        EXPECT_GT(many, 0.90) << costs.scene;
    }
}

// Bounds that hold for any costs: nothing is faster than all ranks at work, and one tile at the end is waited for.
TEST(Schedule, ends_within_a_grant_of_the_best) {
    for (const Costs& costs : recorded())
        for (const std::size_t ranks : {1, 7, 64}) {
            const double share = balance(costs, ranks, {0, 0});
            const double work = std::accumulate(costs.seconds.begin(), costs.seconds.end(), 0.0);
            const double most = *std::ranges::max_element(costs.seconds);
            EXPECT_LE(share, 1 + 1e-9);
            EXPECT_GE(share, work / (work + static_cast<double>(ranks) * 17 * most));
        }
}

}  // namespace
}  // namespace hogel::mpi
