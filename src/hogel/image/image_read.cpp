// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <new>
#include <sstream>
#include <system_error>

#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/image/picture_bytes.h"

namespace hogel {

using namespace image;

namespace {

// The largest ratio of a picture's bytes to those of its file (deflate reaches 1032). Beyond it a file is refused as
// damaged, so that a few bytes cannot make the library allocate gigabytes. Pictures below the second limit are exempt.
constexpr std::uint64_t max_expansion = 4096;
constexpr std::uint64_t always_allowed = std::uint64_t{16} << 20;

[[noreturn]] void fail_read(const std::string& name, const std::string& why) {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read the picture '{}': {}", name, one_line(why)));
}

OIIO::ImageSpec reading_options() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // alpha is dropped, so colours must not be multiplied by it
    return config;
}

void check_size(const OIIO::ImageSpec& spec, const std::string& name, std::size_t max_pixels,
                std::uint64_t file_bytes) {
    const auto width = static_cast<std::uint64_t>(std::max(spec.width, 0));
    const auto height = static_cast<std::uint64_t>(std::max(spec.height, 0));
    if (width == 0 || height == 0 || spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > 64 || spec.deep)
        fail_read(name, fmt::format("a flat picture was expected, not {}x{}x{} pixels in {} {}channels", spec.width,
                                    spec.height, spec.depth, spec.nchannels, spec.deep ? "deep " : ""));
    if (width * height > max_pixels)  // both are below 2^31
        fail_read(name, fmt::format("{}x{} pixels are more than the {} that are accepted", width, height, max_pixels));
    if (spec.tile_width > 0 &&
        static_cast<std::uint64_t>(spec.tile_width) * static_cast<std::uint64_t>(spec.tile_height) >
            std::max<std::uint64_t>(4 * width * height, 1 << 20))
        fail_read(name, fmt::format("its tiles of {}x{} pixels do not suit {}x{} pixels", spec.tile_width,
                                    spec.tile_height, width, height));
    const std::uint64_t claimed = width * height * static_cast<std::uint64_t>(spec.nchannels) * spec.format.size();
    if (claimed > always_allowed && claimed / max_expansion > file_bytes)
        fail_read(name, fmt::format("{} bytes are too few for {}x{} pixels", file_bytes, width, height));
}

// Linear light of each 16-bit display value; 8-bit values are the multiples of 257 among them.
const std::vector<float>& linear_of_display() {
    static const std::vector<float> table = [] {
        std::vector<float> values(65536);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = srgb_decode(static_cast<float>(i) / 65535.0f);
        return values;
    }();
    return table;
}

Image read_pixels(OIIO::ImageInput& in, const std::string& name) {
    const OIIO::ImageSpec& spec = in.spec();
    const std::size_t channels = spec.nchannels >= 3 ? 3 : 1;
    Image image(static_cast<std::size_t>(spec.width), static_cast<std::size_t>(spec.height), channels);
    const auto read = [&](OIIO::TypeDesc type, void* pixels) {
        if (!in.read_image(0, 0, 0, static_cast<int>(channels), type, pixels)) fail_read(name, in.geterror());
    };
    const bool display = !spec.format.is_floating_point() && spec.format.size() <= 2;
    if (display) {
        std::vector<std::uint16_t> values(image.pixels.size());
        read(OIIO::TypeDesc::UINT16, values.data());
        const std::vector<float>& table = linear_of_display();
        std::ranges::transform(values, image.pixels.data(), [&](std::uint16_t value) { return table[value]; });
    } else {
        read(OIIO::TypeDesc::FLOAT, image.pixels.data());
    }
    return image;
}

// Turns exceptions into Error(bad_input). OpenImageIO reports errors by return values, but the libraries that it uses
// throw.
template <class F>
auto guarded(const std::string& name, const F& body) {
    try {
        return body();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        fail_read(name, "it needs more memory than there is");
    } catch (const std::exception& error) {
        fail_read(name, error.what());
    }
}

// A picture that is being read and the memory that it is read from.
struct OpenPicture {
    std::vector<unsigned char> bytes;
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
    std::unique_ptr<OIIO::ImageInput> in;  // last, so that it is closed before its memory is freed
};

OpenPicture open_bytes(std::span<const unsigned char> bytes, const std::string& format, const std::string& name) {
    const std::string damage = structure_error(format, bytes);
    if (!damage.empty()) fail_read(name, damage);
    OpenPicture picture;
    picture.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size());
    picture.in = OIIO::ImageInput::create(format);
    if (!picture.in) fail_read(name, OIIO::geterror());
    OIIO::ImageSpec spec;
    if (!picture.in->set_ioproxy(picture.memory.get()) || !picture.in->open(name, spec, reading_options()))
        fail_read(name, picture.in->geterror());
    return picture;
}

