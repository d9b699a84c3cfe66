// SPDX-License-Identifier: Apache-2.0
#include "hogel/array.h"

#include <cstddef>
#include <cstdlib>
#include <new>

#include "hogel/core/freed_blocks.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/resources.h"

namespace hogel {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// The sanitizers must see every allocation and deallocation.
void set_max_kept_memory(std::size_t) {}

void* allocate_lines(std::size_t bytes) {
    void* memory = nullptr;
    if (posix_memalign(&memory, 64, bytes) != 0) throw std::bad_alloc();
    return memory;
}

void free_lines(void* memory) { std::free(memory); }
#else
namespace {

constexpr std::size_t max_kept = std::size_t{1} << 30;
// Enough for a few tiles of a light field.
constexpr std::size_t spare = std::size_t{32} << 20;

// Never destroyed, because objects with a longer lifetime may own blocks.
core::FreedBlocks& freed_blocks() {
    static auto* blocks = new core::FreedBlocks(max_kept, spare);
    return *blocks;
}

constexpr std::size_t large = std::size_t{256} << 20;

// Makes the system clear the pages of a large block, which takes seconds for gigabytes. Checks for stop requests.
void touch(std::byte* memory, std::size_t bytes) {
    constexpr std::size_t page = 4096, bytes_between_checks = std::size_t{16} << 20;
    for (std::size_t offset = 0; offset < bytes; offset += page) {
        if (offset % bytes_between_checks == 0) core::throw_if_stopped();
        *static_cast<volatile std::byte*>(memory + offset) = std::byte{};
    }
}

}  // namespace

void set_max_kept_memory(std::size_t bytes) { freed_blocks().set_max_kept(bytes); }

void* allocate_lines(std::size_t bytes) {
    void* memory = freed_blocks().allocate(bytes);
    if (bytes < large) return memory;
    try {
        touch(static_cast<std::byte*>(memory), bytes);
    } catch (const Error&) {
        freed_blocks().free(memory);
        throw;
    }
    return memory;
}

void free_lines(void* memory) { freed_blocks().free(memory); }
#endif

}  // namespace hogel
