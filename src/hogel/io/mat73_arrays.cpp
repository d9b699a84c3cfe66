// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/mat73_arrays.h"

namespace hogel::io {

std::uint64_t Mat73Array::samples() const {
    constexpr std::uint64_t max_samples = std::uint64_t{1} << 48;
    std::uint64_t n = 1;
    for (const std::uint64_t extent : shape) {
        if (n > max_samples / extent) return max_samples;
        n *= extent;
    }
    return n;
}

std::size_t Mat73Array::element_bytes() const {
    std::size_t bytes = 0;
    for (const Number number : numbers) bytes += bytes_of(number);
    return bytes;
}

}  // namespace hogel::io
