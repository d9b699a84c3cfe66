// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <future>
#include <list>
#include <memory>
#include <mutex>

#include "hogel/core/parallel.h"

namespace hogel::core {

/// The results that were asked for last, by a key. Several threads may ask at once; who asks first for a result makes
/// it while others who want the same wait.
template <class Key, class Result>
class LruCache {
  public:
    /// @param kept  results to keep, at least one
    explicit LruCache(std::size_t kept) : kept_(std::max<std::size_t>(kept, 1)) {}

    std::size_t kept() const { return kept_; }

    /// The result of that key, or of make(), which returns std::shared_ptr<const Result>. What make() throws, everybody
    /// who waits for this result gets, and who asks later makes it anew.
    template <class Make>
    std::shared_ptr<const Result> get(const Key& key, const Make& make) {
        std::promise<std::shared_ptr<const Result>> promise;
        {
            std::unique_lock lock(mutex_);
            const auto found = std::ranges::find(entries_, key, &Entry::key);
            if (found != entries_.end()) {
                entries_.splice(entries_.begin(), entries_, found);
                const std::shared_future<std::shared_ptr<const Result>> result = found->result;
                lock.unlock();
                return result.get();
            }
            entries_.push_front({key, promise.get_future().share()});
            if (entries_.size() > kept_) entries_.pop_back();
        }
        try {
            std::shared_ptr<const Result> result;
            // A thread that waits inside must not begin to make something else, which may wait for this very result.
            isolate([&] { result = make(); });
            promise.set_value(result);
            return result;
        } catch (...) {
            promise.set_exception(std::current_exception());
            const std::lock_guard lock(mutex_);
            std::erase_if(entries_, [&](const Entry& entry) { return entry.key == key; });
            throw;
        }
    }

  private:
    struct Entry {
        Key key;
        std::shared_future<std::shared_ptr<const Result>> result;
    };

    std::size_t kept_;
    std::mutex mutex_;
    std::list<Entry> entries_;  // the one used last first
};

}  // namespace hogel::core
