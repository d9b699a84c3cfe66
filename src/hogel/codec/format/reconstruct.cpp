// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/reconstruct.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "hogel/error.h"
#include "hogel/math/dct.h"

namespace hogel::codec::format {
namespace {

struct Cosines {
    // The matrix [frequency][sample] and its transpose, rounded to multiples of 2^-20 so that all machines agree.
    std::array<BlockSamples, 2> of;
    Cosines() {
        for (std::size_t k = 0; k < block_side; ++k)
            for (std::size_t j = 0; j < block_side; ++j) {
                const auto element =
                    static_cast<float>(std::nearbyint(math::dct_element(block_side, k, j) * 0x1p20) * 0x1p-20);
                of[0][k * block_side + j] = of[1][j * block_side + k] = element;
            }
    }
};
const Cosines cosines;

void transform_along(Basis basis, const BlockSamples& matrix, const BlockSamples& transposed, const BlockSamples& in,
                     BlockSamples& out) {
    if (basis.cosines())
        transform_both_ways(matrix, transposed, in, out);
    else if (basis.cosines_u)
        transform_along_u(transposed, in, out);
    else if (basis.cosines_v)
        transform_along_v(matrix, in, out);
    else
        out = in;
}

}  // namespace

TileSetup::TileSetup(HogelOrder tile_order, std::size_t directions_u, std::size_t directions_v, std::size_t channels,
                     float finest_step, float step_growth, float v_per_u)
    : order(std::move(tile_order)),
      grid{(directions_u + block_side - 1) / block_side, (directions_v + block_side - 1) / block_side, channels},
      width(directions_u),
      height(directions_v),
      aspect(v_per_u),
      step(static_cast<std::size_t>(order.layers())),
      memory(std::make_unique<PictureMemory>(grid.count() * block_samples * sizeof(float),
                                             order.hogels().size() * grid.channels)) {
    set_steps(finest_step, step_growth);
}

void TileSetup::set_steps(float finest, float growth) {
    step.back() = finest;
    for (std::size_t layer = step.size() - 1; layer-- > 0;) step[layer] = step[layer + 1] / growth;
    noise.clear();
    for (const HogelOrder::Hogel& hogel : order.hogels()) {
        const float ratio = step[static_cast<std::size_t>(hogel.layer)] / step[0];
        noise.push_back(ratio * ratio);
    }
}

Picture TileSetup::blank() const {
    Picture picture;
    for (std::size_t c = 0; c < grid.channels; ++c)
        picture.emplace_back(grid.columns * block_side, grid.rows * block_side, memory.get());
    return picture;
}

void transform_block(Basis basis, const BlockSamples& in, BlockSamples& out) {
    transform_along(basis, cosines.of[0], cosines.of[1], in, out);
}

void inverse_transform_block(Basis basis, const BlockSamples& in, BlockSamples& out) {
    transform_along(basis, cosines.of[1], cosines.of[0], in, out);
}

namespace {

// Decoded samples along one side of a block, starting at the corner.
using Border = std::array<float, 1 + 2 * block_side>;
// Predicts a sample of a block, `along` samples along the first border and `away` samples from it, by continuing the
// borders along a direction. If the direction leads past the corner, uses a sample of the other border.
// @param halves   shift of the direction along the first border from one row to the next, in half samples
float along_direction(const Border& border, const Border& other, int halves, int along, int away) {
    const int position = 2 * along + halves * (away + 1), on_other = 1 + away + 2 * (along + 1) / halves;
    if (position < -2) return other[static_cast<std::size_t>(on_other)];
    const std::size_t index = static_cast<std::size_t>(position + 2) / 2;
    return position % 2 == 0 ? border[index] : 0.5f * (border[index] + border[index + 1]);
}

void predict_along(const Plane& plane, std::size_t x, std::size_t y, int predictor, BlockSamples& block) {
    // Each border repeats its last known sample. A missing border repeats the first sample of the other one.
    Border left, above;
    const auto sample = [&](std::size_t column, std::size_t row) { return plane.samples[row * plane.width + column]; };
    const bool on_left = x > 0, on_top = y > 0;
    const float missing = on_left ? sample(x - 1, y) : on_top ? sample(x, y - 1) : 0;
    left[0] = above[0] = on_left && on_top ? sample(x - 1, y - 1) : missing;
    for (std::size_t k = 0; k < 2 * block_side; ++k) {
        left[1 + k] = on_left ? sample(x - 1, y + std::min(k, block_side - 1)) : missing;
        above[1 + k] = on_top ? sample(std::min(x + k, plane.width - 1), y - 1) : missing;
    }
    constexpr std::array<int, intra_predictors - first_directional> halves{2, 1, -1, -2, -1, 1};
    constexpr int left_from = first_directional + 4;  // predictors before it continue the border above
    const int slope = halves[static_cast<std::size_t>(predictor - first_directional)];
    for (int r = 0; r < static_cast<int>(block_side); ++r)
        for (int c = 0; c < static_cast<int>(block_side); ++c)
            block[static_cast<std::size_t>(r) * block_side + static_cast<std::size_t>(c)] =
                predictor < left_from ? along_direction(above, left, slope, c, r)
                                      : along_direction(left, above, slope, r, c);
}

}  // namespace

void predict_intra(const Plane& plane, std::size_t x, std::size_t y, int predictor, BlockSamples& block) {
    // A missing border repeats the first sample of the other one; in the first block both are 0.
    float left[block_side] = {}, above[block_side] = {};
    if (predictor >= first_directional) return predict_along(plane, x, y, predictor, block);
    const auto sample = [&](std::size_t column, std::size_t row) { return plane.samples[row * plane.width + column]; };
    for (std::size_t k = 0; k < block_side; ++k) {
        left[k] = x > 0 ? sample(x - 1, y + k) : y > 0 ? sample(x, y - 1) : 0;
        above[k] = y > 0 ? sample(x + k, y - 1) : x > 0 ? sample(x - 1, y) : 0;
    }
    const auto fill = [&](auto&& value) {
        for (std::size_t r = 0; r < block_side; ++r)
            for (std::size_t c = 0; c < block_side; ++c) block[r * block_side + c] = value(r, c);
    };
    if (predictor == 0) {  // interpolates between both borders
        constexpr std::array<float, block_side + 1> number{0, 1, 2, 3, 4, 5, 6, 7, 8};
        fill([&](std::size_t r, std::size_t c) {
            return (number[7 - c] * left[r] + number[c + 1] * above[7] + number[7 - r] * above[c] +
                    number[r + 1] * left[7]) /
                   16;
        });
    } else if (predictor == 2) {
        fill([&](std::size_t r, std::size_t) { return left[r]; });
    } else if (predictor == 3) {
        fill([&](std::size_t, std::size_t c) { return above[c]; });
    } else {
        float mean = 0;
        for (std::size_t k = 0; k < block_side; ++k) mean += left[k] + above[k];
        mean /= 2 * block_side;
        fill([&](std::size_t, std::size_t) { return mean; });
    }
}

bool predict_inter(const std::vector<Picture>& pictures, const HogelOrder::Hogel& hogel,
                   const ReferenceWeights::Choice& choice, std::size_t channel, std::size_t x, std::size_t y,
                   BlockSamples& block) {
    if (choice.count == 0) return false;
    const auto fetch = [&](std::size_t k, BlockSamples& to) {
        fetch_warped(pictures[hogel.references[choice.reference[k]].hogel][channel], static_cast<int>(x),
                     static_cast<int>(y), choice.shift[k], to);
    };
    fetch(0, block);
    if (choice.count == 2) {
        BlockSamples other;
        fetch(1, other);
        mix_blocks(block, other, choice.weight[0], choice.weight[1], block);
    }
    return true;
}

BlockChoices choices_of(const Block& block, ReferenceWeights& weights) {
    using Side = ReferenceWeights::Side;
    if (block.mode != mode_partitioned)
        return {1, {weights.choose(block.disparity, static_cast<Side>(block.mode - mode_any))}};
    BlockChoices choices{2, {weights.choose(block.disparity, static_cast<Side>(block.side[0]))}};
    choices.of[1] = weights.choose(block.second_disparity, static_cast<Side>(block.side[1]));
    return choices;
}

bool predict_partitions(const std::vector<Picture>& pictures, const HogelOrder::Hogel& hogel, const Block& block,
                        const BlockChoices& choices, std::size_t channel, std::size_t x, std::size_t y,
                        BlockSamples& prediction) {
    if (!predict_inter(pictures, hogel, choices.of[0], channel, x, y, prediction)) return false;
    if (choices.partitions == 1) return true;
    BlockSamples second;
    if (!predict_inter(pictures, hogel, choices.of[1], channel, x, y, second)) return false;
    put_second_partition(block.edge, second, prediction);
    return true;
}

void place_block(Plane& plane, std::size_t x, std::size_t y, const BlockSamples& prediction, const Levels* levels,
                 Basis basis, float step, float reconstruction_offset) {
    BlockSamples residual;
    if (levels) {
        BlockSamples coefficients;
        for (std::size_t k = 0; k < block_samples; ++k) {
            const auto level = static_cast<float>((*levels)[k]);
            coefficients[k] = (level + (level > 0   ? reconstruction_offset
                                        : level < 0 ? -reconstruction_offset
                                                    : 0)) *
                              step;
        }
        inverse_transform_block(basis, coefficients, residual);
    }
    for (std::size_t r = 0; r < block_side; ++r) {
        float* row = &plane.samples[(y + r) * plane.width + x];
        const float* predicted = &prediction[r * block_side];
        if (levels)
            for (std::size_t c = 0; c < block_side; ++c) row[c] = predicted[c] + residual[r * block_side + c];
        else
            for (std::size_t c = 0; c < block_side; ++c)
                row[c] = predicted[c] + 0.0f;  // turns −0 into +0, as adding levels does
    }
}

void reconstruct(const TileSetup& setup, std::size_t hogel, const CodedHogel& coded, std::span<BlockState> blocks,
                 std::vector<Picture>& pictures) {
    const HogelOrder::Hogel& place = setup.order.hogels()[hogel];
    ReferenceWeights weights(place, setup.noise, setup.aspect);
    const float step = setup.step[static_cast<std::size_t>(place.layer)];
    if (pictures[hogel].empty()) pictures[hogel] = setup.blank();
    Picture& picture = pictures[hogel];
    auto levels = coded.levels.begin();
    BlockSamples prediction;
    for (std::size_t k = 0; k < setup.grid.count(); ++k) {
        const Block& block = coded.blocks[k];
        if (blocks[k] != BlockState::wanted) {
            levels += std::popcount(block.coded);
            continue;
        }
        const std::size_t x = k % setup.grid.columns * block_side, y = k / setup.grid.columns * block_side;
        BlockChoices choices;
        if (block.mode != mode_intra) choices = choices_of(block, weights);
        for (std::size_t c = 0; c < setup.grid.channels; ++c) {
            if (block.mode == mode_intra)
                predict_intra(picture[c], x, y, block.intra_predictor, prediction);
            else if (!predict_partitions(pictures, place, block, choices, c, x, y, prediction))
                throw Error(ErrorCode::bad_input, "a block is predicted from a hogel that is not there");
            place_block(picture[c], x, y, prediction, block.coded >> c & 1 ? &*levels++ : nullptr,
                        bases[block.basis[c]], step, setup.reconstruction_offset(block.mode == mode_intra));
        }
        blocks[k] = BlockState::reconstructed;
    }
}

}  // namespace hogel::codec::format
