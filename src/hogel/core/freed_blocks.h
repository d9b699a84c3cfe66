// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace hogel::core {

/// Allocator for arrays that reuses freed blocks, because the system clears every new page: up to a second per gigabyte
/// on a virtual machine, more if its host must provide the page. Thread-safe.
///
/// Blocks below 4 MiB come from malloc and are reused for blocks of similar size; from 1 MiB, kept pages are preferred
/// to malloc. Larger blocks consist of huge pages. These are split, remapped and joined as needed: new pages are taken
/// only if all kept pages are in use.
///
/// Memory overhead is small: blocks in use plus kept blocks never exceed the peak of blocks in use plus `spare`, and
/// kept blocks never exceed max_kept. With spare = 0, small blocks of two alternating sizes would evict each other.
class FreedBlocks {
  public:
    explicit FreedBlocks(std::size_t max_kept, std::size_t spare = 0) : max_kept_(max_kept), spare_(spare) {}
    FreedBlocks(const FreedBlocks&) = delete;
    FreedBlocks& operator=(const FreedBlocks&) = delete;
    ~FreedBlocks();

    /// Allocates at least `bytes` bytes with unspecified content, aligned to a cache line. Blocks of 4 MiB and more are
    /// aligned to a huge page and request huge pages. Throws std::bad_alloc.
    void* allocate(std::size_t bytes);
    void free(void* memory);

    /// Sets max_kept, and releases the surplus.
    void set_max_kept(std::size_t max_kept);

    /// Returns the number of bytes of kept blocks.
    std::size_t kept() const;
    /// Returns the number of bytes of blocks in use that would be kept when freed.
    std::size_t in_use() const;
    /// Returns the number of bytes of new pages allocated so far, which the system had to clear.
    std::size_t new_pages() const { return new_pages_; }

  private:
    // Contiguous huge pages.
    struct Pages {
        std::byte* first;
        std::size_t bytes;
    };
    // Memory to return to the system, without holding the lock.
    struct Surplus {
        std::vector<void*> blocks;
        std::vector<Pages> pages;
    };

    std::byte* joined(const std::vector<Pages>& kept_pages, std::size_t bytes);
    static void give_back(const Surplus& surplus);

    void* allocate_block(std::size_t bytes);
    void* allocate_pages(std::size_t bytes);
    void* take_block(std::size_t bytes, double idle);
    std::vector<Pages> take_pages(std::size_t bytes);
    void* take_pages_for_block(std::size_t bytes);
    Surplus overflow(std::size_t max_kept);
    std::size_t max_kept_beside(std::size_t in_use) const;

    std::size_t max_kept_, spare_;
    mutable std::mutex mutex_;
    std::multimap<std::size_t, void*> blocks_;            // kept blocks, by size in bytes
    std::multimap<std::size_t, std::byte*> pages_;        // kept pages, by size in bytes
    std::unordered_map<void*, std::size_t> used_pages_;   // bytes of the blocks in use made of huge pages
    std::size_t kept_ = 0, in_use_ = 0, max_in_use_ = 0;  // bytes of blocks and pages
    std::atomic<std::size_t> new_pages_{0};
};

}  // namespace hogel::core
