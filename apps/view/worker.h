// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

namespace hogel::view {

/// Runs jobs on one thread, for several clients in turn. Only the newest job of each client waits, so a picture is
/// never older than the one in progress, however fast the client sends requests.
class Worker {
  public:
    struct Job {
        /// Must end early when a stop is requested. Must not throw: an exception would terminate the program.
        std::function<void(std::stop_token)> work;
        /// If true, a newer job of the same client waits instead of cancelling this one. True while the user drags:
        /// otherwise every picture would be cancelled and none shown.
        bool ends_first = false;
    };

    Worker();
    /// Stops the running job and discards the waiting ones.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Queues a client's newest job, which replaces its waiting one.
    void put(std::uint64_t client, Job job);
    /// Discards the jobs of a client and stops the running one.
    void drop(std::uint64_t client);

  private:
    struct Waiting {
        std::uint64_t client;
        Job job;
    };

    void run(std::stop_token end);
    std::optional<Waiting> next(std::stop_token end);

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::vector<Waiting> waiting_;  // first in, first out; each client at most once
    std::optional<std::uint64_t> running_;
    bool running_ends_first_ = false;
    std::stop_source stop_;  // of the running job
    std::jthread thread_;    // last member: joins before the others are destroyed
};

}  // namespace hogel::view
