// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>

#include "hogel/progress.h"

namespace hogel::core {

// Work in items of a millisecond, one of which requests a stop. Each thread may begin one more item after that: one
// that had passed the check of its loop before. How long this takes depends on the machine; how many items begin does
// not.
class StoppedWork {
  public:
    // `at`: the number, from 1, of the item that requests the stop.
    explicit StoppedWork(std::size_t at) : at_(at) {}

    Progress progress() const { return Progress(source_.get_token()); }

    // One item. On a thread that has begun too many it does nothing, so that a wrong loop ends soon.
    void item() {
        if (is_stopped_ && begins_another_later()) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (++done_ < at_ || is_stopped_) return;
        source_.request_stop();
        is_stopped_ = true;
    }

    // The most items that one thread has begun after the stop.
    std::size_t most_begun_later() {
        const std::lock_guard lock(mutex_);
        std::size_t most = 0;
        for (const auto& [thread, count] : begun_later_) most = count > most ? count : most;
        return most;
    }

  private:
    bool begins_another_later() {
        const std::lock_guard lock(mutex_);
        return ++begun_later_[std::this_thread::get_id()] > 1;
    }

    std::size_t at_;
    std::stop_source source_;
    std::atomic<std::size_t> done_{0};
    std::atomic<bool> is_stopped_{false};
    std::mutex mutex_;
    std::map<std::thread::id, std::size_t> begun_later_;
};

}  // namespace hogel::core
