// SPDX-License-Identifier: Apache-2.0
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <tuple>

#include "hogel/core/lower_case.h"
#include "hogel/image/formats/exr_memory.h"
#include "hogel/image/formats/formats.h"
#include "hogel/image/formats/row_blocks.h"
#include "hogel/image/picture_bytes.h"

namespace hogel::image {
namespace {

constexpr int threads = 0;  // number of threads that OpenEXR starts

// OpenEXR's names of texts and the names in other formats and programs.
struct AttributeName {
    std::string_view exr, common;
};
constexpr std::array attribute_names{AttributeName{"comments", "ImageDescription"}, AttributeName{"owner", "Copyright"},
                                     AttributeName{"capDate", "DateTime"}};

// Attributes with a meaning for OpenEXR, which are not texts.
constexpr std::array<std::string_view, 8> reserved{"type",    "name",       "view",  "version",
                                                   "preview", "chunkCount", "tiles", "maxSamplesPerPixel"};

Imf::Header first_header(const PictureBytes& file) {
    ExrSource source(file.bytes, file.name);
    std::array<char, 8> start;
    source.read(start.data(), static_cast<int>(start.size()));
    int version = 0;
    for (std::size_t i = 0; i < 4; ++i) version |= static_cast<unsigned char>(start[4 + i]) << (8 * i);
    Imf::Header header;
    header.readFrom(source, version);
    if ((version & 0x800) != 0 || (header.hasType() && Imf::isDeepData(header.type())))
        file.fail("a flat picture was expected, not deep samples");
    return header;
}

struct Size {
    std::size_t width, height;
};

Size checked_size(const Imf::Header& header, const PictureBytes& file) {
    const Imath::Box2i& window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    std::uint64_t channels = 0, largest = 1;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
        ++channels;
        largest = std::max<std::uint64_t>(largest, i.channel().type == Imf::HALF ? 2 : 4);
    }
    const auto positive = [](std::int64_t extent) {
        return static_cast<std::uint64_t>(std::max<std::int64_t>(extent, 0));
    };
    file.check_size(positive(width), positive(height), channels, largest);
    if (header.hasTileDescription()) {
        const Imf::TileDescription& tile = header.tileDescription();
        if (std::uint64_t{tile.xSize} * tile.ySize >
            std::max<std::uint64_t>(4 * positive(width) * positive(height), 1 << 20))
            file.fail(fmt::format("its tiles of {}x{} pixels do not suit {}x{} pixels", tile.xSize, tile.ySize, width,
                                  height));
    }
    return {positive(width), positive(height)};
}

struct Channel {
    std::string name, layer, suffix;
    bool is_integer;  // stored as 32-bit integers
};

// Returns the sort key of a channel in its layer: colours, vectors and others, then alpha and depth.
int rank(const std::string& suffix) {
    constexpr std::array<std::string_view, 6> first{"r", "red", "g", "green", "b", "blue"}, last{"a", "alpha"};
    if (const auto* colour = std::ranges::find(first, suffix); colour != first.end())
        return static_cast<int>(colour - first.begin());
    if (suffix.empty()) return 10;
    return std::ranges::count(last, suffix) > 0 ? 20 : 10;
}

// Returns the full-resolution channels by layer; the unnamed layer comes first.
std::vector<Channel> full_channels(const Imf::ChannelList& list) {
    std::vector<Channel> channels;
    for (auto i = list.begin(); i != list.end(); ++i) {
        if (i.channel().xSampling != 1 || i.channel().ySampling != 1) continue;
        const std::string name = i.name();
        const std::size_t dot = name.rfind('.');
        const bool plain = dot == std::string::npos;
        channels.push_back({name, plain ? "" : name.substr(0, dot),
                            core::lower_case(plain ? name : name.substr(dot + 1)), i.channel().type == Imf::UINT});
    }
    std::ranges::sort(channels, {}, [](const Channel& c) { return std::tuple(c.layer, rank(c.suffix), c.name); });
    return channels;
}

// Returns the three colours of the first layer with colours; else the luminance of the first layer with luminance; else
// the first three channels, or the first channel if there are fewer.
std::vector<Channel> chosen_channels(const Imf::ChannelList& list) {
    const std::vector<Channel> candidates = full_channels(list);
    const auto in_layer = [&](const std::string& layer, std::string_view suffix, std::string_view other) {
        return std::ranges::find_if(candidates, [&](const Channel& c) {
            return c.layer == layer && (c.suffix == suffix || c.suffix == other);
        });
    };
    for (const Channel& channel : candidates) {
        const auto r = in_layer(channel.layer, "r", "red"), g = in_layer(channel.layer, "g", "green"),
                   b = in_layer(channel.layer, "b", "blue");
        if (r != candidates.end() && g != candidates.end() && b != candidates.end()) return {*r, *g, *b};
    }
    for (const Channel& channel : candidates)
        if (channel.suffix == "y" && in_layer(channel.layer, "x", "x") == candidates.end()) return {channel};
    return {candidates.begin(), candidates.begin() + (candidates.size() >= 3 ? 3 : candidates.empty() ? 0 : 1)};
}

Array<float, 3> read_channels(Imf::InputFile& in, const std::vector<Channel>& channels, const Size& size) {
    const Imath::Box2i& window = in.header().dataWindow();
    const std::size_t count = channels.size();
    Array<float, 3> samples({size.height, size.width, count});
    std::vector<std::vector<std::uint32_t>> integers(count);
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < count; ++c) {
        const auto slice = [&](Imf::PixelType type, void* first, std::size_t step) {
            const std::size_t bytes = step * sizeof(float);
            return Imf::Slice::Make(type, first, window, bytes, bytes * size.width);
        };
        if (channels[c].is_integer) integers[c].resize(size.width * size.height);
        buffer.insert(channels[c].name, channels[c].is_integer ? slice(Imf::UINT, integers[c].data(), 1)
                                                               : slice(Imf::FLOAT, samples.data() + c, count));
    }
    in.setFrameBuffer(buffer);
    for_row_blocks(size.height, size.width * count, [&](std::size_t first, std::size_t last) {
        in.readPixels(window.min.y + static_cast<int>(first), window.min.y + static_cast<int>(last) - 1);
        // Integers become fractions of the largest integer.
        for (std::size_t c = 0; c < count; ++c)
            for (std::size_t i = first * size.width; channels[c].is_integer && i < last * size.width; ++i)
                samples.data()[i * count + c] = static_cast<float>(integers[c][i] / 4294967295.0);
    });
    return samples;
}

