// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/stream_header.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hogel::codec::format {
namespace {

constexpr std::uint32_t max_layers = 64;
constexpr std::string_view filler_name = "filler";
static_assert(min_filler == 2 * sizeof(std::uint32_t) + filler_name.size());

constexpr std::array<std::pair<StreamLayout, std::string_view>, 3> layout_names{
    {{StreamLayout::faces, "faces"}, {StreamLayout::unfolded, "unfolded"}, {StreamLayout::stacked, "stacked"}}};

Face take_face(ByteReader& reader) {
    const std::string face = reader.take_text();
    const auto* const found = std::ranges::find(all_faces, face, [](Face known) { return face_name(known); });
    if (found == all_faces.end()) reader.damaged("its header names an unknown face");
    return *found;
}

void put_sides(ByteWriter& fields, const StreamInfo& info) {
    fields.put(std::ranges::find(layout_names, info.layout, &std::pair<StreamLayout, std::string_view>::first)->second);
    fields.put(static_cast<std::uint32_t>(info.sides.size()));
    for (const LightFieldGrid& side : info.sides) {
        fields.put(face_name(side.face()));
        for (const std::size_t count : {side.directions_u, side.directions_v}) fields.put(std::uint64_t{count});
        for (const double number : {side.half_u(), side.half_v(), side.center_u(), side.center_v()}) fields.put(number);
    }
}

void take_sides(ByteReader& reader, StreamInfo& info) {
    const std::string layout = reader.take_text();
    const auto* const known =
        std::ranges::find(layout_names, layout, &std::pair<StreamLayout, std::string_view>::second);
    if (known == layout_names.end()) reader.damaged("its header names an unknown layout");
    info.layout = known->first;
    const auto count = reader.take<std::uint32_t>();
    if (count >= all_faces.size()) reader.damaged("its header has an impossible number of faces");
    std::vector<Face> known_faces{info.grid.face()};
    for (std::uint32_t i = 0; i < count; ++i) {
        LightFieldGrid& side = info.sides.emplace_back(info.grid);
        std::get<Perspective>(side.view).face = take_face(reader);
        if (std::ranges::count(known_faces, side.face()) > 0) reader.damaged("its header names a face twice");
        known_faces.push_back(side.face());
        for (std::size_t* number : {&side.directions_u, &side.directions_v}) *number = reader.take<std::uint64_t>();
        for (double* number :
             {&side.range().half_u, &side.range().half_v, &side.range().center_u, &side.range().center_v})
            *number = reader.take_double();
    }
}

// Optional fields at the end of a header. Each has a name and a length, so that a reader can refuse unknown ones.
constexpr std::string_view tone_name = "tone", chrominance_name = "chrominance", depth_name = "depth",
                           focal_plane_name = "focal_plane", frequencies_name = "frequencies";

void put_optional_fields(ByteWriter& fields, const StreamHeader& info) {
    const auto put_field = [&](std::string_view name, const std::vector<std::uint8_t>& bytes) {
        fields.put(name);
        fields.put(static_cast<std::uint32_t>(bytes.size()));
        fields.put(std::span(bytes));
    };
    if (const auto& tone = info.companding.tone) {
        ByteWriter field;
        field.put(tone->first());
        for (const float value : tone->values()) field.put(value);
        put_field(tone_name, field.bytes);
    }
    if (info.companding.chrominance != 1) {
        ByteWriter field;
        field.put(info.companding.chrominance);
        put_field(chrominance_name, field.bytes);
    }
    if (info.depth.bytes > 0) {
        ByteWriter field;
        field.put(info.depth.bytes);
        for (const double number : {info.depth.error, info.depth.beyond}) field.put(number);
        put_field(depth_name, field.bytes);
    }
    if (const FocalPlane* plane = info.grid.focal_plane()) {
        ByteWriter field;
        field.put(plane->depth);
        put_field(focal_plane_name, field.bytes);
    }
    if (info.grid.has_frequencies()) put_field(frequencies_name, {});
}

ToneCurve take_tone(ByteReader& field) {
    const auto first = field.take<std::uint32_t>();
    std::vector<float> values;
    while (field.left() > 0) values.push_back(field.take_float());
    try {
        return {first, std::move(values)};
    } catch (const Error& error) {
        field.damaged(std::string("its header has ") + error.what());
    }
}

float take_chrominance(ByteReader& field) {
    const float chrominance = field.take_float();
    if (!(chrominance > 1 && chrominance <= Companding::max_chrominance) || field.left() > 0)
        field.damaged("its header has an impossible factor of chrominance");
    return chrominance;
}

StreamInfo::Depth take_depth(ByteReader& field) {
    StreamInfo::Depth depth;
    depth.bytes = field.take<std::uint64_t>();
    for (double* number : {&depth.error, &depth.beyond}) *number = field.take_double();
    if (depth.bytes == 0 || !std::isfinite(depth.error) || !std::isfinite(depth.beyond) || field.left() > 0)
        field.damaged("its header has impossible depths");
    return depth;
}

FocalPlane take_focal_plane(ByteReader& field, const StreamHeader& info) {
    const FocalPlane plane{info.grid.range(), field.take_double()};
    if (!std::isfinite(plane.depth) || plane.depth == 0 || field.left() > 0 || !info.sides.empty())
        field.damaged("its header has an impossible focal plane");
    return plane;
}

Frequencies take_frequencies(ByteReader& field, const StreamHeader& info) {
    if (field.left() > 0 || !info.sides.empty()) field.damaged("its header has impossible frequencies");
    return {info.grid.range()};
}

void take_optional_fields(ByteReader& reader, StreamHeader& info) {
    Companding& companding = info.companding;
    while (reader.left() > 0) {
        const std::string name = reader.take_text();
        ByteReader field = reader.take_part(reader.take<std::uint32_t>());
        if (name == tone_name && !companding.changes())
            companding.tone = take_tone(field);
        else if (name == chrominance_name && companding.chrominance == 1)
            companding.chrominance = take_chrominance(field);
        else if (name == depth_name && info.depth.bytes == 0)
            info.depth = take_depth(field);
        else if (name == focal_plane_name && info.grid.is_perspective())
            info.grid.view = take_focal_plane(field, info);
        else if (name == frequencies_name && info.grid.is_perspective())
            info.grid.view = take_frequencies(field, info);
        else
            reader.damaged("its header has an unknown field, or one twice");
    }
    if (companding.tone)
        info.tone = StreamInfo::ToneMapping{companding.tone->decades(), companding.tone->mapped_decades()};
    info.chrominance = companding.chrominance;
}

}  // namespace

