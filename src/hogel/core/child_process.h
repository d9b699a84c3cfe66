// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace hogel::core {

/// What a child process may use, above what the process that starts it uses already.
struct ChildLimits {
    std::uint64_t memory = std::uint64_t{1} << 30;  ///< bytes of address space
    unsigned cpu_seconds = 60;                      ///< then it is ended
    std::chrono::seconds patience{30};              ///< so long it may use no processor time, then it is ended
    /// Whether the child serves threads other than the one that starts it and may outlive that. It then ends when the
    /// other end of its pipe is closed, so it must read from there whenever it has nothing else to do.
    bool serves = false;
};

/// Thrown where a child process ended without having sent what was to be read: what() says how, in a few words that
/// begin a sentence about it ("crashed (segmentation fault)").
class ChildFailure : public std::exception {
  public:
    enum class Kind {
        crashed,  ///< or ended without a word
        time,     ///< used up
        stuck,    ///< waits for something, such as a lock of a thread that it does not have
    };
    ChildFailure(Kind kind, std::string text) : kind_(kind), text_(std::move(text)) {}
    Kind kind() const { return kind_; }
    const char* what() const noexcept override { return text_.c_str(); }

  private:
    Kind kind_;
    std::string text_;
};

/// Work in a copy of this process (fork without exec), so that libraries which crash on damaged files, or ask for very
/// much memory, do so there. The child inherits no open file, writes none, and ends with this process.
///
/// Other threads of this process do not exist in the child, and a lock that one of them held stays locked there. glibc
/// releases its own (memory, streams, loader); `work` must use nothing else that this process uses on several threads:
/// no parallel loops, no library with threads of its own. A child that waits for a lock uses no processor time and is
/// ended as `stuck`.
class ChildProcess {
  public:
    /// Calls work(pipe) in the child, which ends when it returns; the pipe works both ways. Throws Error(internal) if
    /// no process can be started.
    ChildProcess(const ChildLimits& limits, const std::function<void(int pipe)>& work);
    /// Ends the child if it runs.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// The next bytes that the child writes into its pipe. Throws ChildFailure if it ended before, Error(cancelled)
    /// when the work of this thread is to stop.
    void read(void* to, std::size_t bytes);
    /// Sends bytes to the child. Throws as read() does. The child has to read them at once, or they have to be few.
    void send(const void* from, std::size_t bytes);

    /// In the child: allows more, for instance after a further file was opened.
    static void raise_limits(const ChildLimits& more);
    /// In the child: allows this much beyond what it uses now, whatever it was allowed before.
    static void renew_limits(const ChildLimits& limits);
    /// In the child: reads what was sent. False if nothing more will come.
    static bool receive(int pipe, void* to, std::size_t bytes);
    /// In the child: writes everything into the pipe; ends the child if that fails.
    static void write(int pipe, const void* from, std::size_t bytes);

  private:
    void wait_for_data();
    [[noreturn]] void fail();
    int reap(bool kill_first);

    std::chrono::seconds patience_;
    pid_t child_ = -1;
    int pipe_ = -1;
};

/// The result of use(child) for a child that does `work`. A child that is stuck has met a lock of another thread of
/// this process, which is rare: the work is tried once more. Throws ChildFailure as ChildProcess::read() does.
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
