// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace hogel::core {

/// Thread-safe pool of temporary objects, such as arrays of a few megabytes. Creates an object if none is free, and
/// keeps it for the next task, because the system clears new memory page by page.
template <class T>
class ObjectPool {
  public:
    /// An object in use. The destructor returns the object to the pool.
    class Lease {
      public:
        Lease(ObjectPool& pool, std::unique_ptr<T> object) : pool_(pool), object_(std::move(object)) {}
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        ~Lease() {
            const std::lock_guard lock(pool_.mutex_);
            pool_.free_.push_back(std::move(object_));
        }
        T& operator*() { return *object_; }
        T* operator->() { return object_.get(); }

      private:
        ObjectPool& pool_;
        std::unique_ptr<T> object_;
    };

    /// Leases a free object in the state left by its last user, or a new one.
    Lease take() {
        std::unique_ptr<T> object;
        {
            const std::lock_guard lock(mutex_);
            if (!free_.empty()) {
                object = std::move(free_.back());
                free_.pop_back();
            }
        }
        return {*this, object ? std::move(object) : std::make_unique<T>()};
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> free_;
};

}  // namespace hogel::core
