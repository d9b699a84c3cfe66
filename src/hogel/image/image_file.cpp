#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include "hogel/core/error.h"
#include "hogel/core/output_file.h"
#include "hogel/core/parallel.h"
#include "hogel/image/image.h"

namespace hogel {
namespace {

// A picture that claims more than this many bytes a byte of its file (and some for the smallest) is damaged: deflate
// reaches 1032. Checked so that a few bytes cannot ask for gigabytes.
constexpr std::uint64_t most_expansion = 4096;
constexpr std::uint64_t always_allowed = std::uint64_t{16} << 20;

// What OpenImageIO has to say, on one line.
std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
    std::string line;
    for (const char c : text) {
        if (static_cast<unsigned char>(c) >= ' ')
            line += c;
        else if (!line.ends_with(' '))
            line += ' ';
    }
    return line.empty() ? "unknown reason" : line;
}

[[noreturn]] void fail_read(const std::string& name, const std::string& why) {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read the picture '{}': {}", name, one_line(why)));
}

// ---- writing

unsigned char quantise(float linear, double exposure) {
    return static_cast<unsigned char>(std::lround(255 * srgb_encode(static_cast<float>(linear * exposure))));
}

// TIFF keeps no free text fields, so there the words go into its description, a line each.
void add_metadata(OIIO::ImageSpec& spec, const std::string& format, const Metadata& metadata) {
    if (format == "tiff") {
        std::string lines;
        for (const auto& [key, value] : metadata) lines += fmt::format("{}: {}\n", key, value);
        if (!lines.empty()) spec.attribute("ImageDescription", lines);
    } else {
        for (const auto& [key, value] : metadata) spec.attribute(key, value);
    }
}

std::vector<unsigned char> encode(const Image& image, double exposure, const std::string& format,
                                  const Metadata& metadata) {
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::cannot_write, fmt::format("cannot encode a {} picture: {}", format, one_line(why)));
    };
    constexpr std::size_t widest = std::numeric_limits<int>::max() / 4;
    if (image.pixels.size() == 0 || image.width() > widest || image.height() > widest ||
        (image.channels() != 1 && image.channels() != 3))
        fail(fmt::format("{}x{} pixels in {} channels", image.width(), image.height(), image.channels()));
    if (!(std::isfinite(exposure) && exposure > 0))
        throw Error(ErrorCode::usage, fmt::format("the exposure is {}, but must be positive and finite", exposure));

    const bool linear = format == "openexr";
    OIIO::ImageSpec spec(static_cast<int>(image.width()), static_cast<int>(image.height()),
                         static_cast<int>(image.channels()), linear ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
    if (image.channels() == 1) spec.channelnames = {"Y"};
    spec.attribute("oiio:ColorSpace", linear ? "linear" : "sRGB");
    add_metadata(spec, format, metadata);

    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    try {
        const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
        if (!out) fail(OIIO::geterror());
        if (!out->set_ioproxy(&memory) || !out->open("picture", spec)) fail(out->geterror());
        bool written = false;
        if (linear) {
            written = out->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data());
        } else {
            Array<unsigned char, 3> display(image.pixels.shape());
            parallel_for(image.height(), [&](std::size_t y) {
                std::ranges::transform(image.pixels[y].elements(), display[y].elements().begin(),
                                       [&](float value) { return quantise(value, exposure); });
            });
            written = out->write_image(OIIO::TypeDesc::UINT8, display.data());
        }
        if (!written || !out->close()) fail(out->geterror());
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail(error.what());
    }
    return bytes;
}

std::string format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension == ".exr") return "openexr";
    if (extension == ".png") return "png";
    if (extension == ".tif" || extension == ".tiff") return "tiff";
    throw Error(ErrorCode::usage, fmt::format("'{}': pictures are written as .png, .exr or .tif", path.string()));
}

