// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>

#include "hogel/array.h"
#include "hogel/core/object_pool.h"
#include "hogel/stereogram/stereogram.h"

namespace hogel::camera::speckle_free {

/// Source of the powers |wave|² of the waves of hogels. The phases are random and independent, so the mean of
/// infinitely many looks is a sum of intensities.
class WavePowers {
  public:
    explicit WavePowers(stereogram::Hogels hogels) : hogels_(std::move(hogels)) {}

    /// Hogels across and down, and samples along a side of a hogel, the number of its waves along an axis.
    struct Counts {
        std::size_t across = 0, down = 0, samples = 0;
    };
    Counts counts() const;
    /// Reads the powers of a range of hogels in row-major order: [hogel][row / 16][column][row mod 16] with frequencies
    /// 0 … n−1, zero in rows beyond n. Thread-safe.
    void read(const HogelRange& range, View<float, 2> out) const;

  private:
    stereogram::Hogels hogels_;
    mutable core::ObjectPool<Array<float, 2>> pool_;
};

}  // namespace hogel::camera::speckle_free
