#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hogel/codec/bytes_internal.h"
#include "hogel/codec/stream_internal.h"

namespace hogel {
namespace {

using Bytes = std::vector<std::uint8_t>;

// As in PNG: not text, and damaged by what damages line ends.
constexpr std::array<std::uint8_t, 8> magic{0x89, 'H', 'G', 'L', '\r', '\n', 0x1A, '\n'};
constexpr std::size_t prefix = magic.size() + 8;  // then version and length of the header
constexpr std::size_t entry_bytes = 12, footer_bytes = 12;
constexpr std::uint32_t most_header = 1 << 24, latest_version = 2;

constexpr std::string_view layout_name(HemicubeLayout layout) {
    return layout == HemicubeLayout::faces ? "faces" : "unfolded";
}

Face take_face(ByteReader& reader) {
    const std::string face = reader.take_text();
    const auto* const found = std::ranges::find(all_faces, face, [](Face known) { return name(known); });
    if (found == all_faces.end()) reader.damaged("its header names an unknown face of a hemicube");
    return *found;
}

// What version 2 has behind the rest.
void put_sides(ByteWriter& fields, const StreamInfo& info) {
    fields.put(layout_name(info.layout));
    fields.put(static_cast<std::uint32_t>(info.sides.size()));
    for (const LightFieldGrid& side : info.sides) {
        fields.put(name(side.face));
        for (const std::size_t count : {side.directions_u, side.directions_v}) fields.put(std::uint64_t{count});
        for (const double number : {side.tan_half_u, side.tan_half_v, side.center_u, side.center_v}) fields.put(number);
    }
}

void take_sides(ByteReader& reader, StreamInfo& info) {
    const std::string layout = reader.take_text();
    for (const HemicubeLayout known : {HemicubeLayout::faces, HemicubeLayout::unfolded})
        if (layout == layout_name(known)) info.layout = known;
    if (layout != layout_name(info.layout)) reader.damaged("its header names an unknown layout of a hemicube");
    const auto count = reader.take<std::uint32_t>();
    if (count == 0 || count >= all_faces.size()) reader.damaged("its header has an impossible number of faces");
    std::vector<Face> seen{info.grid.face};
    for (std::uint32_t i = 0; i < count; ++i) {
        LightFieldGrid& side = info.sides.emplace_back(info.grid);
        side.face = take_face(reader);
        if (std::ranges::count(seen, side.face) > 0 || seen.front() != Face::front)
            reader.damaged("its header names faces that make no hemicube");
        seen.push_back(side.face);
        for (std::size_t* number : {&side.directions_u, &side.directions_v}) *number = reader.take<std::uint64_t>();
        for (double* number : {&side.tan_half_u, &side.tan_half_v, &side.center_u, &side.center_v})
            *number = reader.take_double();
    }
}

Bytes header_of(const StreamInfo& info) {
    ByteWriter fields;
    const LightFieldGrid& grid = info.grid;
    for (const std::size_t count : {grid.channels, grid.hogels_s, grid.hogels_t, grid.directions_u, grid.directions_v})
        fields.put(std::uint64_t{count});
    for (const double number : {grid.pitch, grid.tan_half_u, grid.tan_half_v, grid.center_u, grid.center_v})
        fields.put(number);
    fields.put(name(grid.face));
    fields.put(std::uint64_t{info.tile.ns});
    fields.put(std::uint64_t{info.tile.nt});
    fields.put(std::string_view(info.method.coder));
    fields.put(std::string_view(info.method.transform));
    fields.put(static_cast<std::uint32_t>(info.metadata.size()));
    for (const auto& [name, value] : info.metadata) {
        fields.put(std::string_view(name));
        fields.put(std::string_view(value));
    }
    if (info.version() > 1) put_sides(fields, info);
    ByteWriter header;
    header.put(std::span(magic));
    header.put(info.version());
    header.put(static_cast<std::uint32_t>(fields.bytes.size()));
    header.put(std::span(fields.bytes));
    header.put(checksum(header.bytes));
    return std::move(header.bytes);
}

StreamInfo read_fields(ByteReader& reader, std::uint32_t version) {
    StreamInfo info;
    LightFieldGrid& grid = info.grid;
    for (std::size_t* count : {&grid.channels, &grid.hogels_s, &grid.hogels_t, &grid.directions_u, &grid.directions_v})
        *count = reader.take<std::uint64_t>();
    for (double* number : {&grid.pitch, &grid.tan_half_u, &grid.tan_half_v, &grid.center_u, &grid.center_v})
        *number = reader.take_double();
    grid.face = take_face(reader);
    info.tile.ns = reader.take<std::uint64_t>();
    info.tile.nt = reader.take<std::uint64_t>();
    info.method.coder = reader.take_text();
    info.method.transform = reader.take_text();
    const auto words = reader.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < words; ++i) {
        std::string name = reader.take_text();
        info.metadata.emplace_back(std::move(name), reader.take_text());
    }
    if (version > 1) take_sides(reader, info);
    return info;
}

bool tile_fits(const LightFieldGrid& grid, const HogelRange& tile) {
    if (tile.ns == 0 || tile.nt == 0 || tile.ns > grid.hogels_s || tile.nt > grid.hogels_t) return false;
    std::size_t room = most_tile_samples;
    for (const std::size_t extent : {grid.channels, tile.ns, tile.nt, grid.directions_u, grid.directions_v})
        room /= extent;
    return room > 0;
}

}  // namespace

std::vector<LightFieldGrid> StreamInfo::faces() const {
    std::vector<LightFieldGrid> all{grid};
    all.insert(all.end(), sides.begin(), sides.end());
    return all;
}

