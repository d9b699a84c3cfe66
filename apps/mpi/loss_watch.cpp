// SPDX-License-Identifier: Apache-2.0
#include "mpi/loss_watch.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <utility>

namespace hogel::mpi {
namespace {

// Returns a descriptor that becomes readable when the process ends, or -1. glibc 2.36 declares pidfd_open() only for C.
int pidfd_of(pid_t process) {
#ifdef SYS_pidfd_open
    return static_cast<int>(syscall(SYS_pidfd_open, process, 0));
#else
    return -1;
#endif
}

}  // namespace

LossWatch::LossWatch(std::span<const RankProcess> others, std::function<void(const RankProcess&)> lost) {
    std::vector<RankProcess> watched;
    files_.push_back(eventfd(0, EFD_CLOEXEC));
    for (const RankProcess& other : others)
        if (const int file = pidfd_of(other.process); file >= 0) {
            files_.push_back(file);
            watched.push_back(other);
        }
    if (files_.front() < 0 || watched.empty()) return;
    thread_ = std::thread([this, watched = std::move(watched), lost = std::move(lost)] { wait(watched, lost); });
}

LossWatch::~LossWatch() {
    const std::uint64_t signal = 1;
    if (thread_.joinable() && write(files_.front(), &signal, sizeof signal) == sizeof signal) thread_.join();
    for (const int file : files_)
        if (file >= 0) close(file);
}

void LossWatch::wait(const std::vector<RankProcess>& others,
                     const std::function<void(const RankProcess&)>& lost) const {
    std::vector<pollfd> events;
    for (const int file : files_) events.push_back({file, POLLIN, 0});
    while (poll(events.data(), events.size(), -1) < 0)
        if (errno != EINTR) return;
    if (events.front().revents != 0) return;
    for (std::size_t i = 0; i < others.size(); ++i)
        if (events[i + 1].revents != 0) return lost(others[i]);
}

}  // namespace hogel::mpi
