// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/io/hdf5/sample_server.h"

namespace hogel::io::hdf5 {

// Calls run(index in the array, index in the box, samples) for each contiguous run of a box of a row-major array.
template <class Run>
void for_each_run(const std::vector<std::size_t>& shape, const Box& box, const Run& run) {
    // A run spans the innermost axes that the box covers completely, and its range of the next axis.
    std::size_t axis = shape.size() - 1, length = box.extent[axis];
    while (axis > 0 && box.extent[axis] == shape[axis]) length *= box.extent[--axis];
    std::size_t runs = 1;
    for (std::size_t outer = 0; outer < axis; ++outer) runs *= box.extent[outer];
    for (std::size_t i = 0; i < runs; ++i) {
        std::size_t remainder = i, position = 0, stride = 1;
        for (std::size_t a = shape.size(); a-- > 0;) {
            std::size_t index = box.start[a];
            if (a < axis) {
                index += remainder % box.extent[a];
                remainder /= box.extent[a];
            }
            position += index * stride;
            stride *= shape[a];
        }
        run(position, i * length, length);
    }
}

inline std::size_t samples_of(const std::vector<std::size_t>& shape) {
    std::size_t n = 1;
    for (std::size_t extent : shape) n *= extent;
    return n;
}

}  // namespace hogel::io::hdf5
