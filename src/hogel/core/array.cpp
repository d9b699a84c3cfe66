// SPDX-License-Identifier: Apache-2.0
#include "hogel/array.h"

#include <cstddef>
#include <cstdlib>
#include <new>

#include "hogel/core/freed_blocks.h"
#include "hogel/resources.h"

namespace hogel {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// A sanitizer shall see every block begin and end.
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
// A few tiles of a light field.
constexpr std::size_t spare = std::size_t{32} << 20;

// Never destroyed, because other objects that live until the program ends may own blocks.
core::FreedBlocks& freed_blocks() {
    static auto* blocks = new core::FreedBlocks(max_kept, spare);
    return *blocks;
}

}  // namespace

void set_max_kept_memory(std::size_t bytes) { freed_blocks().set_max_kept(bytes); }

void* allocate_lines(std::size_t bytes) { return freed_blocks().allocate(bytes); }

void free_lines(void* memory) { freed_blocks().free(memory); }
#endif

}  // namespace hogel
