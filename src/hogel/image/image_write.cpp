// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <new>

#include "hogel/core/output_file.h"
#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/image/picture_bytes.h"

namespace hogel {

using namespace image;

namespace {

unsigned char quantise(float linear, double exposure) {
    return static_cast<unsigned char>(std::lround(255 * srgb_encode(static_cast<float>(linear * exposure))));
}

// TIFF has no free text fields, so there metadata is stored in the description, one line per entry.
void add_metadata(OIIO::ImageSpec& spec, const std::string& format, const Metadata& metadata) {
    if (format == "tiff") {
        std::string lines;
        for (const auto& [key, value] : metadata) lines += fmt::format("{}: {}\n", key, value);
        if (!lines.empty()) spec.attribute("ImageDescription", lines);
    } else {
        for (const auto& [key, value] : metadata) spec.attribute(key, value);
    }
}

[[noreturn]] void fail_write(const std::string& name, const std::string& why) {
    throw Error(ErrorCode::cannot_write, fmt::format("cannot write the picture '{}': {}", name, one_line(why)));
}

void check_writable(const Image& image, double exposure, const std::string& name) {
    constexpr std::size_t widest = std::numeric_limits<int>::max() / 4;
    if (image.pixels.size() == 0 || image.width() > widest || image.height() > widest ||
        (image.channels() != 1 && image.channels() != 3))
        fail_write(name, fmt::format("{}x{} pixels in {} channels", image.width(), image.height(), image.channels()));
    if (!(std::isfinite(exposure) && exposure > 0))
        throw Error(ErrorCode::usage, fmt::format("the exposure is {}, but must be positive and finite", exposure));
}

// Writes to `memory`, or to the file `path` if `memory` is null.
void encode(const Image& image, double exposure, const std::string& format, const Metadata& metadata,
            const std::string& name, OIIO::Filesystem::IOProxy* memory, const std::string& path) {
    const bool linear = format == "openexr";
    OIIO::ImageSpec spec(static_cast<int>(image.width()), static_cast<int>(image.height()),
                         static_cast<int>(image.channels()), linear ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
    if (image.channels() == 1) spec.channelnames = {"Y"};
    spec.attribute("oiio:ColorSpace", linear ? "linear" : "sRGB");
    add_metadata(spec, format, metadata);
    try {
        const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
        if (!out) fail_write(name, OIIO::geterror());
        if (memory != nullptr) out->set_ioproxy(memory);
        if (!out->open(path, spec)) fail_write(name, out->geterror());
        bool written = false;
        if (linear) {
            written = out->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data());
        } else {
            Array<unsigned char, 3> display(image.pixels.shape());
            core::parallel_for(image.height(), [&](std::size_t y) {
                std::ranges::transform(image.pixels[y].elements(), display[y].elements().begin(),
                                       [&](float value) { return quantise(value, exposure); });
            });
            written = out->write_image(OIIO::TypeDesc::UINT8, display.data());
        }
        if (!written || !out->close()) fail_write(name, out->geterror());
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail_write(name, error.what());
    }
}

std::vector<unsigned char> encode_to_memory(const Image& image, double exposure, const std::string& format,
                                            const Metadata& metadata, const std::string& name) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    encode(image, exposure, format, metadata, name, &memory, name);
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

}  // namespace

void write_image(const std::filesystem::path& path, const Image& image, double exposure, const Metadata& options) {
    const Metadata metadata = with_history(options, to_metadata(image.provenance));
    const std::string format = format_of(path);
    check_writable(image, exposure, path.string());
    core::OutputFile file(path);
    if (format == "tiff") {
        // OpenImageIO cannot write TIFF to memory: the directory, which is written last, is lost.
        encode(image, exposure, format, metadata, path.string(), nullptr, file.temporary().string());
        file.commit();
    } else {
        core::write_file(path, encode_to_memory(image, exposure, format, metadata, path.string()));
    }
}

void require_picture_name(const std::filesystem::path& path) { format_of(path); }

std::vector<unsigned char> encode_png(const Image& image, double exposure) {
    check_writable(image, exposure, "PNG");
    return encode_to_memory(image, exposure, "png", {}, "PNG");
}

}  // namespace hogel
