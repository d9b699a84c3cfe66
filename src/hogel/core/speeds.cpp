// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/speeds.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "hogel/core/message.h"
#include "hogel/core/parallel.h"
#include "hogel/core/shared_order.h"

namespace hogel::core {
namespace {

// Processor time, which does not count that of other programs on the same processor.
double seconds_of_thread() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// A loop over numbers in the processor's first cache.
class Loop {
  public:
    Loop() { std::iota(numbers_.begin(), numbers_.end(), 0.0f); }

    // Rounds a second of processor time.
    double run(double seconds) {
        const double began = seconds_of_thread();
        double rounds = 0, spent = 0;
        do {
            for (int i = 0; i < 8; ++i, ++rounds)
                for (float& number : numbers_) number = (number * 0.25f + 1) * (number * 0.125f - 0.5f);
            spent = seconds_of_thread() - began;
        } while (spent < seconds);
        // Which it never is; so that the loop has a result.
        return std::isnan(numbers_[1]) ? 1 : rounds / spent;
    }

  private:
    std::array<float, 4096> numbers_;
};

// Measured while all others are at work, too: two processors may be one that does two things at a time, each of which
// is then slower than one alone.
double speed_of_thread() {
    constexpr double counted = 16e-3, around = 4e-3;
    Loop loop;
    loop.run(around);
    const double speed = loop.run(counted);
    loop.run(around);
    return speed;
}

}  // namespace

std::vector<double> speeds_of_processes(Team& team) {
    std::vector<double> threads(thread_count());
    team.meet();
    parallel_for(threads.size(), [&](std::size_t i) { threads[i] = speed_of_thread(); });
    MessageWriter own;
    own.put(std::accumulate(threads.begin(), threads.end(), 0.0));
    std::vector<double> speeds;
    for (const std::string& bytes : all_of(team, own.take())) speeds.push_back(MessageReader(bytes).get<double>());
    const double sum = std::accumulate(speeds.begin(), speeds.end(), 0.0);
    for (double& speed : speeds) speed /= sum;
    return speeds;
}

LineRange lines_in_parts(const std::vector<double>& parts, std::size_t process, std::size_t lines) {
    const auto begin = [&](std::size_t i) {
        if (i >= parts.size()) return lines;
        const double before = std::accumulate(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i), 0.0);
        return std::min(lines, static_cast<std::size_t>(std::lround(before * static_cast<double>(lines))));
    };
    return {begin(process), begin(process + 1) - begin(process)};
}

std::vector<double> parts_after(const std::vector<double>& speeds, const std::vector<double>& before, double work) {
    // Those that are free first fill up to a common end, at which those that are not free before it have no part.
    std::vector<std::size_t> order(before.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto free_at = [&](std::size_t process) { return before[process] / speeds[process]; };
    std::ranges::sort(order, {}, free_at);
    double end = 0, sum = work, speed = 0;
    for (std::size_t i = 0; i < order.size() && (i == 0 || free_at(order[i]) < end); ++i) {
        sum += before[order[i]];
        speed += speeds[order[i]];
        end = sum / speed;
    }
    std::vector<double> parts;
    for (std::size_t process = 0; process < before.size(); ++process)
        parts.push_back(std::max(0.0, end * speeds[process] - before[process]) / work);
    return parts;
}

}  // namespace hogel::core
