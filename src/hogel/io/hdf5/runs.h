// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/io/hdf5/sample_server.h"

namespace hogel::io::hdf5 {

// Calls run(index in the array, index in the box, samples) for each contiguous run of samples of a box of a row-major
// array.
template <class Run>
void for_each_run(const std::vector<std::size_t>& shape, const Box& box, const Run& run) {
    // A run extends over the innermost axes that the box spans completely and along the next one.
    std::size_t axis = shape.size() - 1, length = box.extent[axis];
    while (axis > 0 && box.extent[axis] == shape[axis]) length *= box.extent[--axis];
    std::size_t runs = 1;
    for (std::size_t outer = 0; outer < axis; ++outer) runs *= box.extent[outer];
    for (std::size_t i = 0; i < runs; ++i) {
        std::size_t rest = i, at = 0, stride = 1;
        for (std::size_t a = shape.size(); a-- > 0;) {
            std::size_t index = box.start[a];
            if (a < axis) {
                index += rest % box.extent[a];
                rest /= box.extent[a];
            }
            at += index * stride;
            stride *= shape[a];
        }
        run(at, i * length, length);
    }
}

inline std::size_t samples_of(const std::vector<std::size_t>& shape) {
    std::size_t n = 1;
    for (std::size_t extent : shape) n *= extent;
    return n;
}

}  // namespace hogel::io::hdf5