Metadata texts_of(const Imf::Header& header) {
    Metadata texts;
    for (auto i = header.begin(); i != header.end(); ++i) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
        std::string name = i.name();
        if (text == nullptr || std::ranges::count(reserved, name) > 0) continue;
        for (const AttributeName& known : attribute_names)
            if (name == known.exr) name = known.common;
        texts.emplace_back(name, text->value());
    }
    return texts;
}

void add_texts(Imf::Header& header, const Metadata& texts) {
    for (const auto& [key, text] : texts) {
        std::string name = key;
        for (const AttributeName& known : attribute_names)
            if (name == known.common) name = known.exr;
        // Skips attributes that OpenEXR sets itself, such as "compression": they describe the new file.
        if (name.empty() || std::ranges::count(reserved, name) > 0 || header.find(name) != header.end()) continue;
        header.insert(name, Imf::StringAttribute(text));
    }
}

}  // namespace

Picture read_exr(const PictureBytes& file) {
    const std::string damage = exr_structure_error(file.bytes);
    if (!damage.empty()) file.fail(damage);
    const Imf::Header header = first_header(file);
    Picture picture{{}, texts_of(header)};
    if (file.only_texts) return picture;
    const Size size = checked_size(header, file);
    const std::vector<Channel> channels = chosen_channels(header.channels());
    if (channels.empty()) file.fail("it has no channel with a sample for each pixel");
    ExrSource source(file.bytes, file.name);
    Imf::InputFile in(source, threads);
    picture.samples = read_channels(in, channels, size);
    return picture;
}

