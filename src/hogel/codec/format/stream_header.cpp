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
    if (found == all_faces.end()) reader.damaged("its header names an unknown face of a hemicube");
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
    std::vector<Face> seen{info.grid.face()};
    for (std::uint32_t i = 0; i < count; ++i) {
        LightFieldGrid& side = info.sides.emplace_back(info.grid);
        std::get<Perspective>(side.view).face = take_face(reader);
        if (std::ranges::count(seen, side.face()) > 0 || seen.front() != Face::front)
            reader.damaged("its header names faces that make no hemicube");
        seen.push_back(side.face());
        for (std::size_t* number : {&side.directions_u, &side.directions_v}) *number = reader.take<std::uint64_t>();
        for (double* number :
             {&side.range().half_u, &side.range().half_v, &side.range().center_u, &side.range().center_v})
            *number = reader.take_double();
    }
}

// What a header ends with, each part by its name and length, so that a reader refuses what it does not know.
constexpr std::string_view tone_name = "tone", chrominance_name = "chrominance", depth_name = "depth";

void put_parts(ByteWriter& fields, const StreamHeader& info) {
    const auto put_part = [&](std::string_view name, const std::vector<std::uint8_t>& bytes) {
        fields.put(name);
        fields.put(static_cast<std::uint32_t>(bytes.size()));
        fields.put(std::span(bytes));
    };
    if (const auto& tone = info.companding.tone) {
        ByteWriter part;
        part.put(tone->first());
        for (const float value : tone->values()) part.put(value);
        put_part(tone_name, part.bytes);
    }
    if (info.companding.chrominance != 1) {
        ByteWriter part;
        part.put(info.companding.chrominance);
        put_part(chrominance_name, part.bytes);
    }
    if (info.depth.bytes > 0) {
        ByteWriter part;
        part.put(info.depth.bytes);
        for (const double number : {info.depth.error, info.depth.beyond}) part.put(number);
        put_part(depth_name, part.bytes);
    }
}

ToneCurve take_tone(ByteReader& part) {
    const auto first = part.take<std::uint32_t>();
    std::vector<float> values;
    while (part.left() > 0) values.push_back(part.take_float());
    try {
        return {first, std::move(values)};
    } catch (const Error& error) {
        part.damaged(std::string("its header has ") + error.what());
    }
}

float take_chrominance(ByteReader& part) {
    const float chrominance = part.take_float();
    if (!(chrominance > 1 && chrominance <= Companding::max_chrominance) || part.left() > 0)
        part.damaged("its header has an impossible factor of chrominance");
    return chrominance;
}

StreamInfo::Depth take_depth(ByteReader& part) {
    StreamInfo::Depth depth;
    depth.bytes = part.take<std::uint64_t>();
    for (double* number : {&depth.error, &depth.beyond}) *number = part.take_double();
    if (depth.bytes == 0 || !std::isfinite(depth.error) || !std::isfinite(depth.beyond) || part.left() > 0)
        part.damaged("its header speaks of impossible depths");
    return depth;
}

void take_parts(ByteReader& reader, StreamHeader& info) {
    Companding& mapping = info.companding;
    while (reader.left() > 0) {
        const std::string name = reader.take_text();
        ByteReader part = reader.take_part(reader.take<std::uint32_t>());
        if (name == tone_name && !mapping.changes())
            mapping.tone = take_tone(part);
        else if (name == chrominance_name && mapping.chrominance == 1)
            mapping.chrominance = take_chrominance(part);
        else if (name == depth_name && info.depth.bytes == 0)
            info.depth = take_depth(part);
        else
            reader.damaged("its header has a part that is not known, or twice");
    }
    if (mapping.tone) info.tone = StreamInfo::ToneMapping{mapping.tone->decades(), mapping.tone->mapped_decades()};
    info.chrominance = mapping.chrominance;
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
    Metadata words = info.metadata;
    if (info.filler > 0) words.emplace_back(filler_name, std::string(info.filler - min_filler, ' '));
    fields.put(static_cast<std::uint32_t>(words.size()));
    for (const auto& [name, value] : words) {
        fields.put(std::string_view(name));
        fields.put(std::string_view(value));
    }
    put_sides(fields, info);
    fields.put(static_cast<std::uint32_t>(info.layer_ends.size()));
    put_parts(fields, info);
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
    std::get<Perspective>(grid.view).face = take_face(reader);
    info.tile.ns = reader.take<std::uint64_t>();
    info.tile.nt = reader.take<std::uint64_t>();
    info.method.coder = reader.take_text();
    info.method.transform = reader.take_text();
    const auto words = reader.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < words; ++i) {
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
    take_parts(reader, info);
    return info;
}

}  // namespace hogel::codec::format
