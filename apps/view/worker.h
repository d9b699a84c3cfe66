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

/// Makes pictures on one thread, for several clients in turn. Of each client only the newest job waits, so that however
/// fast a client asks, what it sees is never older than the one picture that is being made.
class Worker {
  public:
    struct Job {
        /// What must end early, by Error(cancelled) or otherwise, when a stop is requested. Throws nothing else.
        std::function<void(std::stop_token)> work;
        /// Whether a newer job of the same client waits for this one instead of stopping it. True in motion: were each
        /// picture stopped by the next, a drag would show none at all.
        bool ends_first = false;
    };

    Worker();
    /// Stops what runs and forgets what waits.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Gives a client's newest job, which takes the place of one that waits.
    void put(std::uint64_t client, Job job);
    /// Forgets a client that is gone and stops its job.
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
    std::vector<Waiting> waiting_;  // in turn, each client once
    std::optional<std::uint64_t> running_;
    bool running_ends_first_ = false;
    std::stop_source stop_;  // of what runs
    std::jthread thread_;    // last, so that it ends before what it uses
};

}  // namespace hogel::view