ExrChannels read_exr_channels(const PictureBytes& file) {
    const std::string damage = exr_structure_error(file.bytes);
    if (!damage.empty()) file.fail(damage);
    const Imf::Header header = first_header(file);
    ExrChannels picture{{}, texts_of(header)};
    std::vector<Channel> channels;
    for (const Channel& channel : full_channels(header.channels()))
        if (!channel.is_integer) channels.push_back(channel);
    for (const Channel& channel : channels) picture.channels.emplace_back(channel.name, Array<float, 2>());
    if (file.only_texts || channels.empty()) return picture;
    const Size size = checked_size(header, file);
    ExrSource source(file.bytes, file.name);
    Imf::InputFile in(source, threads);
    const Array<float, 3> samples = read_channels(in, channels, size);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        Array<float, 2>& plane = picture.channels[c].second = Array<float, 2>({size.height, size.width});
        for_row_blocks(size.height, size.width, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first * size.width; i < last * size.width; ++i)
                plane.data()[i] = samples.data()[i * channels.size() + c];
        });
    }
    return picture;
}

std::vector<unsigned char> exr_channels_file(const ExrChannels& picture) {
    const std::size_t height = picture.channels.at(0).second.extent(0), width = picture.channels[0].second.extent(1);
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    for (const auto& [name, plane] : picture.channels) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        auto* samples = reinterpret_cast<char*>(const_cast<float*>(plane.data()));  // not modified
        buffer.insert(name, Imf::Slice(Imf::FLOAT, samples, sizeof(float), width * sizeof(float)));
    }
    add_texts(header, picture.texts);
    ExrSink sink;
    {
        Imf::OutputFile out(sink, header, threads);
        out.setFrameBuffer(buffer);
        for_row_blocks(height, width * picture.channels.size(),
                       [&](std::size_t first, std::size_t last) { out.writePixels(static_cast<int>(last - first)); });
    }
    return std::move(sink.bytes);
}

// Returns whether half floats suffice: no finite value exceeds their range, and the largest value has full precision.
bool halves_hold(View<const float, 3> pixels) {
    float largest = 0;
    const std::size_t row = pixels.extent(1) * pixels.extent(2);
    for_row_blocks(pixels.extent(0), row, [&](std::size_t first, std::size_t last) {
        for (const float value : pixels.elements().subspan(first * row, (last - first) * row))
            if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    });
    return largest == 0 || (largest <= HALF_MAX && largest >= HALF_NRM_MIN);
}

std::vector<unsigned char> exr_file(View<const float, 3> pixels, const Metadata& texts) {
    const std::size_t height = pixels.extent(0), width = pixels.extent(1), channels = pixels.extent(2);
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    const auto insert = [&](Imf::PixelType type, const void* first, std::size_t bytes) {
        for (std::size_t c = 0; c < channels; ++c) {
            const std::string name = channels == 1 ? "Y" : std::string(1, "RGB"[c]);
            header.channels().insert(name, Imf::Channel(type));
            auto* samples = const_cast<char*>(static_cast<const char*>(first)) + c * bytes;  // not modified
            buffer.insert(name, Imf::Slice(type, samples, channels * bytes, channels * width * bytes));
        }
    };
    std::vector<half> halves;
    if (halves_hold(pixels)) {
        halves.resize(pixels.size());
        insert(Imf::HALF, halves.data(), sizeof(half));
    } else {
        insert(Imf::FLOAT, pixels.data(), sizeof(float));
    }
    add_texts(header, texts);
    ExrSink sink;
    {
        Imf::OutputFile out(sink, header, threads);
        out.setFrameBuffer(buffer);
        const std::size_t row = width * channels;
        for_row_blocks(height, row, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first * row; !halves.empty() && i < last * row; ++i)
                halves[i] = half(pixels.data()[i]);
            out.writePixels(static_cast<int>(last - first));
        });
    }  // the destructor writes the table of rows
    return std::move(sink.bytes);
}

}  // namespace hogel::image
