// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <new>
#include <system_error>
#include <type_traits>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/image/picture_bytes.h"
#include "hogel/image/texture_picture.h"
#include "hogel/work/parallel.h"

namespace hogel {

using namespace image;

namespace image {

// Maximum ratio of a picture's size in memory to its file size; deflate reaches 1032. It prevents a few bytes from
// allocating gigabytes. Pictures up to the second limit, bytes, are exempt.
constexpr std::uint64_t max_expansion = 4096;
constexpr std::uint64_t always_allowed = std::uint64_t{16} << 20;

void PictureBytes::fail(const std::string& why) const {
    throw Error(ErrorCode::bad_input, fmt::format("cannot read the picture '{}': {}", name, one_line(why)));
}

void PictureBytes::check_size(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                              std::uint64_t sample_bytes) const {
    constexpr std::uint64_t widest = 0x7fffffff;
    if (width == 0 || height == 0 || width > widest || height > widest || channels < 1 || channels > 64)
        fail(fmt::format("a picture was expected, not {}x{} pixels in {} channels", width, height, channels));
    if (width * height > max_pixels)
        fail(fmt::format("{}x{} pixels are more than the {} that are accepted", width, height, max_pixels));
    const std::uint64_t claimed = width * height * channels * sample_bytes;
    if (claimed > always_allowed && claimed / max_expansion > bytes.size())
        fail(fmt::format("{} bytes are too few for {}x{} pixels", bytes.size(), width, height));
}

}  // namespace image

namespace {

constexpr std::size_t max_texture = std::size_t{1} << 28;  // pixels
constexpr std::size_t pixels_between_checks = 1 << 20;

constexpr const char* unknown_format =
    "its first bytes are not those of a PNG, JPEG, EXR, TIFF, WebP, GIF, BMP, HDR, PNM, PFM or TGA file";

// Returns the linear light of each 16-bit display value; 8-bit values correspond to multiples of 257.
const std::vector<float>& linear_of_display() {
    static const std::vector<float> table = [] {
        std::vector<float> values(65536);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = srgb_decode(static_cast<float>(i) / 65535.0f);
        return values;
    }();
    return table;
}

Image linear_image(Samples&& samples, bool numbers = false) {
    Image image;
    if (auto* linear = std::get_if<Array<float, 3>>(&samples)) {
        image.pixels = std::move(*linear);
        return image;
    }
    std::visit(
        [&](const auto& values) {
            using T = std::remove_cvref_t<decltype(values(0u, 0u, 0u))>;
            constexpr std::size_t step = std::is_same_v<T, std::uint8_t> ? 257 : 1;
            const std::vector<float>& table = linear_of_display();
            image.pixels = Array<float, 3>(values.shape());
            // Alpha and data other than light have no transfer curve.
            const std::size_t channels = values.extent(2), first = numbers ? 0 : channels == 4 ? 3 : channels;
            constexpr float largest = std::is_same_v<T, std::uint8_t> ? 255.0f : 65535.0f;
            work::parallel_for(values.extent(0), [&](std::size_t y) {
                const View<const T, 2> from = values[y];
                const View<float, 2> to = image.pixels[y];
                std::ranges::transform(from.elements(), to.data(),
                                       [&](T value) { return table[static_cast<std::size_t>(value) * step]; });
                for (std::size_t c = first; c < channels; ++c)
                    for (std::size_t i = c; i < from.size(); i += channels)
                        to.data()[i] = static_cast<float>(from.data()[i]) / largest;
            });
        },
        samples);
    return image;
}

// Converts samples to floats; returns one channel if three are equal.
template <class T>
RawChannels raw_channels(const Array<T, 3>& samples, std::uint32_t max_code) {
    RawChannels raw;
    const std::size_t channels = samples.extent(2), pixels = samples.extent(0) * samples.extent(1);
    if constexpr (!std::is_same_v<T, float>)
        raw.largest = max_code > 0 ? max_code : (std::size_t{1} << (8 * sizeof(T))) - 1;
    bool grey = true;
    for (std::size_t i = 0; i < pixels && channels == 3 && grey; ++i) {
        if (i % pixels_between_checks == 0) core::throw_if_stopped();
        const T* pixel = samples.data() + i * channels;
        grey = pixel[0] == pixel[1] && pixel[0] == pixel[2];
    }
    const std::size_t kept = grey ? 1 : channels;
    raw.values = Array<float, 3>({samples.extent(0), samples.extent(1), kept});
    for (std::size_t i = 0; i < pixels; ++i) {
        if (i % pixels_between_checks == 0) core::throw_if_stopped();
        for (std::size_t c = 0; c < kept; ++c)
            raw.values.data()[i * kept + c] = static_cast<float>(samples.data()[i * channels + c]);
    }
    return raw;
}

Picture read_bytes(const PictureBytes& file) {
    return guarded(file, [&] {
        const PictureReader read = picture_reader(file.bytes);
        if (read == nullptr) file.fail(unknown_format);
        Picture picture = read(file);
        // Drops names with a colon: they are internal properties of programs, such as "oiio:ColorSpace".
        std::erase_if(picture.texts, [](const auto& entry) { return entry.first.find(':') != std::string::npos; });
        return picture;
    });
}

Picture read_file(const std::filesystem::path& path, std::size_t max_pixels, bool only_texts = false,
                  bool with_alpha = false) {
    PictureBytes file{{}, path.string(), max_pixels, only_texts, with_alpha};
    const std::vector<unsigned char> bytes = bytes_of_file(path, file);
    file.bytes = bytes;
    return read_bytes(file);
}

}  // namespace

std::vector<unsigned char> image::bytes_of_file(const std::filesystem::path& path, const PictureBytes& file) {
    std::error_code status;
    const std::filesystem::file_status file_status = std::filesystem::status(path, status);
    if (!std::filesystem::exists(file_status)) file.fail("no such file");
    if (!std::filesystem::is_regular_file(file_status)) file.fail("it is not a plain file");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) file.fail("it cannot be opened");
    std::vector<unsigned char> bytes(beginning);
    const auto read = [&](std::size_t first) {
        stream.read(reinterpret_cast<char*>(bytes.data() + first), static_cast<std::streamsize>(bytes.size() - first));
        bytes.resize(first + static_cast<std::size_t>(stream.gcount()));
    };
    read(0);
    if (picture_reader(bytes) == nullptr) file.fail(unknown_format);
    if (bytes.size() == beginning)
        guarded(file, [&] {
            bytes.resize(std::max(std::filesystem::file_size(path), std::uintmax_t{beginning}));
            read(beginning);
        });
    return bytes;
}

