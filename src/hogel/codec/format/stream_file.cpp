// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/stacked.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/codec/format/stream_header.h"
#include "hogel/codec/format/unfolded.h"
#include "hogel/codec/tile_coder.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::codec::format {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t prefix = stream_magic.size() + 8;  // magic, version and length of the header
constexpr std::size_t entry_bytes = 8, checksum_bytes = 4;
constexpr std::uint32_t max_header = 1 << 24;

bool tile_fits(const LightFieldGrid& grid, const HogelRange& tile) {
    if (tile.ns == 0 || tile.nt == 0 || tile.ns > grid.hogels_s || tile.nt > grid.hogels_t) return false;
    std::size_t budget = max_tile_samples;
    for (const std::size_t extent : {grid.channels, tile.ns, tile.nt, grid.directions_u, grid.directions_v})
        budget /= extent;
    return budget > 0;
}

// Returns whether two streams have the same rays; their channels may differ.
bool same_faces(const StreamInfo& a, const StreamInfo& b) {
    const auto rays = [](const StreamInfo& info) {
        std::vector<LightFieldGrid> faces = info.faces();
        for (LightFieldGrid& face : faces) face.channels = 1;
        return faces;
    };
    return rays(a) == rays(b);
}

}  // namespace

std::vector<LightFieldGrid> coded_parts(const StreamInfo& info) {
    if (info.layout == StreamLayout::unfolded) return {Unfolding(info.faces()).grid()};
    return info.faces();
}

DirectionCross counted(const StreamInfo& info) {
    return info.layout == StreamLayout::unfolded ? Unfolding(info.faces()).cross() : DirectionCross{};
}

std::unique_ptr<TileCoder> coder_of_part(const StreamInfo& info, const LightFieldGrid& part) {
    return coder_in_layout(info.layout, part, [method = info.method, counted = counted(info)](const auto& grid) {
        return make_tile_coder(method, grid, counted);
    });
}

Tiling::Tiling(const LightFieldGrid& grid, const HogelRange& size)
    : hogels_s_(grid.hogels_s),
      hogels_t_(grid.hogels_t),
      across_((grid.hogels_s - 1) / size.ns + 1),
      down_((grid.hogels_t - 1) / size.nt + 1),
      size_(size) {}

HogelRange Tiling::operator[](std::size_t tile) const {
    const std::size_t s0 = tile % across_ * size_.ns, t0 = tile / across_ * size_.nt;
    return {s0, t0, std::min(size_.ns, hogels_s_ - s0), std::min(size_.nt, hogels_t_ - t0)};
}

StreamWriter::StreamWriter(const std::filesystem::path& path, const StreamHeader& info, core::RawFile* into,
                           const core::RawFile* depth)
    : info_(info),
      header_bytes_(header_bytes(info).size()),
      layers_(info.layer_ends.size()),
      into_(into),
      depth_(depth) {
    for (const LightFieldGrid& part : coded_parts(info))
        if (!tile_fits(part, info.tile))
            throw Error(ErrorCode::usage, "tile",
                        fmt::format("{}: tiles of {}x{} hogels; expected at least 1x1, no more than the light field "
                                    "has, and at most {} samples in each",
                                    path.string(), info.tile.ns, info.tile.nt, max_tile_samples));
    if (is_root_rank()) files_.emplace(path, into == nullptr);
}

void StreamWriter::restart() {
    next_ = 0;
    entries_.clear();
}

void StreamWriter::append(std::span<const std::uint8_t> tile, std::span<const std::size_t> layers) {
    files_->spooled.write(next_, tile.data(), tile.size());
    std::size_t begin = 0;
    for (std::size_t layer = 0; layer < layers_; ++layer) {
        const std::size_t end = layer < layers.size() ? layers[layer] : tile.size();
        entries_.push_back({next_ + begin, end - begin, core::checksum(tile.subspan(begin, end - begin))});
        begin = end;
    }
    next_ += tile.size();
}

