// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>

#include "hogel/codec/format/reconstruct.h"
#include "hogel/compress.h"

namespace hogel::codec::decode {

// A tile of the coder "hogel", decoded as far as it is asked for: a hogel takes those that it is predicted from, and of
// these the blocks that it shows. What has been decoded stays.
class HogelDecoder final : public TileDecoder {
  public:
    // @param levels   of the order, that `bytes` have; hogels of the others are guessed
    // Throws Error(bad_input).
    HogelDecoder(std::vector<std::uint8_t> bytes, const LightFieldGrid& grid, const HogelRange& range,
                 std::size_t levels);
    void read(LightFieldTile& part) override;

    // What has been decoded so far: hogels of which all is told, and blocks made.
    std::size_t hogels_told() const;
    std::size_t blocks_made() const;

  private:
    std::span<format::BlockState> blocks_of(std::size_t hogel);
    const std::vector<format::Block>* beside(std::size_t hogel) const;
    void take_levels(std::size_t levels);
    void decode(const std::vector<std::size_t>& wanted);
    void tell_in_waves(const std::vector<std::size_t>& wanted);
    void tell(std::size_t hogel);
    std::vector<std::size_t> wanted_of_wave(std::size_t wave) const;
    void want_block(std::size_t hogel, std::size_t column, std::size_t row);
    void want_what_is_shown(std::size_t hogel);
    void make(std::size_t hogel);

    std::vector<std::uint8_t> bytes_;
    HogelRange range_;
    format::TileSetup setup_;
    std::vector<std::size_t> place_;                    // in the order, of hogels row by row
    std::vector<format::BlockModels> models_;           // of each level, as they begin
    std::vector<std::span<const std::uint8_t>> codes_;  // of the hogels of these levels

    std::mutex mutex_;  // of all that follows but pictures that are complete
    std::vector<format::CodedHogel> coded_;
    std::vector<std::uint8_t> told_, wanted_;  // bools
    std::vector<format::BlockState> blocks_;   // of all hogels
    std::vector<format::Picture> pictures_;
    std::vector<std::atomic<bool>> complete_;
};

// Samples of a hogel, in whole blocks.
std::size_t samples_in_blocks(const LightFieldGrid& grid);
// True where the coder's tiles may be so large.
bool hogel_tile_fits(const LightFieldGrid& grid, const HogelRange& range);
constexpr std::size_t max_hogel_tile_side = 64;
constexpr std::size_t max_hogel_tile_samples = std::size_t{1} << 28;

// How many references of a side tell their disparities: more make them worse.
constexpr std::size_t tellers_a_side = 1;

}  // namespace hogel::codec::decode