Picture image::read_picture(const std::filesystem::path& path, std::size_t max_pixels) {
    return guarded({{}, path.string()}, [&] { return read_file(path, max_pixels); });
}

Image read_image(const std::filesystem::path& path, std::size_t max_pixels) {
    return guarded({{}, path.string()}, [&] {
        Picture picture = read_file(path, max_pixels);
        Image image = linear_image(std::move(picture.samples));
        image.provenance = to_provenance(std::move(picture.texts));
        return image;
    });
}

Image decode_image(std::span<const unsigned char> bytes, const std::string& name, std::size_t max_pixels) {
    return guarded({{}, name}, [&] { return linear_image(read_bytes({bytes, name, max_pixels}).samples); });
}

Image image::decode_texture(std::span<const unsigned char> bytes, const std::string& name, TexturePixels pixels) {
    return guarded({{}, name}, [&] {
        const bool alpha = pixels == TexturePixels::color_and_alpha;
        return linear_image(read_bytes({bytes, name, max_texture, false, alpha}).samples,
                            pixels == TexturePixels::numbers);
    });
}

Image image::read_texture(const std::filesystem::path& path, TexturePixels pixels) {
    return guarded({{}, path.string()}, [&] {
        const bool alpha = pixels == TexturePixels::color_and_alpha;
        return linear_image(read_file(path, max_texture, false, alpha).samples, pixels == TexturePixels::numbers);
    });
}

RawChannels read_raw_channels(const std::filesystem::path& path, std::size_t max_pixels) {
    return guarded({{}, path.string()}, [&] {
        const Picture picture = read_file(path, max_pixels);
        return std::visit([&](const auto& samples) { return raw_channels(samples, picture.max_code); },
                          picture.samples);
    });
}

RawPixels read_raw_pixels(const std::filesystem::path& path, std::size_t max_pixels) {
    const RawChannels raw = read_raw_channels(path, max_pixels);
    if (raw.values.extent(2) != 1)
        PictureBytes{{}, path.string()}.fail("its channels differ, but one number a pixel was expected");
    RawPixels pixels;
    pixels.values = Array<float, 2>({raw.values.extent(0), raw.values.extent(1)});
    std::ranges::copy(raw.values.elements(), pixels.values.data());
    pixels.levels = raw.largest == 0 ? 0 : raw.largest < 256 ? 256 : 65536;
    return pixels;
}

Metadata read_metadata(const std::filesystem::path& path) { return read_file(path, 0, true).texts; }

}  // namespace hogel
