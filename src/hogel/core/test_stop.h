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

// Work in items of one millisecond. One item requests a stop; each thread may begin one more item after it, because it
// may have passed its check already. The number of items begun does not depend on the speed of the machine.
class StoppedWork {
  public:
    // @param stop_at  number of the item, from 1, that requests the stop
    explicit StoppedWork(std::size_t stop_at) : stop_at_(stop_at) {}

    Progress progress() const { return Progress(source_.get_token()); }

    // Runs one item. Does nothing on a thread that has begun too many, so that a broken loop ends soon.
    void item() {
        if (is_stopped_ && begins_another_later()) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (++done_ < stop_at_ || is_stopped_) return;
        source_.request_stop();
        is_stopped_ = true;
    }

    // Returns the largest number of items that one thread began after the stop.
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

    std::size_t stop_at_;
    std::stop_source source_;
    std::atomic<std::size_t> done_{0};
    std::atomic<bool> is_stopped_{false};
    std::mutex mutex_;
    std::map<std::thread::id, std::size_t> begun_later_;
};

}  // namespace hogel::core
