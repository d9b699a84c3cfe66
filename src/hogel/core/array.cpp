// SPDX-License-Identifier: Apache-2.0
#include "hogel/array.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace hogel {

void* allocate_lines(std::size_t bytes) {
    constexpr std::size_t line = 64, huge_page = std::size_t{2} << 20;
    const bool large = bytes >= 2 * huge_page;
    void* memory = nullptr;
    if (posix_memalign(&memory, large ? huge_page : line, bytes) != 0) throw std::bad_alloc();
    // A hint; only the speed depends on whether the system follows it.
    if (large) madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);
    return memory;
}

void free_lines(void* memory) { std::free(memory); }

}  // namespace hogel