void StreamWriter::share_entries() {
    work::broadcast_result(entries_, work::sent_vector<StreamEntry>());
    next_ = entries_.empty() ? 0 : entries_.back().offset + entries_.back().bytes;
}

std::uint64_t StreamWriter::overhead(std::size_t tiles) const {
    return header_bytes_ + tiles * layers_ * entry_bytes + checksum_bytes + info_.depth.bytes;
}

void StreamWriter::finish(std::uint64_t filler) {
    if (files_ && into_ != nullptr) write(*into_, filler);
    if (files_ && into_ == nullptr) {
        core::OutputFile& output = *files_->output;
        core::RawFile file(output.temporary(), core::RawFile::Mode::create, output.target());
        write(file, filler);
        file.close();
        output.commit();
    }
    if (Communicator* const ranks = communicator()) ranks->barrier();  // waits until the file has its name
}

void StreamWriter::write(core::RawFile& file, std::uint64_t filler) {
    info_.filler = filler;
    const Bytes header = header_bytes(info_);
    std::vector<StreamEntry> entries;  // layer by layer
    for (std::size_t layer = 0; layer < layers_; ++layer)
        for (std::size_t k = layer; k < entries_.size(); k += layers_) entries.push_back(entries_[k]);
    ByteWriter index;
    for (const StreamEntry& entry : entries) {
        index.put(static_cast<std::uint32_t>(entry.bytes));
        index.put(entry.checksum);
    }
    index.put(core::checksum(index.bytes));
    file.write(0, header.data(), header.size());
    file.write(header.size(), index.bytes.data(), index.bytes.size());
    std::uint64_t offset_in_file = header.size() + index.bytes.size();
    Bytes bytes;
    const auto copy = [&](const core::RawFile& from, std::uint64_t offset, std::uint64_t count) {
        bytes.resize(count);
        from.read(offset, bytes.data(), bytes.size());
        file.write(offset_in_file, bytes.data(), bytes.size());
        offset_in_file += bytes.size();
    };
    for (const StreamEntry& entry : entries) copy(files_->spooled, entry.offset, entry.bytes);
    if (info_.depth.bytes > 0) {
        constexpr std::uint64_t max_chunk = std::uint64_t{1} << 24;
        for (std::uint64_t done = 0; done < info_.depth.bytes; done += max_chunk)
            copy(*depth_, done, std::min(max_chunk, info_.depth.bytes - done));
    }
}

StreamReader::StreamReader(const std::filesystem::path& path, Content content)
    : file_(path, core::RawFile::Mode::read, path),
      what_(fmt::format("cannot read '{}'", path.string())),
      end_(file_.size()) {
    const std::uint64_t file_end = end_;
    read_index(read_header(0));
    if (content == Content::light_field) return;
    if (!info_.depth_there)
        damaged(info_.depth.bytes > 0 ? "it is truncated: its depth is missing" : "it has no depth");
    const StreamHeader outer = std::move(info_);
    end_ = file_end;
    index_.clear();
    read_index(read_header(file_end - outer.depth.bytes));
    if (info_.grid.channels != 1 || !same_faces(info_, outer) || info_.depth.bytes > 0)
        damaged("the stream behind it is not its depth");
}

