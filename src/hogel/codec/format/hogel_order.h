// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace hogel::codec::format {

// Coding order of the hogels of a tile, by halving: the hogel in the middle, then the corners and the middles of the
// edges, then the hogels halfway between coded hogels, and so on. Each halving is a layer. A hogel is predicted from
// the nearest earlier hogels on each side in its row and column, so that decoding it requires few other hogels
// (docs/decisions/0030-codec-prediction.md).
class HogelOrder {
  public:
    struct Reference {
        std::size_t hogel;  // index in hogels()
        int ds, dt;         // offset in hogels
    };
    struct Hogel {
        std::size_t s, t;  // column and row in the tile
        int layer;
        std::size_t wavefront;  // hogels of one wavefront do not refer to each other
        std::vector<Reference> references;
        std::vector<Reference> context_references;  // provide contexts for the syntax elements of this hogel
    };

    // @param references_per_side           maximum number to the left, to the right, above and below
    // @param context_references_per_side   likewise
    HogelOrder(std::size_t columns, std::size_t rows, std::size_t references_per_side,
               std::size_t context_references_per_side);
    // Returns the number of layers of a tile of this size, without computing its order.
    static int layers(std::size_t columns, std::size_t rows);
    const std::vector<Hogel>& hogels() const { return hogels_; }
    int layers() const { return hogels_.back().layer + 1; }
    // Returns the index of the first hogel of each wavefront, and the end of the last.
    const std::vector<std::size_t>& wavefronts() const { return wavefronts_; }
    // Returns the index of the first wavefront of each layer, and the end of the last.
    const std::vector<std::size_t>& wavefronts_of_layers() const { return wavefronts_of_layers_; }

  private:
    std::vector<Hogel> hogels_;
    std::vector<std::size_t> wavefronts_, wavefronts_of_layers_;
};

}  // namespace hogel::codec::format
