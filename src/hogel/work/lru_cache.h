// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::work {

/// Thread-safe cache that keeps the most recently used results. The first thread that requests a result computes it;
/// other threads that request the same result wait for it.
template <class Key, class Result>
class LruCache {
  public:
    /// @param capacity  number of results to keep, at least one
    explicit LruCache(std::size_t capacity) : capacity_(std::max<std::size_t>(capacity, 1)) {}

    std::size_t capacity() const { return capacity_; }

    /// Returns the cached result of a key, or computes it with make(), which returns std::shared_ptr<const Result>. An
    /// exception of make() reaches all waiting threads; the next call computes the result again. If the computing
    /// thread is stopped, a waiting thread that is not stopped computes the result.
    template <class Make>
    std::shared_ptr<const Result> get(const Key& key, const Make& make) {
        for (;;) {
            Promise promise;
            const auto [result, new_entry] = look_up(key, promise);
            if (new_entry) return keep_promise(promise, *new_entry, make);
            if (std::shared_ptr<const Result> made = wait(result)) return made;
        }
    }

    /// Removes all entries. Threads that wait for a pending result still receive it.
    void clear() {
        const std::lock_guard lock(mutex_);
        entries_.clear();
    }

  private:
    using Promise = std::promise<std::shared_ptr<const Result>>;
    using Future = std::shared_future<std::shared_ptr<const Result>>;

    struct Entry {
        Key key;
        std::uint64_t number;
        Future result;
    };

    // Returns the future of an existing or pending result; or adds an entry for `promise`, and returns its future and
    // number.
    std::pair<Future, std::optional<std::uint64_t>> look_up(const Key& key, Promise& promise) {
        const std::lock_guard lock(mutex_);
        const auto found = std::ranges::find(entries_, key, &Entry::key);
        if (found != entries_.end()) {
            entries_.splice(entries_.begin(), entries_, found);
            return {found->result, std::nullopt};
        }
        entries_.push_front({key, ++last_number_, promise.get_future().share()});
        if (entries_.size() > capacity_) entries_.pop_back();
        return {entries_.front().result, last_number_};
    }

    template <class Make>
    std::shared_ptr<const Result> keep_promise(Promise& promise, std::uint64_t number, const Make& make) {
        try {
            std::shared_ptr<const Result> result;
            // This thread must not execute other tasks while it waits inside make(): they may wait for this result.
            isolate([&] { result = make(); });
            promise.set_value(result);
            return result;
        } catch (const Error& error) {
            forget(number);
            if (error.code() == ErrorCode::cancelled)
                promise.set_value(nullptr);
            else
                promise.set_exception(std::current_exception());
            throw;
        } catch (...) {
            forget(number);
            promise.set_exception(std::current_exception());
            throw;
        }
    }

    void forget(std::uint64_t number) {
        const std::lock_guard lock(mutex_);
        std::erase_if(entries_, [&](const Entry& entry) { return entry.number == number; });
    }

    // Waits for a result. Returns null if the computing thread was stopped but this thread was not.
    static std::shared_ptr<const Result> wait(const Future& future) {
        while (future.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) core::throw_if_stopped();
        std::shared_ptr<const Result> result = future.get();
        if (!result) core::throw_if_stopped();
        return result;
    }

    std::size_t capacity_;
    std::mutex mutex_;
    std::list<Entry> entries_;  // most recently used first
    std::uint64_t last_number_ = 0;
};

}  // namespace hogel::work