OpenPicture open_file(const std::filesystem::path& path, std::uint64_t& file_bytes) {
    const std::string name = path.string();
    std::error_code status;
    const std::filesystem::file_status there = std::filesystem::status(path, status);
    if (!std::filesystem::exists(there)) fail_read(name, "no such file");
    if (!std::filesystem::is_regular_file(there)) fail_read(name, "it is not a plain file");
    file_bytes = std::filesystem::file_size(path);
    std::vector<unsigned char> bytes(8);
    std::ifstream file(path, std::ios::binary);
    if (!file) fail_read(name, "it cannot be opened");
    const auto read = [&](std::size_t first) {
        file.read(reinterpret_cast<char*>(bytes.data() + first), static_cast<std::streamsize>(bytes.size() - first));
        bytes.resize(first + static_cast<std::size_t>(file.gcount()));
    };
    read(0);
    if (const char* format = picture_format(bytes)) {
        bytes.resize(file_bytes);
        read(8);
        OpenPicture picture = open_bytes(bytes, format, name);
        picture.bytes = std::move(bytes);  // moving a vector leaves its elements in place
        return picture;
    }
    OpenPicture picture;
    const OIIO::ImageSpec config = reading_options();
    picture.in = OIIO::ImageInput::open(name, &config);
    if (!picture.in) fail_read(name, OIIO::geterror());
    return picture;
}

// The texts of a picture file. Names with a colon are internal to OpenImageIO. In a TIFF file write_image() stores the
// texts as lines of the description.
Metadata texts_of(const OIIO::ImageSpec& spec) {
    Metadata texts;
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        if (attribute.type() != OIIO::TypeDesc::STRING || name.find(':') != std::string::npos) continue;
        std::istringstream lines(attribute.get_string());
        std::string line;
        std::size_t colon = 0;
        if (name == "ImageDescription" && lines.str().ends_with('\n'))
            while (std::getline(lines, line) && (colon = line.find(": ")) != std::string::npos)
                texts.emplace_back(line.substr(0, colon), line.substr(colon + 2));
        else
            texts.emplace_back(name, lines.str());
    }
    return texts;
}

}  // namespace

Image read_image(const std::filesystem::path& path, std::size_t max_pixels) {
    const std::string name = path.string();
    return guarded(name, [&] {
        std::uint64_t file_bytes = 0;
        const OpenPicture picture = open_file(path, file_bytes);
        check_size(picture.in->spec(), name, max_pixels, file_bytes);
        Image image = read_pixels(*picture.in, name);
        image.provenance = to_provenance(texts_of(picture.in->spec()));
        return image;
    });
}

Image decode_image(std::span<const unsigned char> bytes, const std::string& name, std::size_t max_pixels) {
    return guarded(name, [&] {
        const char* format = picture_format(bytes);
        if (format == nullptr)
            fail_read(name, "its first bytes are not those of a PNG, JPEG, EXR, TIFF, WebP, GIF, BMP, HDR or DDS file");
        const OpenPicture picture = open_bytes(bytes, format, name);
        check_size(picture.in->spec(), name, max_pixels, bytes.size());
        return read_pixels(*picture.in, name);
    });
}

RawPixels read_raw_pixels(const std::filesystem::path& path, std::size_t max_pixels) {
    const std::string name = path.string();
    return guarded(name, [&] {
        std::uint64_t file_bytes = 0;
        const OpenPicture picture = open_file(path, file_bytes);
        const OIIO::ImageSpec& spec = picture.in->spec();
        check_size(spec, name, max_pixels, file_bytes);
        // The picture must be grey, with or without alpha, or have three equal channels.
        const std::size_t channels = spec.nchannels >= 3 ? 3 : 1;
        std::vector<float> values(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                                  channels);
        RawPixels pixels;
        const bool whole = !spec.format.is_floating_point() && spec.format.size() <= 2;
        // OpenImageIO converts whole numbers to fractions of the largest one, which is undone here.
        if (whole) pixels.levels = spec.format.size() == 1 ? 256 : 65536;
        const float scale = whole ? static_cast<float>(pixels.levels - 1) : 1.0f;
        if (!picture.in->read_image(0, 0, 0, static_cast<int>(channels), OIIO::TypeDesc::FLOAT, values.data()))
            fail_read(name, picture.in->geterror());
        pixels.values = Array<float, 2>({static_cast<std::size_t>(spec.height), static_cast<std::size_t>(spec.width)});
        for (std::size_t i = 0; i < pixels.values.size(); ++i) {
            const float* pixel = &values[i * channels];
            if (channels == 3 && (pixel[0] != pixel[1] || pixel[0] != pixel[2]))
                fail_read(name, "its channels differ, but one number a pixel was expected");
            pixels.values.data()[i] = whole ? std::round(pixel[0] * scale) : pixel[0];
        }
        return pixels;
    });
}

Metadata read_metadata(const std::filesystem::path& path) {
    return guarded(path.string(), [&] {
        std::uint64_t file_bytes = 0;
        return texts_of(open_file(path, file_bytes).in->spec());
    });
}

}  // namespace hogel