// ---- reading

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
    if (claimed > always_allowed && claimed / most_expansion > file_bytes)
        fail_read(name, fmt::format("{} bytes are too few for {}x{} pixels", file_bytes, width, height));
}

// Linear light for each 16-bit display value; 8-bit values are among them, as multiples of 257.
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

// OpenImageIO reports errors by return values, the libraries below it also by exceptions.
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

std::unique_ptr<OIIO::ImageInput> open_file(const std::filesystem::path& path) {
    std::error_code status;
    const std::filesystem::file_status there = std::filesystem::status(path, status);
    if (!std::filesystem::exists(there)) fail_read(path.string(), "no such file");
    if (!std::filesystem::is_regular_file(there)) fail_read(path.string(), "it is not a plain file");
    const OIIO::ImageSpec config = reading_options();
    std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path.string(), &config);
    if (!in) fail_read(path.string(), OIIO::geterror());
    return in;
}

// Pictures in memory often have no name to tell their format; their first bytes do.
const char* format_of(std::span<const unsigned char> bytes) {
    using namespace std::string_view_literals;
    struct Signature {
        std::string_view bytes;
        const char* format;
    };
    static constexpr std::array signatures{Signature{"\x89PNG\r\n\x1a\n"sv, "png"},
                                           Signature{"\xff\xd8\xff"sv, "jpeg"},
                                           Signature{"\x76\x2f\x31\x01"sv, "openexr"},
                                           Signature{"II*\0"sv, "tiff"},
                                           Signature{"MM\0*"sv, "tiff"},
                                           Signature{"RIFF"sv, "webp"},
                                           Signature{"GIF8"sv, "gif"},
                                           Signature{"BM"sv, "bmp"},
                                           Signature{"#?"sv, "hdr"},
                                           Signature{"DDS "sv, "dds"}};
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 16));
    for (const Signature& signature : signatures)
        if (start.starts_with(signature.bytes)) return signature.format;
    return nullptr;
}

}  // namespace

void write_image(const std::filesystem::path& path, const Image& image, double exposure, const Metadata& metadata) {
    const std::string format = format_of(path);
    const OutputFile probe(path);  // says that the target is impossible before the work is done
    write_file(path, encode(image, exposure, format, metadata));
}

std::vector<unsigned char> encode_png(const Image& image, double exposure) {
    return encode(image, exposure, "png", {});
}

Image read_image(const std::filesystem::path& path, std::size_t max_pixels) {
    return guarded(path.string(), [&] {
        const std::unique_ptr<OIIO::ImageInput> in = open_file(path);
        check_size(in->spec(), path.string(), max_pixels, std::filesystem::file_size(path));
        return read_pixels(*in, path.string());
    });
}

Image decode_image(std::span<const unsigned char> bytes, const std::string& name, std::size_t max_pixels) {
    return guarded(name, [&] {
        const char* format = format_of(bytes);
        if (format == nullptr)
            fail_read(name, "its first bytes are not those of a PNG, JPEG, EXR, TIFF, WebP, GIF, BMP, HDR or DDS file");
        const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::create(format);
        if (!in) fail_read(name, OIIO::geterror());
        OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
        OIIO::ImageSpec spec;
        if (!in->set_ioproxy(&memory) || !in->open(name, spec, reading_options())) fail_read(name, in->geterror());
        check_size(in->spec(), name, max_pixels, bytes.size());
        Image image = read_pixels(*in, name);
        in->close();  // before the bytes' reader goes
        return image;
    });
}

Metadata read_metadata(const std::filesystem::path& path) {
    return guarded(path.string(), [&] {
        const std::unique_ptr<OIIO::ImageInput> in = open_file(path);
        Metadata words;
        for (const OIIO::ParamValue& attribute : in->spec().extra_attribs)
            if (attribute.type() == OIIO::TypeDesc::STRING)
                words.emplace_back(attribute.name().string(), attribute.get_string());
        return words;
    });
}

}  // namespace hogel
