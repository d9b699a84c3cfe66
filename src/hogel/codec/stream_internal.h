#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/codec/stream.h"
#include "hogel/codec/tile_coder.h"
#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"

namespace hogel {

// The tiles of a stream, numbered row by row.
class Tiling {
  public:
    Tiling(const LightFieldGrid& grid, const HogelRange& size);
    std::size_t count() const { return across_ * down_; }
    std::size_t across() const { return across_; }
    const HogelRange& size() const { return size_; }
    HogelRange operator[](std::size_t tile) const;

  private:
    std::size_t hogels_s_, hogels_t_, across_, down_;
    HogelRange size_;
};

// The largest tile that a stream may have; what a damaged header can make a reader ask memory for.
constexpr std::size_t most_tile_samples = std::size_t{1} << 28;

// The arrays of directions whose tiles a stream holds one after the other, all tiles of the first before those of the
// second: its faces, or what they unfold into. Throws Error(usage) for faces that do not unfold.
std::vector<LightFieldGrid> coded_parts(const StreamInfo& info);
// What of such an array is the light field's.
DirectionCross counted(const StreamInfo& info);

// Writes a stream's tiles one after the other; they may be written anew from the first until finish().
class StreamWriter {
  public:
    StreamWriter(const std::filesystem::path& path, const StreamInfo& info);
    // Forgets the tiles written so far.
    void restart();
    void append(std::span<const std::uint8_t> tile);
    // Of the whole file, as if it were finished now.
    std::uint64_t size() const { return next_ + overhead(index_.size()) - first_; }
    // What a file of so many tiles, of all parts, has beside them.
    std::uint64_t overhead(std::size_t tiles) const;
    void finish();

  private:
    struct Entry {
        std::uint64_t bytes;
        std::uint32_t checksum;
    };

    OutputFile output_;
    RawFile file_;
    std::uint64_t first_ = 0, next_ = 0;
    std::vector<Entry> index_;
};

// Reads a stream's header and index, and tiles on demand. Errors name the file.
class StreamReader {
  public:
    explicit StreamReader(const std::filesystem::path& path);
    const StreamInfo& info() const { return info_; }
    const Tiling& tiling() const { return *tiling_; }
    const std::vector<LightFieldGrid>& parts() const { return parts_; }
    std::vector<std::uint8_t> read(std::size_t tile) const;
    [[noreturn]] void damaged(const std::string& why) const;

  private:
    struct Entry {
        std::uint64_t offset, bytes;
        std::uint32_t checksum;
    };

    RawFile file_;
    StreamInfo info_;
    std::optional<Tiling> tiling_;  // of each part
    std::vector<LightFieldGrid> parts_;
    std::vector<Entry> index_;
};

}  // namespace hogel
