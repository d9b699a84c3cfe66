#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/codec/block_kernels_internal.h"
#include "hogel/codec/hogel_order_internal.h"

namespace hogel {

// Samples of one hogel and channel, [v][u], filled up to whole blocks.
struct Plane {
    std::size_t width = 0, height = 0;
    std::vector<float> samples;
    Plane() = default;
    Plane(std::size_t w, std::size_t h) : width(w), height(h), samples(w * h) {}
};

// Directions along u and v by which what a block shows moves from a hogel to another, in 64ths.
constexpr int shift_unit = 64;
struct Shift {
    int u = 0, v = 0;
};

// Disparity: how many directions (in u, in 64ths) what a block shows moves from one hogel to the next: ΔU-steps of
// d/ζ. It moves `aspect` times as many directions in v.
constexpr int most_disparity = 1 << 14;
Shift shift_of(int disparity, const HogelOrder::Reference& reference, float aspect);

// The block at (x, y) as the plane shows it, moved; six-tap interpolation, the plane continued by its edges. Depends
// on the order of the additions, which is part of the format.
void fetch_moved(const Plane& plane, int x, int y, Shift shift, BlockSamples& block);

// Which whole blocks fetch_moved() looks at, for the block in this column and row.
struct BlockRange {
    std::size_t first_column, last_column, first_row, last_row;
};
BlockRange blocks_seen(std::size_t columns, std::size_t rows, std::size_t column, std::size_t row, Shift shift);

// Which hogels a block is predicted from: those that are likely to show it best at its disparity.
class ReferenceWeights {
  public:
    // @param noise   of each reference, relative to that of the best
    ReferenceWeights(const HogelOrder::Hogel& hogel, std::span<const float> noise, float aspect);

    enum class Side { any, left, right, above, below };
    static constexpr std::size_t sides = 5;
    struct Choice {
        std::uint32_t count = 0;
        std::array<std::uint32_t, 2> reference{};  // of hogel.references
        std::array<float, 2> weight{};             // their sum is 1
        std::array<Shift, 2> shift{};
    };
    // The best two for any side, the best one for one. None where there is nothing on that side. Valid until the next
    // call.
    const Choice& choose(int disparity, Side side) { return choices_for(disparity)[static_cast<std::size_t>(side)]; }

  private:
    using Choices = std::array<Choice, sides>;
    struct Kept {
        int disparity = -most_disparity - 1;
        Choices choices;
    };

    const Choices& choices_for(int disparity);

    const HogelOrder::Hogel& hogel_;
    std::vector<float> fixed_;
    float aspect_;
    std::vector<Kept> kept_;  // of the disparities asked for last, as neighbouring blocks ask for the same ones
};

}  // namespace hogel
