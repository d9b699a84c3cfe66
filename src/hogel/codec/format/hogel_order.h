// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace hogel::codec::format {

// The order in which the hogels of a tile are coded, from far apart to side by side: first the corners, then what lies
// halfway between coded ones, and so on. A hogel is predicted from those of its own row and column that come earlier:
// on each side from the nearest ones, so that a hogel can be decoded without most of the others.
class HogelOrder {
  public:
    struct Reference {
        std::size_t hogel;  // its place in order()
        int ds, dt;         // where it lies, in hogels
    };
    struct Hogel {
        std::size_t s, t;  // column and row in the tile
        int level;         // 0 for what comes first
        std::size_t wave;  // needs nothing of its own wave
        std::vector<Reference> references;
        std::vector<Reference> tellers;  // those of the references whose disparities are moved here
    };

    // @param references_a_side   how many there are at most to the left, to the right, above and below
    // @param tellers_a_side      and how many of these tell disparities
    HogelOrder(std::size_t columns, std::size_t rows, std::size_t references_a_side, std::size_t tellers_a_side);
    // Of a tile of that size, without making its order.
    static int levels(std::size_t columns, std::size_t rows);
    const std::vector<Hogel>& hogels() const { return hogels_; }
    int levels() const { return hogels_.back().level + 1; }
    // The first hogel of each wave, and the end of the last.
    const std::vector<std::size_t>& waves() const { return waves_; }
    // The first wave of each level, and the end of the last.
    const std::vector<std::size_t>& waves_of_levels() const { return waves_of_levels_; }

  private:
    std::vector<Hogel> hogels_;
    std::vector<std::size_t> waves_, waves_of_levels_;
};

}  // namespace hogel::codec::format
