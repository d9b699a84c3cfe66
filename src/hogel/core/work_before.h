// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "hogel/team.h"

namespace hogel::core {

/// Work that each process of a team does alone before all of them do another one together. How much each has left is
/// known from how far they are when the first of them has done its own: nobody waits, and the slower ones go on. All
/// processes make one at the same time.
class WorkBefore {
  public:
    using Clock = std::chrono::steady_clock;

    /// @param work    of each process, in any unit
    /// @param speeds  of the processes; their sum is 1
    /// @param now     the time
    WorkBefore(Team& team, std::vector<double> work, std::vector<double> speeds,
               std::function<Clock::time_point()> now = Clock::now);
    ~WorkBefore();
    WorkBefore(const WorkBefore&) = delete;
    WorkBefore& operator=(const WorkBefore&) = delete;

    /// How far this process is, 0 to 1. On one thread at a time.
    void report(double fraction);

    /// This process has done its work. Returns what each process has left when the first of them has done its own, in
    /// the unit of the work: the same in all processes.
    std::vector<double> finish();

  private:
    struct Report {
        double fraction = 0, seconds = 0;
    };
    void say(double fraction);
    void take(std::size_t process, double fraction);
    std::vector<double> left(double now) const;

    Team& team_;
    std::vector<double> work_, speeds_;
    std::uint64_t channel_;
    std::function<Clock::time_point()> now_;
    Clock::time_point began_ = now_(), said_ = began_;
    // In the first process, with the lock: the last report of each, and what was told to all.
    std::mutex mutex_;
    std::vector<Report> reports_;
    std::optional<std::vector<double>> left_;
};

}  // namespace hogel::core
