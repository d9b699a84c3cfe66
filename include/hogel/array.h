// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "hogel/export.h"

namespace hogel {

/// The extents of an array, first axis first.
template <std::size_t Rank>
using Shape = std::array<std::size_t, Rank>;

/// Returns the number of elements of an array of this shape.
template <std::size_t Rank>
constexpr std::size_t count(const Shape<Rank>& shape) {
    std::size_t n = 1;
    for (std::size_t extent : shape) n *= extent;
    return n;
}

/// Allocates memory aligned to a cache line. Large blocks use huge pages where possible. Throws std::bad_alloc.
HOGEL_API void* allocate_lines(std::size_t bytes);
/// Frees memory from allocate_lines().
HOGEL_API void free_lines(void* memory);

/// A standard allocator of memory aligned to a cache line, as SIMD code and FFT plans require.
template <class T>
struct CacheLineAllocator {
    using value_type = T;

    CacheLineAllocator() = default;
    template <class U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(allocate_lines(n * sizeof(T))); }
    void deallocate(T* p, std::size_t) { free_lines(p); }
    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

/// A reference to a dense row-major array that another object owns. Cheap to copy.
template <class T, std::size_t Rank>
class View {
  public:
    View() = default;
    View(T* data, const Shape<Rank>& shape) : data_(data), shape_(shape) {}
    /// Converts a view of mutable elements to a view of constant elements.
    template <class U>
    requires(std::is_same_v<const U, T> && !std::is_same_v<U, T>) View(const View<U, Rank>& other)
        : data_(other.data()), shape_(other.shape()) {}

    T* data() const { return data_; }
    const Shape<Rank>& shape() const { return shape_; }
    std::size_t extent(std::size_t axis) const { return shape_[axis]; }
    std::size_t size() const { return count(shape_); }
    std::span<T> elements() const { return {data_, size()}; }

    template <class... Index>
    T& operator()(Index... index) const {
        static_assert(sizeof...(Index) == Rank);
        return data_[offset({static_cast<std::size_t>(index)...})];
    }
    /// Returns the sub-array at the index `first` of the first axis: a row of a picture, a channel of a light field.
    View<T, Rank - 1> operator[](std::size_t first) const requires(Rank > 1) {
        Shape<Rank - 1> rest;
        for (std::size_t axis = 1; axis < Rank; ++axis) rest[axis - 1] = shape_[axis];
        return {data_ + first * count(rest), rest};
    }

  private:
    std::size_t offset(const Shape<Rank>& index) const {
        std::size_t at = 0;
        for (std::size_t axis = 0; axis < Rank; ++axis) at = at * shape_[axis] + index[axis];
        return at;
    }

    T* data_ = nullptr;
    Shape<Rank> shape_{};
};

/// A dense row-major array that owns its elements. Elements are value-initialised and aligned to a cache line.
template <class T, std::size_t Rank>
class Array {
  public:
    Array() = default;
    explicit Array(const Shape<Rank>& shape) : shape_(shape), elements_(count(shape)) {}
    Array(const Shape<Rank>& shape, const T& value) : shape_(shape), elements_(count(shape), value) {}

    View<T, Rank> view() { return {elements_.data(), shape_}; }
    View<const T, Rank> view() const { return {elements_.data(), shape_}; }
    operator View<T, Rank>() { return view(); }
    operator View<const T, Rank>() const { return view(); }

    T* data() { return elements_.data(); }
    const T* data() const { return elements_.data(); }
    const Shape<Rank>& shape() const { return shape_; }
    std::size_t extent(std::size_t axis) const { return shape_[axis]; }
    std::size_t size() const { return elements_.size(); }
    std::span<T> elements() { return elements_; }
    std::span<const T> elements() const { return elements_; }

    template <class... Index>
    T& operator()(Index... index) {
        return view()(index...);
    }
    template <class... Index>
    const T& operator()(Index... index) const {
        return view()(index...);
    }
    auto operator[](std::size_t first) { return view()[first]; }
    auto operator[](std::size_t first) const { return view()[first]; }

  private:
    Shape<Rank> shape_{};
    std::vector<T, CacheLineAllocator<T>> elements_;
};

}  // namespace hogel
