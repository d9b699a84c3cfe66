#pragma once

#include <cstddef>
#include <vector>

namespace hogel {

// The order in which the hogels of a tile are coded, from far apart to side by side: first the corners, then what lies
// halfway between coded ones, and so on. A hogel is predicted from those of its own row and column that come earlier.
class HogelOrder {
  public:
    struct Reference {
        std::size_t hogel;  // its place in order()
        int ds, dt;         // where it lies, in hogels
    };
    struct Hogel {
        std::size_t s, t;  // column and row in the tile
        int level;         // 0 for the corners
        std::size_t wave;  // needs nothing of its own wave
        std::vector<Reference> references;
    };

    HogelOrder(std::size_t columns, std::size_t rows);
    const std::vector<Hogel>& hogels() const { return hogels_; }
    int levels() const { return hogels_.back().level + 1; }
    // The first hogel of each wave, and the end of the last.
    const std::vector<std::size_t>& waves() const { return waves_; }

  private:
    std::vector<Hogel> hogels_;
    std::vector<std::size_t> waves_;
};

}  // namespace hogel
