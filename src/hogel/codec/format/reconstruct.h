// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/format/block_syntax.h"
#include "hogel/codec/format/picture_memory.h"

namespace hogel::codec::format {

// Decoded channels of one hogel, padded to whole blocks.
using Picture = std::vector<Plane>;

// Number of context references of a hogel on each side. More references make the contexts worse.
constexpr std::size_t context_references_per_side = 1;

// Parameters shared by all hogels of a tile.
struct TileSetup {
    // @param v_per_u   ΔU/ΔV
    TileSetup(HogelOrder tile_order, std::size_t directions_u, std::size_t directions_v, std::size_t channels,
              float finest_step, float step_growth, float v_per_u);
    void set_steps(float finest, float growth);

    HogelOrder order;
    BlockGrid grid;
    std::size_t width, height;  // in directions, without padding
    float aspect;               // ΔU/ΔV
    std::vector<float> step;    // quantiser step of each layer of the order
    std::vector<float> noise;   // (step / step of layer 0)², for each hogel of the order
    // Returns the reconstruction offset: the fraction of a step that is added to a level, away from zero, because most
    // values that are rounded to a level are larger.
    float reconstruction_offset(bool intra) const { return intra ? 0.0625f : 0.1875f; }
    bool whole_blocks() const { return width == grid.columns * block_side && height == grid.rows * block_side; }
    // Returns a new, uninitialised picture. Must not outlive the setup, which owns its memory.
    Picture blank() const;
    std::unique_ptr<PictureMemory> memory;
};

// Apply the orthonormal DCT of a block, and its inverse, along the axes on which a basis has cosines. The order of the
// additions is part of the format.
void transform_block(Basis basis, const BlockSamples& in, BlockSamples& out);
void inverse_transform_block(Basis basis, const BlockSamples& in, BlockSamples& out);

// Predicts a block from the samples of the plane to its left and above it.
// @param predictor   below intra_predictors
void predict_intra(const Plane& plane, std::size_t x, std::size_t y, int predictor, BlockSamples& block);
// Predicts a block from other hogels. Returns false if there is no reference.
bool predict_inter(const std::vector<Picture>& pictures, const HogelOrder::Hogel& hogel,
                   const ReferenceWeights::Choice& choice, std::size_t channel, std::size_t x, std::size_t y,
                   BlockSamples& block);

// References of an inter block, one choice for each of its partitions.
struct BlockChoices {
    std::size_t partitions = 1;
    std::array<ReferenceWeights::Choice, 2> of;
};
BlockChoices choices_of(const Block& block, ReferenceWeights& weights);
// Predicts an inter block. Returns false if a partition has no reference.
bool predict_partitions(const std::vector<Picture>& pictures, const HogelOrder::Hogel& hogel, const Block& block,
                        const BlockChoices& choices, std::size_t channel, std::size_t x, std::size_t y,
                        BlockSamples& prediction);

// Stores a block: the prediction plus the residual, levels times a step.
// @param levels   null: no residual
void place_block(Plane& plane, std::size_t x, std::size_t y, const BlockSamples& prediction, const Levels* levels,
                 Basis basis, float step, float reconstruction_offset);

enum class BlockState : std::uint8_t { unknown, wanted, reconstructed };

// Reconstructs the wanted blocks of a hogel with known syntax elements, from the pictures of its references.
// Throws Error(bad_input) if a block has no reference.
void reconstruct(const TileSetup& setup, std::size_t hogel, const CodedHogel& coded, std::span<BlockState> blocks,
                 std::vector<Picture>& pictures);

}  // namespace hogel::codec::format
