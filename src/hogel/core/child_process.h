// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace hogel::core {

/// Resource limits of a child process, in addition to the current usage of its parent.
struct ChildLimits {
    std::uint64_t memory = std::uint64_t{1} << 30;  ///< bytes of address space
    unsigned cpu_seconds = 60;                      ///< processor time
    std::chrono::seconds patience{30};              ///< maximum time without using processor time
    /// True if the child serves several threads and may outlive the thread that starts it. The child then ends when the
    /// other end of its pipe is closed, and must read from the pipe whenever it is idle.
    bool serves = false;
};

/// Thrown if a child process ended before it sent the expected data. what() is a predicate: "crashed
/// (segmentation fault)".
class ChildFailure : public std::exception {
  public:
    enum class Kind {
        crashed,  ///< or exited early
        time,     ///< exceeded its processor time
        stuck,    ///< makes no progress, e.g. because another thread's lock was held at the fork
    };
    ChildFailure(Kind kind, std::string text) : kind_(kind), text_(std::move(text)) {}
    Kind kind() const { return kind_; }
    const char* what() const noexcept override { return text_.c_str(); }

  private:
    Kind kind_;
    std::string text_;
};

/// Runs work in a forked copy of this process (no exec), to isolate libraries that crash or allocate too much memory on
/// damaged files. The child inherits no open file, writes none, and ends with this process.
///
/// The child has only the forking thread. Locks held by other threads at the fork stay locked. glibc releases its own
/// locks (memory, streams, loader). `work` must not use anything else that several threads use: no parallel loops, no
/// library with threads of its own. A child that waits for a lock uses no processor time and is ended as `stuck`.
class ChildProcess {
  public:
    /// Calls work(pipe) in the child, then ends the child. The pipe is bidirectional. Throws Error(internal) on
    /// failure.
    ChildProcess(const ChildLimits& limits, const std::function<void(int pipe)>& work);
    /// Kills the child if it still runs.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Reads bytes from the child. Throws ChildFailure if the child has ended, Error(cancelled) on a stop request.
    void read(void* to, std::size_t bytes);
    /// Sends bytes to the child. Blocks while the pipe is full, even after a stop request, so the child must read long
    /// messages without delay. Throws ChildFailure if the child has ended.
    void send(const void* from, std::size_t bytes);

    /// In the child: raises the limits, e.g. after opening another file.
    static void raise_limits(const ChildLimits& more);
    /// In the child: sets the limits relative to the current usage.
    static void renew_limits(const ChildLimits& limits);
    /// In the child: reads bytes from the parent. Returns false at the end of the data.
    static bool receive(int pipe, void* to, std::size_t bytes);
    /// In the child: writes bytes into the pipe. Ends the child if that fails.
    static void write(int pipe, const void* from, std::size_t bytes);

  private:
    void wait_for_data();
    [[noreturn]] void fail();
    int reap(bool kill_first);

    std::chrono::seconds patience_;
    pid_t child_ = -1;
    int pipe_ = -1;
};

/// Returns use(child) for a child that runs `work`. Retries once if the child is stuck on a lock that another thread
/// held at the fork, which is rare. Throws ChildFailure as ChildProcess::read() does.
template <class Use>
auto with_child(const ChildLimits& limits, const std::function<void(int pipe)>& work, const Use& use) {
    const auto attempt = [&] {
        ChildProcess child(limits, work);
        return use(child);
    };
    try {
        return attempt();
    } catch (const ChildFailure& failure) {
        if (failure.kind() != ChildFailure::Kind::stuck) throw;
    }
    return attempt();
}

}  // namespace hogel::core
