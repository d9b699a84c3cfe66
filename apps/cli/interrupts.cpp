// SPDX-License-Identifier: Apache-2.0
#include "interrupts.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace hogel::cli {

struct Interrupts::Impl {
    using Clock = std::chrono::steady_clock;

    std::stop_source stop;
    sigset_t signals{};
    std::atomic<int> first_signal = 0;
    std::atomic<bool> ended = false;
    std::thread watcher;

    void watch() {
        Clock::time_point first_time;
        for (;;) {
            int signal = 0;
            if (sigwait(&signals, &signal) != 0) continue;
            if (ended) return;
            if (first_signal == 0) {
                first_signal = signal;
                first_time = Clock::now();
                stop.request_stop();
            } else if (Clock::now() - first_time > std::chrono::seconds(1)) {
                _exit(128 + signal);
            }
        }
    }
};

Interrupts::Interrupts(std::stop_source stop) : impl_(std::make_unique<Impl>()) {
    impl_->stop = std::move(stop);
    sigemptyset(&impl_->signals);
    // A closed pipe and a file beyond the limit of `ulimit -f` are write errors; they must not end the program.
    for (const int signal : {SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_IGN);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction inherited {};
        if (signal == SIGHUP && sigaction(SIGHUP, nullptr, &inherited) == 0 && inherited.sa_handler == SIG_IGN)
            continue;  // nohup
        sigaddset(&impl_->signals, signal);
        // Shells start background programs with SIGINT ignored, and ignored signals may not be delivered to sigwait().
        ::signal(signal, SIG_DFL);
    }
    pthread_sigmask(SIG_BLOCK, &impl_->signals, nullptr);
    impl_->watcher = std::thread([this] { impl_->watch(); });
}

Interrupts::~Interrupts() {
    impl_->ended = true;
    // Wakes the watcher. NOLINTNEXTLINE(bugprone-bad-signal-to-kill-thread)
    pthread_kill(impl_->watcher.native_handle(), SIGTERM);
    impl_->watcher.join();
}

int Interrupts::signal() const { return impl_->first_signal; }

}  // namespace hogel::cli
