// SPDX-License-Identifier: Apache-2.0
// The only source that compiles stb_image, restricted to the formats without a library of their own.
#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace {

// Memory blocks of stb_image on this thread. An exception that passes through stb_image would leak them.
thread_local std::vector<void*> blocks;

void* track(void* block) {
    if (block != nullptr) blocks.push_back(block);
    return block;
}

void untrack(void* block) {
    const auto found = std::find(blocks.begin(), blocks.end(), block);
    if (found != blocks.end()) blocks.erase(found);
}

struct ReleaseAll {
    ~ReleaseAll() {
        for (void* block : blocks) std::free(block);
        blocks.clear();
    }
};

}  // namespace

#define STBI_MALLOC(size) track(std::malloc(size))
#define STBI_REALLOC(block, size) (untrack(block), track(std::realloc(block, size)))
#define STBI_FREE(block) (untrack(block), std::free(block))
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_ONLY_HDR
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
// A damaged file must not abort the program.
#define STBI_ASSERT(condition) \
    if (!(condition)) throw std::runtime_error("it is damaged")
#include <stb/stb_image.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "hogel/image/formats/formats.h"

namespace hogel::image {
namespace {

// Input of stb_image. The end of the file is an exception: stb_image would read zeros after it and might never return.
struct StbSource {
    std::span<const unsigned char> bytes;
    std::size_t offset = 0;
};

int take(void* user, char* into, int size) {
    auto& source = *static_cast<StbSource*>(user);
    const std::size_t count =
        std::min(static_cast<std::size_t>(std::max(size, 0)), source.bytes.size() - source.offset);
    if (count == 0 && size > 0) throw std::runtime_error("it ends too early");
    if (count > 0) std::memcpy(into, source.bytes.data() + source.offset, count);
    source.offset += count;
    return static_cast<int>(count);
}

void skip(void* user, int count) {  // a negative count moves backwards
    auto& source = *static_cast<StbSource*>(user);
    const std::int64_t to = static_cast<std::int64_t>(source.offset) + count;
    source.offset =
        static_cast<std::size_t>(std::clamp<std::int64_t>(to, 0, static_cast<std::int64_t>(source.bytes.size())));
}

int at_end(void* user) {
    const auto& source = *static_cast<StbSource*>(user);
    return source.offset >= source.bytes.size() ? 1 : 0;
}

constexpr stbi_io_callbacks callbacks{take, skip, at_end};

[[noreturn]] void fail(const PictureBytes& file) {
    const char* reason = stbi_failure_reason();
    file.fail(reason != nullptr ? reason : "it is damaged");
}

struct Free {
    void operator()(void* memory) const { stbi_image_free(memory); }
};

// Returns whether a file is a bitmap with a grey palette. After 14 bytes follows a header that begins with its length
// and has the bits per pixel at byte 14; then the palette, four bytes per colour, up to the pixels.
bool has_grey_palette(std::span<const unsigned char> bytes) {
    const auto number = [&](std::size_t offset) {
        return bytes[offset] | std::size_t{bytes[offset + 1]} << 8 | std::size_t{bytes[offset + 2]} << 16 |
               std::size_t{bytes[offset + 3]} << 24;
    };
    if (bytes.size() < 54 || bytes[0] != 'B' || bytes[1] != 'M' || bytes[28] > 8 || bytes[29] != 0) return false;
    const std::size_t pixels = number(10), palette = 14 + number(14);
    if (number(14) < 40 || palette + 4 > pixels || pixels > bytes.size()) return false;
    for (std::size_t offset = palette; offset + 4 <= pixels; offset += 4)
        if (bytes[offset] != bytes[offset + 1] || bytes[offset] != bytes[offset + 2]) return false;
    return true;
}

// `load` is the function of stb_image for this sample type.
template <class T, class Load>
Samples load_samples(const PictureBytes& file, int channels, const Load& load) {
    StbSource source{file.bytes};
    int width = 0, height = 0, file_channels = 0;
    const std::unique_ptr<T, Free> pixels(load(&callbacks, &source, &width, &height, &file_channels, channels));
    if (!pixels) fail(file);
    const auto extent = [](int size) { return static_cast<std::size_t>(size); };
    Array<T, 3> samples({extent(height), extent(width), extent(channels)});
    std::copy_n(pixels.get(), samples.size(), samples.data());
    return samples;
}

}  // namespace

Picture read_with_stb(const PictureBytes& file) {
    if (file.only_texts) return {};
    const ReleaseAll release;
    StbSource source{file.bytes};
    int width = 0, height = 0, file_channels = 0;
    if (stbi_info_from_callbacks(&callbacks, &source, &width, &height, &file_channels) == 0) fail(file);
    StbSource start{file.bytes};
    const bool linear = stbi_is_hdr_from_callbacks(&callbacks, &start) != 0;
    const auto positive = [](int size) { return static_cast<std::uint64_t>(std::max(size, 0)); };
    const bool alpha = file.with_alpha && !linear && (file_channels == 2 || file_channels == 4);
    file.check_size(positive(width), positive(height), alpha ? 4 : positive(file_channels), linear ? sizeof(float) : 1);
    const int channels = alpha ? 4 : file_channels >= 3 && !has_grey_palette(file.bytes) ? 3 : 1;
    Picture picture;
    picture.samples = linear ? load_samples<float>(file, channels, stbi_loadf_from_callbacks)
                             : load_samples<stbi_uc>(file, channels, stbi_load_from_callbacks);
    return picture;
}

}  // namespace hogel::image
