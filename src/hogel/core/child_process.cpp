// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"

namespace hogel::core {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int poll_ms = 100;  // milliseconds between checks for a stop request

/// Returns the address space of this process, bytes.
std::uint64_t address_space() {
    char text[64] = {};
    const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0) return 0;
    const ssize_t size = read(file, text, sizeof text - 1);
    close(file);
    return size > 0 ? std::strtoull(text, nullptr, 10) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

// Sets a soft limit, which the child may raise later. Never exceeds the limit of this process.
void set_limit(__rlimit_resource resource, rlim_t value) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0) return;
    limit.rlim_cur = std::min({value, limit.rlim_max, limit.rlim_cur});
    setrlimit(resource, &limit);
}

void renew_limit(__rlimit_resource resource, rlim_t value) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0) return;
    limit.rlim_cur = std::min(value, limit.rlim_max);
    setrlimit(resource, &limit);
}

void raise_limit(__rlimit_resource resource, rlim_t more) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    limit.rlim_cur = std::min(limit.rlim_cur + more, limit.rlim_max);
    setrlimit(resource, &limit);
}

/// Closes all files of the parent. The pipe becomes file 3; it is the only connection to the parent.
void close_files(int pipe) {
    const int pipe_copy = fcntl(pipe, F_DUPFD, 10);  // above the numbers used below
    const int null = open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) dup2(null, stream);
    dup2(pipe_copy, 3);
    if (syscall(SYS_close_range, 4, ~0U, 0) == 0) return;
    for (int file = 4; file < 4096; ++file) close(file);  // before Linux 5.9
}

/// Removes the parent's handlers. Ctrl-C also reaches the parent, which then ends the child.
void reset_signals() {
    for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
    for (const int signal : {SIGINT, SIGQUIT, SIGHUP, SIGTSTP}) ::signal(signal, SIG_IGN);
    sigset_t none;
    sigemptyset(&none);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

[[noreturn]] void run_child(pid_t parent, const ChildLimits& limits, int pipe,
                            const std::function<void(int)>& work) noexcept {
    if (!limits.serves) {  // PDEATHSIG would fire at the end of the starting thread
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1);  // the parent ended before prctl()
    }
    reset_signals();
    close_files(pipe);
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_FSIZE, 0);
    set_limit(RLIMIT_CPU, limits.cpu_seconds);  // a child starts with no time used
    set_limit(RLIMIT_AS, address_space() + limits.memory);
    work(3);
    _exit(0);  // skips the parent's destructors and stream buffers
}

/// Returns the processor time used by another process.
std::chrono::nanoseconds cpu_time(pid_t process) {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return {};
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

ChildProcess::ChildProcess(const ChildLimits& limits, const std::function<void(int)>& work)
    : patience_(limits.patience) {
    int ends[2] = {};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw Error(ErrorCode::internal, fmt::format("cannot create a socket pair: {}", std::strerror(errno)));
    constexpr int buffer = 1 << 20;  // fewer context switches; works with smaller buffers too
    setsockopt(ends[1], SOL_SOCKET, SO_SNDBUF, &buffer, sizeof buffer);
    pipe_ = ends[0];
    const pid_t parent = getpid();
    // Blocks all signals, so that no handler of this process runs in the child.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    child_ = fork();
    if (child_ == 0) run_child(parent, limits, ends[1], work);
    const int error = errno;
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    close(ends[1]);
    if (child_ < 0) {
        close(pipe_);
        throw Error(ErrorCode::internal, fmt::format("cannot start a process: {}", std::strerror(error)));
    }
}

ChildProcess::~ChildProcess() {
    reap(true);
    close(pipe_);
}

/// Returns the status of waitpid(), or 0 if other code in this process has already waited for the child.
int ChildProcess::reap(bool kill_first) {
    if (child_ < 0) return 0;
    if (kill_first) kill(child_, SIGKILL);
    int status = 0;
    pid_t done = 0;
    do done = waitpid(child_, &status, 0);
    while (done < 0 && errno == EINTR);
    child_ = -1;
    return done < 0 ? 0 : status;
}

void ChildProcess::fail() {
    const int status = reap(false);
    if (!WIFSIGNALED(status)) throw ChildFailure(ChildFailure::Kind::crashed, "ended early");
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) throw ChildFailure(ChildFailure::Kind::time, "took too long");
    throw ChildFailure(ChildFailure::Kind::crashed, fmt::format("crashed (signal {})", signal));
}

void ChildProcess::wait_for_data() {
    Clock::time_point alive = Clock::now();
    std::chrono::nanoseconds used{};
    for (;;) {
        throw_if_stopped();
        pollfd file{pipe_, POLLIN, 0};
        if (poll(&file, 1, poll_ms) > 0) return;
        if (const auto now_used = child_ < 0 ? used : cpu_time(child_); now_used != used) {
            used = now_used;
            alive = Clock::now();
        } else if (Clock::now() - alive > patience_) {
            reap(true);
            throw ChildFailure(ChildFailure::Kind::stuck, "makes no progress");
        }
    }
}

void ChildProcess::read(void* to, std::size_t bytes) {
    char* destination = static_cast<char*>(to);
    while (bytes > 0) {
        wait_for_data();
        const ssize_t count = ::read(pipe_, destination, bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail();
        destination += count;
        bytes -= static_cast<std::size_t>(count);
    }
}

void ChildProcess::send(const void* from, std::size_t bytes) {
    const char* source = static_cast<const char*>(from);
    while (bytes > 0) {
        const ssize_t count = ::send(pipe_, source, bytes, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail();
        source += count;
        bytes -= static_cast<std::size_t>(count);
    }
}

void ChildProcess::renew_limits(const ChildLimits& limits) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto seconds = used.ru_utime.tv_sec + used.ru_stime.tv_sec,
               microseconds = used.ru_utime.tv_usec + used.ru_stime.tv_usec;
    renew_limit(RLIMIT_CPU, static_cast<rlim_t>(seconds + (microseconds + 999999) / 1000000) + limits.cpu_seconds);
    renew_limit(RLIMIT_AS, address_space() + limits.memory);
}

bool ChildProcess::receive(int pipe, void* to, std::size_t bytes) {
    char* destination = static_cast<char*>(to);
    while (bytes > 0) {
        const ssize_t count = ::read(pipe, destination, bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        destination += count;
        bytes -= static_cast<std::size_t>(count);
    }
    return true;
}

void ChildProcess::raise_limits(const ChildLimits& more) {
    raise_limit(RLIMIT_AS, more.memory);
    raise_limit(RLIMIT_CPU, more.cpu_seconds);
}

void ChildProcess::write(int pipe, const void* from, std::size_t bytes) {
    const char* source = static_cast<const char*>(from);
    while (bytes > 0) {
        const ssize_t count = ::write(pipe, source, bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) _exit(1);
        source += count;
        bytes -= static_cast<std::size_t>(count);
    }
}

}  // namespace hogel::core
