// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>

#include "hogel/array.h"
#include "hogel/core/object_pool.h"
#include "hogel/stereogram/stereogram.h"

namespace hogel::camera::speckle_free {

/// The powers |wave|² of the waves of hogels side by side, whose phases are random and independent, so that the mean of
/// infinitely many looks is a sum of their intensities.
class WavePowers {
  public:
    explicit WavePowers(stereogram::Hogels hogels) : hogels_(std::move(hogels)) {}

    /// Hogels across and down, and the samples along a side of one, which are as many as its waves.
    struct Counts {
        std::size_t across = 0, down = 0, samples = 0;
    };
    Counts counts() const;
    /// The powers of a part of the hogels, row by row: [hogel][row / 16][column][row mod 16] with frequencies 0 … n−1,
    /// zero in rows beyond n. Thread-safe.
    void read(const HogelRange& part, View<float, 2> out) const;

  private:
    stereogram::Hogels hogels_;
    mutable core::ObjectPool<Array<float, 2>> pool_;
};

}  // namespace hogel::camera::speckle_free
