// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/freed_blocks.h"

#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <new>

namespace hogel::core {
namespace {

// The part of a block that may be idle, and of one that would have to go otherwise.
constexpr double max_idle = 0.25, max_idle_of_last = 0.6;

constexpr std::size_t line = 64, page = 4096, huge_page = std::size_t{2} << 20;

// Whole pages, so that sizes that hardly differ are one size.
std::size_t rounded(std::size_t bytes) {
    const std::size_t unit = bytes >= 2 * huge_page ? huge_page : page;
    return (bytes + unit - 1) / unit * unit;
}

void* fresh(std::size_t bytes) {
    const bool large = bytes >= 2 * huge_page;
    void* memory = nullptr;
    if (posix_memalign(&memory, large ? huge_page : line, bytes) != 0) return nullptr;
    // A hint; only the speed depends on whether the system follows it.
    if (large) madvise(memory, bytes, MADV_HUGEPAGE);
    return memory;
}

}  // namespace

FreedBlocks::~FreedBlocks() {
    for (const auto& [bytes, memory] : blocks_) std::free(memory);
}

// The smallest kept block that is large enough, unless more than a part of it would be idle; of several, the one that
// was used last.
void* FreedBlocks::take(std::size_t bytes, double idle) {
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

// Blocks that must go so that no more than max_kept bytes stay.
std::vector<void*> FreedBlocks::overflow(std::size_t max_kept) {
    std::vector<void*> gone;
    while (kept_ > max_kept) {
        const auto largest = std::prev(blocks_.end());
        kept_ -= largest->first;
        gone.push_back(largest->second);
        blocks_.erase(largest);
    }
    return gone;
}

void* FreedBlocks::allocate(std::size_t bytes) {
    bytes = rounded(std::max<std::size_t>(1, bytes));
    if (bytes == 0) throw std::bad_alloc();  // more than can be addressed
    std::vector<void*> gone;
    {
        const std::lock_guard lock(mutex_);
        if (void* memory = take(bytes, max_idle)) return memory;
        const std::size_t needed = in_use_ + bytes;
        const std::size_t can_stay = spare_ + (max_in_use_ > needed ? max_in_use_ - needed : 0);
        // Rather than that a larger block goes, it is used.
        if (kept_ > can_stay)
            if (void* memory = take(bytes, max_idle_of_last)) return memory;
        in_use_ = needed;
        gone = overflow(can_stay);
    }
    for (void* block : gone) std::free(block);
    void* memory = fresh(bytes);
    const std::lock_guard lock(mutex_);
    if (memory == nullptr) {
        for (void* block : overflow(0)) std::free(block);
        memory = fresh(bytes);
    }
    if (memory == nullptr) {
        in_use_ -= bytes;
        throw std::bad_alloc();
    }
    // malloc may give a little more than was asked for.
    in_use_ += malloc_usable_size(memory) - bytes;
    max_in_use_ = std::max(max_in_use_, in_use_);
    return memory;
}

void FreedBlocks::free(void* memory) {
    const std::size_t bytes = malloc_usable_size(memory);
    std::vector<void*> gone;
    {
        const std::lock_guard lock(mutex_);
        in_use_ -= bytes;
        kept_ += bytes;
        blocks_.emplace(bytes, memory);
        gone = overflow(max_kept_);
    }
    for (void* block : gone) std::free(block);
}

void FreedBlocks::set_max_kept(std::size_t max_kept) {
    std::vector<void*> gone;
    {
        const std::lock_guard lock(mutex_);
        max_kept_ = max_kept;
        gone = overflow(max_kept_);
    }
    for (void* block : gone) std::free(block);
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
