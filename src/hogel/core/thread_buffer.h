// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/array.h"

namespace hogel::core {

/// Temporary memory of a function, with unspecified values, aligned to a cache line. The thread reuses it for the next
/// ThreadBuffer of the same type, because the system clears every new page. Buffers must be destroyed in the reverse
/// order of their construction, like local variables.
template <class T>
class ThreadBuffer {
  public:
    explicit ThreadBuffer(std::size_t count) : count_(count) {
        Pool& pool = thread_pool();
        if (pool.in_use == pool.blocks.size()) pool.blocks.emplace_back();
        Array<T, 1>& block = pool.blocks[pool.in_use];
        if (block.size() < count) block = Array<T, 1>({count});
        data_ = block.data();
        ++pool.in_use;
    }
    ~ThreadBuffer() { --thread_pool().in_use; }
    ThreadBuffer(const ThreadBuffer&) = delete;
    ThreadBuffer& operator=(const ThreadBuffer&) = delete;

    T* data() const { return data_; }
    std::size_t size() const { return count_; }
    T& operator[](std::size_t i) const { return data_[i]; }
    T* begin() const { return data_; }
    T* end() const { return data_ + count_; }

  private:
    struct Pool {
        std::vector<Array<T, 1>> blocks;  // one per buffer alive
        std::size_t in_use = 0;
    };
    static Pool& thread_pool() {
        thread_local Pool pool;
        return pool;
    }

    T* data_;
    std::size_t count_;
};

}  // namespace hogel::core
