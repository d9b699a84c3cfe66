// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace hogel::render {

/// Work counts of a renderer for finding the samples that triangles cover.
struct Visits {
    std::uint64_t pieces = 0;   ///< scan-converted shapes: simplices, or projected triangles
    std::uint64_t slices = 0;   ///< last slices of the pieces, tested sample by sample
    std::uint64_t samples = 0;  ///< tested pairs of a ray and a triangle
    std::uint64_t cuts = 0;     ///< of simplices by planes of V and U, also if the slice holds no sample

    friend bool operator==(const Visits&, const Visits&) = default;
};

/// Interface of renderers that count their visits. Several threads may read at once.
class CountsVisits {
  public:
    virtual ~CountsVisits() = default;
    /// Returns the sum over all tiles read so far.
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
