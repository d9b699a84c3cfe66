// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

namespace hogel::core {

/// Large blocks of memory, kept when they are freed and handed out again, because the system clears every new page:
/// about a second for each gigabyte on a virtual machine. Thread-safe.
///
/// A program needs hardly more memory for it: blocks in use and blocks kept are together never more than was in use at
/// some time before and `spare`, and what is kept is never more than max_kept. The largest blocks go first, unless one
/// can be used for what is needed. Without anything to spare, blocks of two sizes that are needed in turns would drive
/// out each other.
class FreedBlocks {
  public:
    explicit FreedBlocks(std::size_t max_kept, std::size_t spare = 0) : max_kept_(max_kept), spare_(spare) {}
    FreedBlocks(const FreedBlocks&) = delete;
    FreedBlocks& operator=(const FreedBlocks&) = delete;
    ~FreedBlocks();

    /// A block of at least so many bytes with any content, aligned to a cache line; from 4 MiB on it is aligned to a
    /// huge page and asks for such pages. Throws std::bad_alloc.
    void* allocate(std::size_t bytes);
    /// Takes back a block from allocate().
    void free(void* memory);

    /// Sets max_kept, and gives back what is beyond it.
    void set_max_kept(std::size_t max_kept);

    /// Bytes of the blocks that are kept.
    std::size_t kept() const;
    /// Bytes of the blocks that are in use.
    std::size_t in_use() const;

  private:
    void* take(std::size_t bytes, double idle);
    std::vector<void*> overflow(std::size_t max_kept);

    std::size_t max_kept_, spare_;
    mutable std::mutex mutex_;
    std::multimap<std::size_t, void*> blocks_;  // kept, by their bytes
    std::size_t kept_ = 0, in_use_ = 0, max_in_use_ = 0;
};

}  // namespace hogel::core
