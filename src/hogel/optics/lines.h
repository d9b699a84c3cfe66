// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

namespace hogel::optics {

/// Number of lines that a thread processes as one block. Columns are then read in whole cache lines.
constexpr std::size_t block_lines = 16;

constexpr std::size_t blocks_of(std::size_t lines, std::size_t size = block_lines) { return (lines + size - 1) / size; }

/// Returns the padded stride of lines of `samples` samples. The padding avoids cache set conflicts between lines.
constexpr std::size_t stride_of(std::size_t samples) { return (samples + 15) / 8 * 8; }

/// Returns the index of frequency j in a transform of n samples.
constexpr std::size_t wrapped(std::ptrdiff_t j, std::size_t n) {
    const auto size = static_cast<std::ptrdiff_t>(n);
    return static_cast<std::size_t>(((j % size) + size) % size);
}

/// Copies frequencies first … first + count − 1 out of a transform of n samples.
template <class T>
void take_frequencies(const T* transform, std::size_t n, std::ptrdiff_t first, std::size_t count, T* out) {
    const std::size_t begin = wrapped(first, n), until_end = std::min(count, n - begin);
    std::copy_n(transform + begin, until_end, out);
    std::copy_n(transform, count - until_end, out + until_end);
}
/// Copies `count` frequencies into a transform of n samples, beginning at frequency `first`.
template <class T>
void put_frequencies(const T* in, std::size_t count, T* transform, std::size_t n, std::ptrdiff_t first) {
    const std::size_t begin = wrapped(first, n), until_end = std::min(count, n - begin);
    std::copy_n(in, until_end, transform + begin);
    std::copy_n(in + until_end, count - until_end, transform);
}

}  // namespace hogel::optics