// Reads the header and returns the offset of its end.
std::uint64_t StreamReader::read_header(std::uint64_t offset_in_file) {
    const std::uint64_t size = end_ - offset_in_file;
    if (size < prefix + 4) damaged("it is too short for a compressed light field");
    Bytes header(prefix);
    file_.read(offset_in_file, header.data(), prefix);
    if (!std::equal(stream_magic.begin(), stream_magic.end(), header.begin()))
        damaged("it is not a compressed light field");
    ByteReader begin(std::span<const std::uint8_t>(header).subspan(stream_magic.size()), what_);
    const auto version = begin.take<std::uint32_t>();
    if (version != stream_version)
        damaged(fmt::format("it has version {} of the format, expected version {}", version, stream_version));
    const auto length = begin.take<std::uint32_t>();
    if (length > max_header || length + prefix + 4 > size) damaged("its header is longer than the file");
    header.resize(prefix + length + 4);
    file_.read(offset_in_file + prefix, header.data() + prefix, length + 4);
    ByteReader end(std::span<const std::uint8_t>(header).last(4), what_);
    if (end.take<std::uint32_t>() != core::checksum(std::span(header).first(prefix + length)))
        damaged("its header is damaged");
    ByteReader fields(std::span<const std::uint8_t>(header).subspan(prefix, length), what_);
    info_ = read_header_fields(fields);
    if (fields.left() > 0) damaged("its header has bytes left over");
    for (const LightFieldGrid& face : info_.faces()) validate(face, ErrorCode::bad_input, what_);
    if (info_.layout == StreamLayout::stacked && !can_stack(info_.faces()))
        damaged("its header has the layout stacked, but several rows of directions");
    try {
        parts_ = coded_parts(info_);
    } catch (const Error& error) {
        damaged(error.what());
    }
    for (const LightFieldGrid& part : parts_)
        if (!tile_fits(part, info_.tile)) damaged("its header has impossible tiles");
    tiling_.emplace(info_.grid, info_.tile);
    return offset_in_file + header.size();
}

void StreamReader::read_index(std::uint64_t header) {
    const std::uint64_t max_bytes = end_ - header, layers = info_.layer_ends.size();
    if (max_bytes < checksum_bytes ||
        tiling_->count() > (max_bytes - checksum_bytes) / entry_bytes / parts_.size() / layers)
        damaged("it is truncated");
    Bytes index(tiles() * layers * entry_bytes + checksum_bytes);
    file_.read(header, index.data(), index.size());
    ByteReader entries(index, what_);
    std::uint64_t offset = header + index.size();
    for (std::uint64_t& layer_end : info_.layer_ends) {
        for (std::uint64_t tile = 0; tile < tiles(); ++tile) {
            const auto bytes = entries.take<std::uint32_t>();
            index_.push_back({offset, bytes, entries.take<std::uint32_t>()});
            offset += bytes;
        }
        layer_end = offset;
        if (offset <= end_) ++info_.layers_there;
    }
    if (entries.take<std::uint32_t>() != core::checksum(std::span(index).first(index.size() - checksum_bytes)))
        damaged("its index is damaged");
    if (info_.layers_there == 0) damaged("it is truncated");
    // The last layer is followed by the depth stream, if there is one.
    info_.depth_there = info_.depth.bytes > 0 && offset <= end_ && end_ - offset >= info_.depth.bytes;
    if (offset < end_ && end_ - offset > info_.depth.bytes) damaged("it has bytes left over");
}

Bytes StreamReader::read(std::size_t tile, std::size_t layers) const {
    Bytes bytes;
    for (std::size_t layer = 0; layer < layers; ++layer) {
        const StreamEntry& entry = index_[layer * tiles() + tile];
        const std::size_t begin = bytes.size();
        bytes.resize(begin + entry.bytes);
        file_.read(entry.offset, bytes.data() + begin, entry.bytes);
        if (core::checksum(std::span(std::as_const(bytes)).subspan(begin)) != entry.checksum)
            damaged(fmt::format("tile {} is damaged", tile));
    }
    return bytes;
}

void StreamReader::damaged(const std::string& why) const {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': {}", file_.name().string(), why));
}

}  // namespace hogel::codec::format

namespace hogel {

using namespace codec::format;

std::vector<LightFieldGrid> StreamInfo::faces() const {
    std::vector<LightFieldGrid> grids{grid};
    grids.insert(grids.end(), sides.begin(), sides.end());
    return grids;
}

bool is_stream(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    std::array<std::uint8_t, stream_magic.size()> begin{};
    if (file.size() < begin.size()) return false;
    file.read(0, begin.data(), begin.size());
    return begin == stream_magic;
}

StreamInfo read_stream_info(const std::filesystem::path& path) { return StreamReader(path).info(); }

}  // namespace hogel
