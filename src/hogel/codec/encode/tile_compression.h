// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "hogel/codec/encode/step_search.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/coding/histogram_rule.h"

namespace hogel::codec::encode {

// Pool of tiles for reuse, because allocating pages of new memory takes longer than writing to them.
class SpareTiles {
  public:
    LightFieldTile take(const LightFieldGrid& grid, const HogelRange& range);
    void give_back(LightFieldTile tile);

  private:
    std::mutex mutex_;
    std::vector<LightFieldTile> tiles_;
};

// An array of directions of a stream, and the coder of its tiles.
struct CodedPart {
    LightField::Source source;
    std::unique_ptr<TileCoder> coder;
};

// Reads, codes and writes the tiles of all parts of a light field, on all threads.
class TileCompression {
  public:
    TileCompression(std::span<const CodedPart> parts, const StreamInfo& info, format::StreamWriter& writer,
                    const Progress& progress)
        : parts_(parts),
          tiling_(info.grid, info.tile),
          counted_(format::counted(info)),
          writer_(writer),
          progress_(progress) {}

    // Returns the number of tiles of all parts. Tiles are numbered part by part.
    std::size_t tiles() const { return parts_.size() * tiling_.count(); }
    bool embedded() const { return parts_.front().coder->min_bytes(parts_.front().source->grid()).has_value(); }
    double samples() const;

    // Codes some tiles, and writes them if `write`.
    // @param max_bytes   limit of each tile; empty: no limit
    CodingOutcome code(std::span<const std::size_t> tiles, double step, bool write,
                       std::span<const std::size_t> max_bytes = {});
    // Sums only over the signal, without coding.
    CodingOutcome look(std::span<const std::size_t> tiles);
    // Counts the coefficients of all tiles. Throws Error(usage) for a coder that does not count them.
    coding::MagnitudeHistogram magnitudes();
    // Codes the middle of the middle tile. Returns its bytes and the root mean square of the signal there.
    std::pair<double, double> try_middle(double step) const;
    // Returns the cut sizes of the last written tiles for a file of `file` bytes.
    std::vector<std::size_t> cut(double file) const;

  private:
    struct Coded {
        std::vector<std::uint8_t> bytes;
        std::vector<std::size_t> layers;
        CodingOutcome outcome;
    };

    std::size_t in_flight() const;
    std::pair<LightFieldTile, CodingOutcome> read(std::size_t index) const;
    std::pair<LightFieldTile, CodingOutcome> read(const CodedPart& part, const HogelRange& range) const;
    Coded code_tile(std::size_t index, double step, std::size_t max_bytes) const;

    std::span<const CodedPart> parts_;
    format::Tiling tiling_;
    DirectionCross counted_;
    format::StreamWriter& writer_;
    const Progress& progress_;
    mutable SpareTiles spare_;
    std::vector<std::size_t> sizes_;
};

}  // namespace hogel::codec::encode
