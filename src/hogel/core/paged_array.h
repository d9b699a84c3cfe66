// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <memory>

#include "hogel/array.h"
#include "hogel/resources.h"

namespace hogel::core {

/// Initial content of an array. Unset content takes no time, for arrays that are written before they are read.
enum class Contents { zero, unset };

/// A complex array in memory or in a mapped file without a name, which the system removes with the array. Accesses
/// should go along rows or in blocks of adjacent columns.
class PagedArray {
  public:
    PagedArray() = default;
    /// Throws Error(usage) for an empty array, and for an array of more than scratch.memory bytes without a scratch
    /// folder. Throws Error(cannot_write) if the file cannot be created or the disk is full.
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
