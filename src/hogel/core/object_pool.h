// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace hogel::core {

/// Things that many tasks need, one after the other, such as arrays of a few megabytes: made when none is free, and
/// kept for whoever comes next, because fresh memory has to be cleared page by page first. For any number of threads.
template <class T>
class ObjectPool {
  public:
    /// One of them, given back when this goes.
    class Lease {
      public:
        Lease(ObjectPool& from, std::unique_ptr<T> thing) : from_(from), thing_(std::move(thing)) {}
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        ~Lease() {
            const std::lock_guard lock(from_.mutex_);
            from_.free_.push_back(std::move(thing_));
        }
        T& operator*() { return *thing_; }
        T* operator->() { return thing_.get(); }

      private:
        ObjectPool& from_;
        std::unique_ptr<T> thing_;
    };

    /// What it holds is what the last who had it left there.
    Lease take() {
        std::unique_ptr<T> thing;
        {
            const std::lock_guard lock(mutex_);
            if (!free_.empty()) {
                thing = std::move(free_.back());
                free_.pop_back();
            }
        }
        return {*this, thing ? std::move(thing) : std::make_unique<T>()};
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> free_;
};

}  // namespace hogel::core
