// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <thread>
#include <vector>

namespace hogel::mpi {

/// A rank and its process on this machine.
struct RankProcess {
    std::size_t rank = 0;
    pid_t process = 0;
};

/// Waits for the end of other ranks' processes on this machine, while which all should work: one that ends was killed
/// or has crashed. Where the system has no way to wait for processes of others (Linux before 5.3), nothing is noticed.
class LossWatch {
  public:
    /// @param lost  called once, on a thread of the watch, with the first rank whose process has ended
    LossWatch(std::span<const RankProcess> others, std::function<void(const RankProcess&)> lost);
    ~LossWatch();
    LossWatch(const LossWatch&) = delete;
    LossWatch& operator=(const LossWatch&) = delete;

  private:
    void wait(const std::vector<RankProcess>& others, const std::function<void(const RankProcess&)>& lost) const;

    std::vector<int> files_;  // that become readable: when the watch ends, and as each process does
    std::thread thread_;
};

}  // namespace hogel::mpi
