// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>

#include "hogel/codec/format/reconstruct.h"
#include "hogel/compress.h"

namespace hogel::codec::decode {

// Decodes a tile of the coder "hogel" on demand. A hogel needs the syntax elements of its references, but only the
// blocks of their samples from which it is predicted. Decoded hogels and blocks are cached.
class HogelDecoder final : public TileDecoder {
  public:
    // Throws Error(bad_input).
    // @param layers   number of layers in `bytes`; the syntax elements of hogels in further layers are predicted
    HogelDecoder(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid, const HogelRange& range,
                 std::size_t layers);
    void read(LightFieldTile& part) override;

    // Returns the bytes of each hogel's code, [t][s]; 0 for hogels in further layers.
    std::vector<std::size_t> code_bytes() const;

    // Statistics for tests: number of hogels with known syntax elements, and of reconstructed blocks.
    std::size_t hogels_read() const;
    std::size_t blocks_reconstructed() const;

  private:
    std::span<format::BlockState> blocks_of(std::size_t hogel);
    const std::vector<format::Block>* context_blocks(std::size_t hogel) const;
    void take_layers(std::size_t layers);
    void decode(const std::vector<std::size_t>& wanted);
    void read_syntax_in_wavefronts(const std::vector<std::size_t>& wanted);
    void read_syntax(std::size_t hogel);
    std::vector<std::size_t> wanted_of_wavefront(std::size_t wavefront) const;
    void want_block(std::size_t hogel, std::size_t column, std::size_t row);
    void want_references(std::size_t hogel);
    void reconstruct_wanted(std::size_t hogel);

    std::vector<std::uint8_t> bytes_;
    HogelRange range_;
    format::TileSetup setup_;
    std::vector<std::size_t> order_index_;              // [hogel, row-major]: index in the order
    std::vector<format::BlockModels> models_;           // one per layer, in their initial states
    std::vector<std::span<const std::uint8_t>> codes_;  // one per hogel of these layers

    std::mutex mutex_;  // guards all members below, except complete pictures
    std::vector<format::CodedHogel> coded_;
    std::vector<std::uint8_t> syntax_read_, wanted_;  // one bool per hogel
    std::vector<format::BlockState> blocks_;          // blocks of all hogels
    std::vector<format::Picture> pictures_;
    std::vector<std::atomic<bool>> complete_;
};

// Returns the number of samples of a hogel padded to whole blocks.
std::size_t samples_in_blocks(const LightFieldGrid& grid);
// Returns whether a tile is within the limits of the format.
bool hogel_tile_fits(const LightFieldGrid& grid, const HogelRange& range);
constexpr std::size_t max_hogel_tile_side = 64;
constexpr std::size_t max_hogel_tile_samples = std::size_t{1} << 28;

}  // namespace hogel::codec::decode
