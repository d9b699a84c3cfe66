// SPDX-License-Identifier: Apache-2.0
#include "hogel/array.h"

#include <malloc.h>

#include <cstdlib>
#include <new>

#include "hogel/core/freed_blocks.h"
#include "hogel/resources.h"

namespace hogel {
namespace {

constexpr std::size_t line = 64;
// Blocks of this size are what malloc, too, takes from the system and gives back.
constexpr std::size_t large = std::size_t{128} << 10;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// A sanitizer shall see every block end.
constexpr std::size_t max_kept = 0;
#else
constexpr std::size_t max_kept = std::size_t{1} << 30;
#endif
// A few tiles of a light field.
constexpr std::size_t spare = std::size_t{32} << 20;

// Never destroyed, because other objects that live until the program ends may own blocks.
core::FreedBlocks& freed_blocks() {
    static auto* blocks = new core::FreedBlocks(max_kept, spare);
    return *blocks;
}

}  // namespace

void set_max_kept_memory(std::size_t bytes) { freed_blocks().set_max_kept(max_kept == 0 ? 0 : bytes); }

void* allocate_lines(std::size_t bytes) {
    if (bytes >= large) return freed_blocks().allocate(bytes);
    void* memory = nullptr;
    if (posix_memalign(&memory, line, bytes) != 0) throw std::bad_alloc();
    return memory;
}

void free_lines(void* memory) {
    if (malloc_usable_size(memory) >= large)
        freed_blocks().free(memory);
    else
        std::free(memory);
}

}  // namespace hogel