std::vector<std::uint8_t> header_bytes(const StreamHeader& info) {
    ByteWriter fields;
    const LightFieldGrid& grid = info.grid;
    for (const std::size_t count : {grid.channels, grid.hogels_s, grid.hogels_t, grid.directions_u, grid.directions_v})
        fields.put(std::uint64_t{count});
    for (const double number : {grid.pitch, grid.half_u(), grid.half_v(), grid.center_u(), grid.center_v()})
        fields.put(number);
    fields.put(face_name(grid.face()));
    fields.put(std::uint64_t{info.tile.ns});
    fields.put(std::uint64_t{info.tile.nt});
    fields.put(std::string_view(info.method.coder));
    fields.put(std::string_view(info.method.transform));
    Metadata entries = info.metadata;
    if (info.filler > 0) entries.emplace_back(filler_name, std::string(info.filler - min_filler, ' '));
    fields.put(static_cast<std::uint32_t>(entries.size()));
    for (const auto& [name, value] : entries) {
        fields.put(std::string_view(name));
        fields.put(std::string_view(value));
    }
    put_sides(fields, info);
    fields.put(static_cast<std::uint32_t>(info.layer_ends.size()));
    put_optional_fields(fields, info);
    ByteWriter header;
    header.put(std::span(stream_magic));
    header.put(stream_version);
    header.put(static_cast<std::uint32_t>(fields.bytes.size()));
    header.put(std::span(fields.bytes));
    header.put(core::checksum(header.bytes));
    return std::move(header.bytes);
}

StreamHeader read_header_fields(ByteReader& reader) {
    StreamHeader info;
    LightFieldGrid& grid = info.grid;
    for (std::size_t* count : {&grid.channels, &grid.hogels_s, &grid.hogels_t, &grid.directions_u, &grid.directions_v})
        *count = reader.take<std::uint64_t>();
    for (double* number :
         {&grid.pitch, &grid.range().half_u, &grid.range().half_v, &grid.range().center_u, &grid.range().center_v})
        *number = reader.take_double();
    if (take_face(reader) != Face::front) reader.damaged("its first face is not the front");
    info.tile.ns = reader.take<std::uint64_t>();
    info.tile.nt = reader.take<std::uint64_t>();
    info.method.coder = reader.take_text();
    info.method.transform = reader.take_text();
    const auto entries = reader.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < entries; ++i) {
        std::string name = reader.take_text();
        std::string value = reader.take_text();
        if (name == filler_name)
            info.filler += min_filler + value.size();
        else
            info.metadata.emplace_back(std::move(name), std::move(value));
    }
    take_sides(reader, info);
    const auto layers = reader.take<std::uint32_t>();
    if (layers == 0 || layers > max_layers) reader.damaged("its header has an impossible number of layers");
    info.layer_ends.resize(layers);
    take_optional_fields(reader, info);
    return info;
}

}  // namespace hogel::codec::format
