// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace hogel::core {

/// Memory of arrays. Large blocks are kept when they are freed and handed out again, because the system clears every
/// new page: up to a second for each gigabyte on a virtual machine, and more where a page must be had from its host.
/// Thread-safe.
///
/// Blocks of less than 4 MiB come from malloc, and are handed out again to what needs about as much; from 1 MiB on,
/// kept pages are used before malloc is asked. Larger ones are of whole huge pages. These are cut, moved in the address
/// space and joined as needed, so that new pages are taken only when all that are kept are in use.
///
/// A program needs hardly more memory for it: blocks in use and blocks kept are together never more than was in use at
/// some time before and `spare`, and what is kept is never more than max_kept. Without anything to spare, smaller
/// blocks of two sizes that are needed in turns would drive out each other.
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
    /// Bytes of the blocks that are in use and would be kept.
    std::size_t in_use() const;
    /// Bytes of the new pages that blocks of pages were given so far, which the system had to clear.
    std::size_t new_pages() const { return new_pages_; }

  private:
    // Huge pages in a row.
    struct Pages {
        std::byte* first;
        std::size_t bytes;
    };
    // What goes back to the system, which is done without the lock.
    struct Surplus {
        std::vector<void*> blocks;
        std::vector<Pages> pages;
    };

    std::byte* joined(const std::vector<Pages>& pieces, std::size_t bytes);
    static void give_back(const Surplus& surplus);

    void* allocate_block(std::size_t bytes);
    void* allocate_pages(std::size_t bytes);
    void* take_block(std::size_t bytes, double idle);
    std::vector<Pages> take_pages(std::size_t bytes);
    void* take_pages_for_block(std::size_t bytes);
    Surplus overflow(std::size_t max_kept);
    std::size_t can_stay(std::size_t in_use) const;

    std::size_t max_kept_, spare_;
    mutable std::mutex mutex_;
    std::multimap<std::size_t, void*> blocks_;            // kept, by their bytes
    std::multimap<std::size_t, std::byte*> pages_;        // kept, by their bytes
    std::unordered_map<void*, std::size_t> used_pages_;   // bytes of the blocks in use that are of pages
    std::size_t kept_ = 0, in_use_ = 0, max_in_use_ = 0;  // bytes of both
    std::atomic<std::size_t> new_pages_{0};
};

}  // namespace hogel::core
