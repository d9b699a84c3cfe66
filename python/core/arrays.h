// SPDX-License-Identifier: Apache-2.0
#pragma once

// NumPy arrays that share memory with arrays of the library. Nothing here copies.

#include <pybind11/complex.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <utility>

#include "core.h"
#include "hogel/array.h"

namespace hogel::python {

/// Returns a NumPy array over memory that the Python object `owner` keeps alive.
template <class T, std::size_t Rank>
py::array array_over(T* data, const Shape<Rank>& shape, const py::object& owner) {
    return py::array_t<std::remove_const_t<T>>(std::vector<py::ssize_t>(shape.begin(), shape.end()), data, owner);
}

/// Returns a NumPy array that takes ownership of the memory of an Array.
template <class T, std::size_t Rank>
py::array array_of(Array<T, Rank>&& array) {
    auto* const owned = new Array<T, Rank>(std::move(array));
    const py::capsule owner(owned, [](void* memory) { delete static_cast<Array<T, Rank>*>(memory); });
    return array_over(owned->data(), owned->shape(), owner);
}

/// Returns the shape of an array. Throws Error(usage) for another rank.
template <std::size_t Rank>
Shape<Rank> shape_of(const py::array& array, const char* what) {
    if (array.ndim() != static_cast<py::ssize_t>(Rank))
        throw Error(ErrorCode::usage, what,
                    std::string(what) + ": expected an array of " + std::to_string(Rank) + " axes, not of " +
                        std::to_string(array.ndim()));
    Shape<Rank> shape;
    for (std::size_t axis = 0; axis < Rank; ++axis) shape[axis] = static_cast<std::size_t>(array.shape(axis));
    return shape;
}

/// Elements of a NumPy array with any strides, including negative ones. Keeps the Python object alive.
template <class T, std::size_t Rank>
class Strided {
  public:
    /// Throws Error(usage) for an array of another rank or type.
    Strided(const py::array& array, const char* what)
        : shape_(shape_of<Rank>(array, what)), data_(static_cast<const char*>(array.data())), owner_(share(array)) {
        if (!py::isinstance<py::array_t<T>>(array) || (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) == 0)
            throw Error(ErrorCode::usage, what, std::string(what) + ": wrong element type");
        std::size_t dense = sizeof(T);
        for (std::size_t axis = Rank; axis-- > 0; dense *= shape_[axis]) {
            strides_[axis] = array.strides(axis);
            is_dense_ = is_dense_ && (shape_[axis] <= 1 || strides_[axis] == static_cast<std::ptrdiff_t>(dense));
        }
    }

    const Shape<Rank>& shape() const { return shape_; }
    /// Returns whether the elements are contiguous in row-major order from data().
    bool is_dense() const { return is_dense_; }
    const T* data() const { return reinterpret_cast<const T*>(data_); }
    std::ptrdiff_t stride(std::size_t axis) const { return strides_[axis]; }
    /// Returns the address of an element, given by `Rank` indices.
    template <class... Index>
    const char* at(Index... index) const {
        static_assert(sizeof...(Index) == Rank);
        const std::array<std::size_t, Rank> indices{static_cast<std::size_t>(index)...};
        const char* address = data_;
        for (std::size_t axis = 0; axis < Rank; ++axis)
            address += static_cast<std::ptrdiff_t>(indices[axis]) * strides_[axis];
        return address;
    }
    /// Copies elements along the last axis.
    void copy_row(const char* from, std::size_t count, T* to) const {
        const std::ptrdiff_t step = strides_[Rank - 1];
        if (step == sizeof(T))
            std::copy_n(reinterpret_cast<const T*>(from), count, to);
        else
            for (std::size_t i = 0; i < count; ++i, from += step) to[i] = *reinterpret_cast<const T*>(from);
    }
    /// Returns the Python array.
    const py::object& object() const { return *owner_; }

  private:
    Shape<Rank> shape_;
    std::array<std::ptrdiff_t, Rank> strides_{};
    const char* data_;
    bool is_dense_ = true;
    std::shared_ptr<const py::object> owner_;
};

}  // namespace hogel::python
