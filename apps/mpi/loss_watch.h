// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <thread>
#include <vector>

namespace hogel::mpi {

/// A rank and its process id on this machine.
struct RankProcess {
    std::size_t rank = 0;
    pid_t process = 0;
};

/// Detects the loss of other ranks on this machine: a process that ends during its lifetime was killed or has crashed.
/// Detects nothing on Linux before 5.3, which has no pidfd_open().
class LossWatch {
  public:
    /// @param lost  called once with the first rank whose process has ended, on the thread of this object
    LossWatch(std::span<const RankProcess> others, std::function<void(const RankProcess&)> lost);
    ~LossWatch();
    LossWatch(const LossWatch&) = delete;
    LossWatch& operator=(const LossWatch&) = delete;

  private:
    void wait(const std::vector<RankProcess>& others, const std::function<void(const RankProcess&)>& lost) const;

    std::vector<int> files_;  // event for the end of the watch, then one pidfd per process; readable when it ends
    std::thread thread_;
};

}  // namespace hogel::mpi
