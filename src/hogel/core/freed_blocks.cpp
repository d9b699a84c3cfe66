// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/freed_blocks.h"

#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <new>

namespace hogel::core {
namespace {

// Maximum unused fraction of a reused block, and of a block that would otherwise be released.
constexpr double max_idle = 0.25, max_idle_before_release = 0.6;

constexpr std::size_t line = 64, page = 4096, huge_page = std::size_t{2} << 20;
// Blocks of this size and more consist of huge pages.
constexpr std::size_t smallest_of_pages = 2 * huge_page;
// Smaller blocks are left to malloc.
constexpr std::size_t smallest_kept = std::size_t{128} << 10;
// malloc may return up to a page more than requested; the usable size alone shows whether a block was counted.
constexpr std::size_t smallest_counted = smallest_kept - 2 * page;

std::size_t round_up(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

bool is_on_huge_page(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory) % huge_page == 0; }

void unmap(std::byte* first, std::size_t bytes) {
    if (bytes > 0) munmap(first, bytes);
}

// Maps new pages; returns null on failure.
std::byte* map(std::size_t bytes) {
    const auto mapped = [](std::size_t size) -> std::byte* {
        void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        return memory != MAP_FAILED ? static_cast<std::byte*>(memory) : nullptr;
    };
    std::byte* memory = mapped(bytes);
    if (memory != nullptr && !is_on_huge_page(memory)) {
        unmap(memory, bytes);
        memory = mapped(bytes + huge_page);
        if (memory != nullptr) {
            const std::size_t padding = huge_page - reinterpret_cast<std::uintptr_t>(memory) % huge_page;
            unmap(memory, padding);
            memory += padding;
            unmap(memory + bytes, huge_page - padding);
        }
    }
    // Only a hint: affects speed alone.
    if (memory != nullptr) madvise(memory, bytes, MADV_HUGEPAGE);
    return memory;
}

}  // namespace

FreedBlocks::~FreedBlocks() { give_back(overflow(0)); }

// Joins kept pages and new pages into one block. On failure unmaps the kept pages and returns null.
std::byte* FreedBlocks::joined(const std::vector<Pages>& kept_pages, std::size_t bytes) {
    if (kept_pages.size() == 1 && kept_pages.front().bytes == bytes) return kept_pages.front().first;
    std::byte* const memory = map(bytes);
    std::size_t offset = 0;
    bool ok = memory != nullptr;
    for (const Pages& pages : kept_pages) {
        // Remapping changes the address of the pages without copying.
        if (ok && mremap(pages.first, pages.bytes, pages.bytes, MREMAP_MAYMOVE | MREMAP_FIXED, memory + offset) ==
                      MAP_FAILED) {
            ok = false;
            // Does not unmap the range of the failed call: another thread may have mapped it since.
            unmap(memory, offset);
            unmap(memory + offset + pages.bytes, bytes - offset - pages.bytes);
        }
        if (!ok) unmap(pages.first, pages.bytes);
        offset += pages.bytes;
    }
    if (!ok) return nullptr;
    new_pages_ += bytes - offset;
    return memory;
}

void FreedBlocks::give_back(const Surplus& surplus) {
    for (void* block : surplus.blocks) std::free(block);
    for (const Pages& pages : surplus.pages) unmap(pages.first, pages.bytes);
}

// Returns the smallest sufficient kept block, most recently used first; null if more than a fraction `idle` is unused.
void* FreedBlocks::take_block(std::size_t bytes, double idle) {
    const auto smallest = blocks_.lower_bound(bytes);
    if (smallest == blocks_.end() ||
        static_cast<double>(smallest->first - bytes) > idle * static_cast<double>(smallest->first))
        return nullptr;
    const auto block = std::prev(blocks_.upper_bound(smallest->first));
    void* memory = block->second;
    kept_ -= block->first;
    in_use_ += block->first;
    blocks_.erase(block);
    return memory;
}

// Takes kept pages for `bytes` bytes, or all: from the smallest sufficient range, or from as few ranges as possible.
std::vector<FreedBlocks::Pages> FreedBlocks::take_pages(std::size_t bytes) {
    std::vector<Pages> taken;
    while (bytes > 0 && !pages_.empty()) {
        const auto smallest = pages_.lower_bound(bytes);
        const auto from = std::prev(smallest != pages_.end() ? pages_.upper_bound(smallest->first) : pages_.end());
        const auto [size, first] = *from;
        pages_.erase(from);
        const std::size_t used = std::min(size, bytes);
        if (size > used) pages_.emplace(size - used, first + used);
        taken.push_back({first, used});
        kept_ -= used;
        bytes -= used;
    }
    return taken;
}

// Takes contiguous kept pages instead of a malloc block, or returns null if more than half would be unused.
void* FreedBlocks::take_pages_for_block(std::size_t bytes) {
    const std::size_t pages = round_up(bytes, huge_page);
    if (2 * bytes < pages || pages_.lower_bound(pages) == pages_.end()) return nullptr;
    std::byte* const memory = take_pages(pages).front().first;
    in_use_ += pages;
    used_pages_.emplace(memory, pages);
    return memory;
}

// Returns the number of bytes that may be kept if `in_use` bytes are in use.
std::size_t FreedBlocks::max_kept_beside(std::size_t in_use) const {
    return spare_ + (max_in_use_ > in_use ? max_in_use_ - in_use : 0);
}

// Removes kept memory beyond max_kept bytes: pages first, because they hold most of it, then the largest blocks.
FreedBlocks::Surplus FreedBlocks::overflow(std::size_t max_kept) {
    Surplus surplus;
    if (kept_ > max_kept) surplus.pages = take_pages(round_up(kept_ - max_kept, huge_page));
    while (kept_ > max_kept) {
        const auto largest = std::prev(blocks_.end());
        kept_ -= largest->first;
        surplus.blocks.push_back(largest->second);
        blocks_.erase(largest);
    }
    return surplus;
}

void* FreedBlocks::allocate(std::size_t bytes) {
    if (bytes > std::numeric_limits<std::size_t>::max() / 2) throw std::bad_alloc();  // more than can be addressed
    if (bytes >= smallest_of_pages) return allocate_pages(round_up(bytes, huge_page));
    if (bytes >= smallest_counted) return allocate_block(round_up(std::max(bytes, smallest_kept), page));
    void* memory = nullptr;
    if (posix_memalign(&memory, line, bytes) != 0) throw std::bad_alloc();
    return memory;
}

void* FreedBlocks::allocate_block(std::size_t bytes) {
    Surplus surplus;
    {
        const std::lock_guard lock(mutex_);
        if (void* memory = take_block(bytes, max_idle)) return memory;
        if (void* memory = take_pages_for_block(bytes)) return memory;
        // Uses a larger block rather than releasing it.
        const std::size_t needed = in_use_ + bytes;
        if (kept_ > max_kept_beside(needed))
            if (void* memory = take_block(bytes, max_idle_before_release)) return memory;
        in_use_ = needed;
        surplus = overflow(max_kept_beside(needed));
    }
    give_back(surplus);
    void* memory = nullptr;
    const bool given = posix_memalign(&memory, line, bytes) == 0;
    const std::lock_guard lock(mutex_);
    if (!given) give_back(overflow(0));
    if (!given && posix_memalign(&memory, line, bytes) != 0) {
        in_use_ -= bytes;
        throw std::bad_alloc();
    }
    // malloc may return a little more than requested.
    in_use_ += malloc_usable_size(memory) - bytes;
    max_in_use_ = std::max(max_in_use_, in_use_);
    return memory;
}

void* FreedBlocks::allocate_pages(std::size_t bytes) {
    std::vector<Pages> kept_pages;
    Surplus surplus;
    {
        const std::lock_guard lock(mutex_);
        kept_pages = take_pages(bytes);
        in_use_ += bytes;
        surplus = overflow(max_kept_beside(in_use_));
    }
    give_back(surplus);
    std::byte* memory = joined(kept_pages, bytes);
    const std::lock_guard lock(mutex_);
    if (memory == nullptr) {
        give_back(overflow(0));
        memory = map(bytes);
        new_pages_ += memory != nullptr ? bytes : 0;
    }
    if (memory == nullptr) {
        in_use_ -= bytes;
        throw std::bad_alloc();
    }
    max_in_use_ = std::max(max_in_use_, in_use_);
    used_pages_.emplace(memory, bytes);
    return memory;
}

void FreedBlocks::free(void* memory) {
    Surplus surplus;
    const auto keep = [&](auto& kept, std::size_t bytes, auto* block) {
        in_use_ -= bytes;
        kept_ += bytes;
        kept.emplace(bytes, block);
        surplus = overflow(max_kept_);
    };
    bool of_pages = false;
    if (is_on_huge_page(memory)) {
        const std::lock_guard lock(mutex_);
        const auto used = used_pages_.find(memory);
        of_pages = used != used_pages_.end();
        if (of_pages) {
            const std::size_t bytes = used->second;
            used_pages_.erase(used);
            keep(pages_, bytes, static_cast<std::byte*>(memory));
        }
    }
    if (!of_pages) {
        const std::size_t bytes = malloc_usable_size(memory);
        if (bytes < smallest_kept) return std::free(memory);
        const std::lock_guard lock(mutex_);
        keep(blocks_, bytes, memory);
    }
    give_back(surplus);
}

void FreedBlocks::set_max_kept(std::size_t max_kept) {
    Surplus surplus;
    {
        const std::lock_guard lock(mutex_);
        max_kept_ = max_kept;
        surplus = overflow(max_kept_);
    }
    give_back(surplus);
}

std::size_t FreedBlocks::kept() const {
    const std::lock_guard lock(mutex_);
    return kept_;
}

std::size_t FreedBlocks::in_use() const {
    const std::lock_guard lock(mutex_);
    return in_use_;
}

}  // namespace hogel::core
