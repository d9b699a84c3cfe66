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

// The part of a block that may be idle, and of one that would have to go otherwise.
constexpr double max_idle = 0.25, max_idle_of_last = 0.6;

constexpr std::size_t line = 64, page = 4096, huge_page = std::size_t{2} << 20;
// From here on blocks are of huge pages.
constexpr std::size_t smallest_of_pages = 2 * huge_page;
// Smaller ones are malloc's own matter.
constexpr std::size_t smallest_kept = std::size_t{128} << 10;
// malloc may give up to a page and some more than was asked for, and a block's size is all that tells whether it was
// counted.
constexpr std::size_t smallest_counted = smallest_kept - 2 * page;

std::size_t whole(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

bool is_on_huge_page(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory) % huge_page == 0; }

void unmap(std::byte* first, std::size_t bytes) {
    if (bytes > 0) munmap(first, bytes);
}

// New pages, or nullptr.
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
            const std::size_t ahead = huge_page - reinterpret_cast<std::uintptr_t>(memory) % huge_page;
            unmap(memory, ahead);
            memory += ahead;
            unmap(memory + bytes, huge_page - ahead);
        }
    }
    // A hint; only the speed depends on whether the system follows it.
    if (memory != nullptr) madvise(memory, bytes, MADV_HUGEPAGE);
    return memory;
}

}  // namespace

FreedBlocks::~FreedBlocks() { give_back(overflow(0)); }

// One block of pieces that are kept, and of new pages for what they lack; nullptr if there are none, and then the
// pieces are gone.
std::byte* FreedBlocks::joined(const std::vector<Pages>& pieces, std::size_t bytes) {
    if (pieces.size() == 1 && pieces.front().bytes == bytes) return pieces.front().first;
    std::byte* const memory = map(bytes);
    std::size_t done = 0;
    bool moved = memory != nullptr;
    for (const Pages& piece : pieces) {
        // The pages change their address; nothing is copied.
        if (moved &&
            mremap(piece.first, piece.bytes, piece.bytes, MREMAP_MAYMOVE | MREMAP_FIXED, memory + done) == MAP_FAILED) {
            moved = false;
            // Not the place itself: it may be another's by now.
            unmap(memory, done);
            unmap(memory + done + piece.bytes, bytes - done - piece.bytes);
        }
        if (!moved) unmap(piece.first, piece.bytes);
        done += piece.bytes;
    }
    if (!moved) return nullptr;
    new_pages_ += bytes - done;
    return memory;
}

void FreedBlocks::give_back(const Surplus& surplus) {
    for (void* block : surplus.blocks) std::free(block);
    for (const Pages& pages : surplus.pages) unmap(pages.first, pages.bytes);
}

// The smallest kept block that is large enough, unless more than a part of it would be idle; of several, the one that
// was used last.
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

// Kept pages for so many bytes, or all: of the smallest that are enough, or else of as few as possible.
std::vector<FreedBlocks::Pages> FreedBlocks::take_pages(std::size_t bytes) {
    std::vector<Pages> taken;
    while (bytes > 0 && !pages_.empty()) {
        const auto smallest = pages_.lower_bound(bytes);
        const auto from = std::prev(smallest != pages_.end() ? pages_.upper_bound(smallest->first) : pages_.end());
        const auto [size, first] = *from;
        pages_.erase(from);
        const std::size_t part = std::min(size, bytes);
        if (size > part) pages_.emplace(size - part, first + part);
        taken.push_back({first, part});
        kept_ -= part;
        bytes -= part;
    }
    return taken;
}

// Kept pages in a row rather than new ones, unless more than half of them would be idle.
void* FreedBlocks::take_pages_for_block(std::size_t bytes) {
    const std::size_t pages = whole(bytes, huge_page);
    if (2 * bytes < pages || pages_.lower_bound(pages) == pages_.end()) return nullptr;
    std::byte* const memory = take_pages(pages).front().first;
    in_use_ += pages;
    used_pages_.emplace(memory, pages);
    return memory;
}

// Bytes that may be kept beside so many in use.
std::size_t FreedBlocks::can_stay(std::size_t in_use) const {
    return spare_ + (max_in_use_ > in_use ? max_in_use_ - in_use : 0);
}

// What must go so that no more than max_kept bytes stay: pages, which are the most, then the largest blocks.
FreedBlocks::Surplus FreedBlocks::overflow(std::size_t max_kept) {
    Surplus gone;
    if (kept_ > max_kept) gone.pages = take_pages(whole(kept_ - max_kept, huge_page));
    while (kept_ > max_kept) {
        const auto largest = std::prev(blocks_.end());
        kept_ -= largest->first;
        gone.blocks.push_back(largest->second);
        blocks_.erase(largest);
    }
    return gone;
}

void* FreedBlocks::allocate(std::size_t bytes) {
    if (bytes > std::numeric_limits<std::size_t>::max() / 2) throw std::bad_alloc();  // more than can be addressed
    if (bytes >= smallest_of_pages) return allocate_pages(whole(bytes, huge_page));
    if (bytes >= smallest_counted) return allocate_block(whole(std::max(bytes, smallest_kept), page));
    void* memory = nullptr;
    if (posix_memalign(&memory, line, bytes) != 0) throw std::bad_alloc();
    return memory;
}

void* FreedBlocks::allocate_block(std::size_t bytes) {
    Surplus gone;
    {
        const std::lock_guard lock(mutex_);
        if (void* memory = take_block(bytes, max_idle)) return memory;
        if (void* memory = take_pages_for_block(bytes)) return memory;
        // Rather than that a larger block goes, it is used.
        const std::size_t needed = in_use_ + bytes;
        if (kept_ > can_stay(needed))
            if (void* memory = take_block(bytes, max_idle_of_last)) return memory;
        in_use_ = needed;
        gone = overflow(can_stay(needed));
    }
    give_back(gone);
    void* memory = nullptr;
    const bool given = posix_memalign(&memory, line, bytes) == 0;
    const std::lock_guard lock(mutex_);
    if (!given) give_back(overflow(0));
    if (!given && posix_memalign(&memory, line, bytes) != 0) {
        in_use_ -= bytes;
        throw std::bad_alloc();
    }
    // malloc may give a little more than was asked for.
    in_use_ += malloc_usable_size(memory) - bytes;
    max_in_use_ = std::max(max_in_use_, in_use_);
    return memory;
}

void* FreedBlocks::allocate_pages(std::size_t bytes) {
    std::vector<Pages> pieces;
    Surplus gone;
    {
        const std::lock_guard lock(mutex_);
        pieces = take_pages(bytes);
        in_use_ += bytes;
        gone = overflow(can_stay(in_use_));
    }
    give_back(gone);
    std::byte* memory = joined(pieces, bytes);
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
    Surplus gone;
    const auto keep = [&](auto& kept, std::size_t bytes, auto* block) {
        in_use_ -= bytes;
        kept_ += bytes;
        kept.emplace(bytes, block);
        gone = overflow(max_kept_);
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
    give_back(gone);
}

void FreedBlocks::set_max_kept(std::size_t max_kept) {
    Surplus gone;
    {
        const std::lock_guard lock(mutex_);
        max_kept_ = max_kept;
        gone = overflow(max_kept_);
    }
    give_back(gone);
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
