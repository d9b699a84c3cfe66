// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/format/block_syntax.h"
#include "hogel/codec/format/picture_memory.h"

namespace hogel::codec::format {

// The channels of one hogel as they are decoded, whole blocks.
using Picture = std::vector<Plane>;

// What all hogels of a tile share.
struct TileSetup {
    TileSetup(HogelOrder tile_order, std::size_t directions_u, std::size_t directions_v, std::size_t channels,
              float finest_step, float step_growth, float v_per_u);
    void set_steps(float finest, float growth);

    HogelOrder order;
    BlockGrid grid;
    std::size_t width, height;  // directions, without what fills the last blocks
    float aspect;               // ΔU/ΔV
    std::vector<float> step;    // the quantiser's, of each level of the order
    std::vector<float> noise;   // (step / that of level 0)², of each hogel in the order
    // What a level is taken for is its number and this part of a step: more often than not it stands for more.
    float beyond_level(bool within) const { return within ? 0.0625f : 0.1875f; }
    bool whole_blocks() const { return width == grid.columns * block_side && height == grid.rows * block_side; }
    // A picture whose samples mean nothing yet. It must not outlive the setup, which keeps its memory.
    Picture blank() const;
    std::unique_ptr<PictureMemory> memory;
};

// The orthonormal DCT of a block along the axes on which a basis has cosines, and its inverse. Depend on the order of
// the additions, which is part of the format.
void transform_block(Basis basis, const BlockSamples& in, BlockSamples& out);
void inverse_transform_block(Basis basis, const BlockSamples& in, BlockSamples& out);

// A block as it follows from the samples to its left and above it.
// @param how   below within_modes
void predict_within(const Plane& plane, std::size_t x, std::size_t y, int how, BlockSamples& block);
// As it follows from other hogels; false where there is none on that side.
bool predict_across(const std::vector<Picture>& pictures, const HogelOrder::Hogel& hogel,
                    const ReferenceWeights::Choice& choice, std::size_t channel, std::size_t x, std::size_t y,
                    BlockSamples& block);

// What a block, which is not within, is predicted from: its main part, and what lies beyond its line.
struct BlockChoices {
    std::size_t parts = 1;
    std::array<ReferenceWeights::Choice, 2> of;
};
BlockChoices choices_of(const Block& block, ReferenceWeights& weights);
// False where a part is predicted from a side on which there is nothing.
bool predict_parts(const std::vector<Picture>& pictures, const HogelOrder::Hogel& hogel, const Block& block,
                   const BlockChoices& choices, std::size_t channel, std::size_t x, std::size_t y,
                   BlockSamples& prediction);

// Adds levels times a step to a prediction, and puts it into its place.
// @param beyond_level   as of TileSetup
void place_block(Plane& plane, std::size_t x, std::size_t y, const BlockSamples& prediction, const Levels* levels,
                 Basis basis, float step, float beyond_level);

// What has become of a block's samples.
enum class BlockState : std::uint8_t { unknown, wanted, made };

// Makes the blocks that are wanted in the picture of a hogel whose blocks are told, from the pictures of its
// references. Throws Error(bad_input) where a block asks for a reference that is not there.
void reconstruct(const TileSetup& setup, std::size_t hogel, const CodedHogel& coded, std::span<BlockState> blocks,
                 std::vector<Picture>& pictures);

}  // namespace hogel::codec::format
