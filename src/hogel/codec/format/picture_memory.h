// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <vector>

#include "hogel/array.h"

namespace hogel::codec::format {

// Memory resource for the planes of a tile, all of equal size, cut from large allocations. Large allocations get huge
// pages; a single plane is too small for them, and supplying small pages takes longer than writing them. Thread-safe.
class PictureMemory final : public std::pmr::memory_resource {
  public:
    // @param plane_bytes   size of each plane
    // @param planes        maximum number of planes at the same time
    PictureMemory(std::size_t plane_bytes, std::size_t planes)
        : plane_bytes_(plane_bytes),
          planes_a_block_(std::clamp<std::size_t>(max_block_bytes / plane_bytes, 1, std::max<std::size_t>(planes, 1))) {
    }

  private:
    static constexpr std::size_t max_block_bytes = std::size_t{8} << 20;

    void* do_allocate(std::size_t bytes, std::size_t) override {
        if (bytes != plane_bytes_) return allocate_lines(bytes);
        const std::lock_guard lock(mutex_);
        if (free_.empty()) {
            blocks_.emplace_back(static_cast<std::byte*>(allocate_lines(plane_bytes_ * planes_a_block_)));
            for (std::size_t n = planes_a_block_; n-- > 0;) free_.push_back(blocks_.back().get() + n * plane_bytes_);
        }
        void* plane = free_.back();
        free_.pop_back();
        return plane;
    }
    void do_deallocate(void* memory, std::size_t bytes, std::size_t) override {
        if (bytes != plane_bytes_) return free_lines(memory);
        const std::lock_guard lock(mutex_);
        free_.push_back(memory);
    }
    bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }

    struct Release {
        void operator()(std::byte* block) const { free_lines(block); }
    };
    std::size_t plane_bytes_, planes_a_block_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<std::byte, Release>> blocks_;
    std::vector<void*> free_;
};

}  // namespace hogel::codec::format
