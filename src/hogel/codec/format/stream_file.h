// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/codec/format/stream_header.h"
#include "hogel/compress.h"
#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"

namespace hogel::codec::format {

// Tiles of an array of hogels, numbered row by row.
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

// Maximum size of a tile; limits the memory that a reader allocates for a damaged header.
constexpr std::size_t max_tile_samples = std::size_t{1} << 28;

// Returns the parts of a stream: arrays of directions with consecutive tiles. A part is a face, or the array of all
// unfolded faces. Throws Error(usage) for faces that do not unfold.
std::vector<LightFieldGrid> coded_parts(const StreamInfo& info);
// Returns the directions of a part that belong to the light field.
DirectionCross counted(const StreamInfo& info);
// Returns the coder for the tiles of a part. Throws Error(usage) for a method that does not exist.
std::unique_ptr<TileCoder> coder_of_part(const StreamInfo& info, const LightFieldGrid& part);

struct StreamEntry {
    std::uint64_t offset, bytes;
    std::uint32_t checksum;
};

// Writes a stream. Tiles are appended one after the other (again after restart()); finish() writes them to the file
// layer by layer.
class StreamWriter {
  public:
    // With several ranks, only the root has files; the other ranks know their sizes.
    // @param into    file to write instead of `path`, or null
    // @param depth   file with the depth stream that info.depth describes
    StreamWriter(const std::filesystem::path& path, const StreamHeader& info, core::RawFile* into = nullptr,
                 const core::RawFile* depth = nullptr);
    void restart();
    // @param layers   ends of the tile's layers; small tiles may have fewer layers than the stream
    void append(std::span<const std::uint8_t> tile, std::span<const std::size_t> layers);
    // Sends the entries of the tiles appended by the root to all ranks.
    void share_entries();
    // Returns the bytes of the file if it were finished now.
    std::uint64_t size() const { return next_ + overhead(entries_.size() / layers_); }
    // Returns the bytes of a file with this number of tiles (of all parts), without the tiles.
    std::uint64_t overhead(std::size_t tiles) const;
    // @param filler   bytes added to size(): 0, or min_filler to max_filler
    void finish(std::uint64_t filler = 0);

  private:
    void write(core::RawFile& file, std::uint64_t filler);

    struct Files {
        Files(const std::filesystem::path& path, bool has_name)
            : spooled(core::folder_of(path), core::RawFile::Mode::unnamed, path) {
            if (has_name) output.emplace(path);
        }
        std::optional<core::OutputFile> output;
        core::RawFile spooled;  // tile by tile
    };
    std::optional<Files> files_;
    StreamHeader info_;
    std::size_t header_bytes_;  // without filler
    std::size_t layers_;
    core::RawFile* into_;
    const core::RawFile* depth_;
    std::uint64_t next_ = 0;
    std::vector<StreamEntry> entries_;  // tile by tile, the layers of each
};

// Reads a stream's header and index, and tiles on demand. Error messages name the file.
class StreamReader {
  public:
    enum class Content { light_field, depth };
    explicit StreamReader(const std::filesystem::path& path, Content content = Content::light_field);
    const StreamHeader& info() const { return info_; }
    const Tiling& tiling() const { return *tiling_; }
    const std::vector<LightFieldGrid>& parts() const { return parts_; }
    // Returns the first layers of a tile, concatenated.
    std::vector<std::uint8_t> read(std::size_t tile, std::size_t layers) const;
    [[noreturn]] void damaged(const std::string& why) const;

  private:
    std::uint64_t tiles() const { return tiling_->count() * parts_.size(); }
    std::uint64_t read_header(std::uint64_t begin);
    void read_index(std::uint64_t header);

    core::RawFile file_;
    std::string what_;
    std::uint64_t end_;  // of the stream in the file
    StreamHeader info_;
    std::optional<Tiling> tiling_;  // one for all parts
    std::vector<LightFieldGrid> parts_;
    std::vector<StreamEntry> index_;  // layer by layer, the tiles of each
};

}  // namespace hogel::codec::format
