// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <memory>

#include "hogel/array.h"
#include "hogel/resources.h"

namespace hogel::core {

/// What a new array holds: anything, for one that is written before it is read, takes no time.
enum class Contents { zero, unset };

/// An array of complex values, in memory or in a mapped file without a name, which the system pages in and out and
/// removes with the array. It should be accessed by rows or by blocks of neighbouring columns.
class PagedArray {
  public:
    PagedArray() = default;
    /// Throws Error(usage) for an empty array and for one of more than scratch.memory bytes without a folder, and
    /// Error(cannot_write) if the file cannot be created or the disk is full.
    PagedArray(const Shape<2>& shape, const ScratchOptions& scratch, Contents contents = Contents::zero);

    View<std::complex<float>, 2> view() { return {data_.get(), shape_}; }
    View<const std::complex<float>, 2> view() const { return {data_.get(), shape_}; }
    const Shape<2>& shape() const { return shape_; }
    std::size_t extent(std::size_t axis) const { return shape_[axis]; }

  private:
    Shape<2> shape_{};
    struct Release {
        Release() : mapped_bytes(0) {}
        explicit Release(std::size_t bytes) : mapped_bytes(bytes) {}
        std::size_t mapped_bytes;  // 0: allocated in memory
        void operator()(std::complex<float>* data) const;
    };
    std::unique_ptr<std::complex<float>, Release> data_;
};

}  // namespace hogel::core