std::vector<LightFieldGrid> coded_parts(const StreamInfo& info) {
    if (info.layout == HemicubeLayout::unfolded) return {Unfolding(info.faces()).grid()};
    return info.faces();
}

DirectionCross counted(const StreamInfo& info) {
    return info.layout == HemicubeLayout::unfolded ? Unfolding(info.faces()).cross() : DirectionCross{};
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

StreamWriter::StreamWriter(const std::filesystem::path& path, const StreamInfo& info)
    : output_(path), file_(output_.temporary(), RawFile::Mode::create, path) {
    for (const LightFieldGrid& part : coded_parts(info))
        if (!tile_fits(part, info.tile))
            throw Error(ErrorCode::usage,
                        fmt::format("{}: tiles of {}x{} hogels; expected at least 1x1, no more than the light field "
                                    "has, and at most {} samples in each",
                                    path.string(), info.tile.ns, info.tile.nt, most_tile_samples));
    const Bytes header = header_of(info);
    file_.write(0, header.data(), header.size());
    first_ = next_ = header.size();
}

void StreamWriter::restart() {
    next_ = first_;
    index_.clear();
}

void StreamWriter::append(std::span<const std::uint8_t> tile) {
    file_.write(next_, tile.data(), tile.size());
    next_ += tile.size();
    index_.push_back({tile.size(), checksum(tile)});
}

std::uint64_t StreamWriter::overhead(std::size_t tiles) const { return first_ + tiles * entry_bytes + footer_bytes; }

void StreamWriter::finish() {
    ByteWriter index;
    for (const Entry& entry : index_) {
        index.put(entry.bytes);
        index.put(entry.checksum);
    }
    index.put(next_);
    index.put(checksum(index.bytes));
    file_.write(next_, index.bytes.data(), index.bytes.size());
    file_.resize(next_ + index.bytes.size());
    file_.close();
    output_.commit();
}

StreamReader::StreamReader(const std::filesystem::path& path) : file_(path, RawFile::Mode::read, path) {
    const std::uint64_t size = file_.size();
    if (size < prefix + 4) damaged("it is too short for a compressed light field");
    Bytes header(prefix);
    file_.read(0, header.data(), prefix);
    if (!std::equal(magic.begin(), magic.end(), header.begin())) damaged("it is not a compressed light field");
    const std::string what = fmt::format("cannot read '{}'", path.string());
    ByteReader begin(std::span<const std::uint8_t>(header).subspan(magic.size()), what);
    const auto version = begin.take<std::uint32_t>();
    if (version == 0 || version > latest_version)
        damaged(fmt::format("it has version {} of the format, expected 1 to {}", version, latest_version));
    const auto length = begin.take<std::uint32_t>();
    if (length > most_header || length + prefix + 4 > size) damaged("its header is longer than the file");
    header.resize(prefix + length + 4);
    file_.read(prefix, header.data() + prefix, length + 4);
    ByteReader end(std::span<const std::uint8_t>(header).last(4), what);
    if (end.take<std::uint32_t>() != checksum(std::span(header).first(prefix + length)))
        damaged("its header is damaged");
    ByteReader fields(std::span<const std::uint8_t>(header).subspan(prefix, length), what);
    info_ = read_fields(fields, version);
    if (fields.left() > 0) damaged("its header has bytes left over");
    for (const LightFieldGrid& face : info_.faces()) validate(face, ErrorCode::bad_input, what);
    try {
        parts_ = coded_parts(info_);
    } catch (const Error& error) {
        damaged(error.what());
    }
    for (const LightFieldGrid& part : parts_)
        if (!tile_fits(part, info_.tile)) damaged("its header has impossible tiles");
    tiling_.emplace(info_.grid, info_.tile);

    const std::uint64_t of_part = tiling_->count(), most = size - header.size();
    if (most < footer_bytes || of_part > (most - footer_bytes) / entry_bytes / parts_.size())
        damaged("it is truncated");
    const std::uint64_t tiles = of_part * parts_.size();
    Bytes index(tiles * entry_bytes + footer_bytes);
    file_.read(size - index.size(), index.data(), index.size());
    ByteReader entries(index, what);
    std::uint64_t offset = header.size();
    for (std::uint64_t tile = 0; tile < tiles; ++tile) {
        const auto bytes = entries.take<std::uint64_t>();
        index_.push_back({offset, bytes, entries.take<std::uint32_t>()});
        if (bytes > size - offset) damaged("it is truncated, or its index is damaged");
        offset += bytes;
    }
    const bool in_place = entries.take<std::uint64_t>() == offset && offset + index.size() == size;
    if (!in_place || entries.take<std::uint32_t>() != checksum(std::span(index).first(index.size() - 4)))
        damaged("it is truncated, or its index is damaged");
}

Bytes StreamReader::read(std::size_t tile) const {
    Bytes bytes(index_[tile].bytes);
    file_.read(index_[tile].offset, bytes.data(), bytes.size());
    if (checksum(bytes) != index_[tile].checksum) damaged(fmt::format("tile {} is damaged", tile));
    return bytes;
}

void StreamReader::damaged(const std::string& why) const {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': {}", file_.name().string(), why));
}

bool is_stream(const std::filesystem::path& path) {
    const RawFile file(path, RawFile::Mode::read, path);
    std::array<std::uint8_t, magic.size()> begin{};
    if (file.size() < begin.size()) return false;
    file.read(0, begin.data(), begin.size());
    return begin == magic;
}

StreamInfo read_stream_info(const std::filesystem::path& path) { return StreamReader(path).info(); }

}  // namespace hogel
