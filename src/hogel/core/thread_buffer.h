// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/array.h"

namespace hogel::core {

/// Memory for values that a function needs while it runs: any values, aligned to a cache line. The thread keeps it for
/// the next ThreadBuffer of the same type, because the system clears every new page. Buffers end in the reverse order
/// of their beginnings, as local variables do.
template <class T>
class ThreadBuffer {
  public:
    explicit ThreadBuffer(std::size_t count) : count_(count) {
        Kept& kept = kept_by_thread();
        if (kept.in_use == kept.blocks.size()) kept.blocks.emplace_back();
        Array<T, 1>& block = kept.blocks[kept.in_use];
        if (block.size() < count) block = Array<T, 1>({count});
        data_ = block.data();
        ++kept.in_use;
    }
    ~ThreadBuffer() { --kept_by_thread().in_use; }
    ThreadBuffer(const ThreadBuffer&) = delete;
    ThreadBuffer& operator=(const ThreadBuffer&) = delete;

    T* data() const { return data_; }
    std::size_t size() const { return count_; }
    T& operator[](std::size_t i) const { return data_[i]; }
    T* begin() const { return data_; }
    T* end() const { return data_ + count_; }

  private:
    struct Kept {
        std::vector<Array<T, 1>> blocks;  // one for each buffer that exists at the same time
        std::size_t in_use = 0;
    };
    static Kept& kept_by_thread() {
        thread_local Kept kept;
        return kept;
    }

    T* data_;
    std::size_t count_;
};

}  // namespace hogel::core
