// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace hogel::render {

/// What a renderer looked at to find the samples that triangles cover.
struct Visits {
    std::uint64_t pieces = 0;   ///< shapes that were scan converted: simplices, or triangles in some projection
    std::uint64_t slices = 0;   ///< last slices of these, whose samples are tested one by one
    std::uint64_t samples = 0;  ///< pairs of a ray and a triangle that were tested
    std::uint64_t cuts = 0;     ///< of simplices by planes of V and U, whether or not a sample lies in the slice

    friend bool operator==(const Visits&, const Visits&) = default;
};

/// Implemented by renderers that count their visits. Several threads may read at once.
class CountsVisits {
  public:
    virtual ~CountsVisits() = default;
    /// The sum over all tiles that were read.
    Visits visits() const { return {pieces_, slices_, samples_, cuts_}; }

  protected:
    /// Adds the visits of one tile.
    void add_visits(const Visits& of_tile) const {
        pieces_ += of_tile.pieces;
        slices_ += of_tile.slices;
        samples_ += of_tile.samples;
        cuts_ += of_tile.cuts;
    }

  private:
    mutable std::atomic<std::uint64_t> pieces_ = 0, slices_ = 0, samples_ = 0, cuts_ = 0;
};

}  // namespace hogel::render
