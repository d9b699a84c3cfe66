// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "thesis/wavelets/line.h"

namespace hogel::wavelets {

constexpr std::size_t dct_block = 8;

/// Windowed DCT on lines of one length, `lane_count` lines at a time, in the layout of WaveletLine: blocks of eight
/// samples from the start of the line (the last one may be shorter) are replaced by their orthonormal DCT-II. Frequency
/// k of a block is stored at its sample k.
class DctLine {
  public:
    explicit DctLine(std::size_t length) : length_(length) {}
    std::size_t sample_of_row(std::size_t row) const { return row; }
    void forward(float* rows) const;
    void inverse(float* rows) const;
    std::size_t length() const { return length_; }

  private:
    std::size_t length_;
};

}  // namespace hogel::wavelets
