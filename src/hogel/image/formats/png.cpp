// SPDX-License-Identifier: Apache-2.0
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "hogel/image/formats/formats.h"
#include "hogel/image/formats/row_blocks.h"
#include "hogel/image/picture_bytes.h"

namespace hogel::image {
namespace {

// PNG's names of texts and the names in other formats and programs.
struct Keyword {
    std::string_view png, common;
};
constexpr std::array keywords{Keyword{"Description", "ImageDescription"}, Keyword{"Author", "Artist"},
                              Keyword{"Title", "DocumentName"}};

// libpng reports an error by a long jump to attempt(), which skips destructors: a step that calls libpng must own no
// objects with destructors. This struct keeps the message, because libpng's message is in the abandoned stack frame.
struct Failure {
    std::array<char, 200> text{};
};

void note_failure(png_structp png, png_const_charp message) {
    auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
    std::snprintf(failure->text.data(), failure->text.size(), "%s", message);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

template <class Step>
bool attempt(png_structp png, const Step& step) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    step();
    return true;
}

struct PngSource {
    const unsigned char* data;
    std::size_t remaining;
};

void take(png_structp png, png_bytep into, std::size_t size) {
    auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
    if (size > source->remaining) png_error(png, "it ends before its last chunk");
    std::memcpy(into, source->data, size);
    source->data += size;
    source->remaining -= size;
}

class PngReader {
  public:
    explicit PngReader(const PictureBytes& file) : file_(file), source_{file.bytes.data(), file.bytes.size()} {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure_, note_failure, ignore_warning);
        info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
        if (info_ == nullptr) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    void read_header() {
        run([&] {
            png_set_read_fn(png_, &source_, take);
            png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_size() applies stricter limits
            png_read_info(png_, info_);
        });
    }

    Metadata texts() {
        png_textp list = nullptr;
        int count = 0;
        run([&] { png_get_text(png_, info_, &list, &count); });
        Metadata texts;
        for (int i = 0; i < count; ++i) {
            std::string key = list[i].key;
            for (const Keyword& keyword : keywords)
                if (key == keyword.png) key = keyword.common;
            // Profiles are binary data of other formats, as hexadecimal digits.
            if (list[i].text != nullptr && !key.starts_with("Raw profile type")) texts.emplace_back(key, list[i].text);
        }
        return texts;
    }

    Samples pixels() {
        const std::size_t width = png_get_image_width(png_, info_), height = png_get_image_height(png_, info_);
        const bool deep = png_get_bit_depth(png_, info_) == 16;
        const int type = png_get_color_type(png_, info_);
        const bool grey = (type & PNG_COLOR_MASK_COLOR) == 0;
        const bool alpha = file_.with_alpha && ((type & PNG_COLOR_MASK_ALPHA) != 0 || has_transparent_colors());
        file_.check_size(width, height, alpha ? 4 : png_get_channels(png_, info_), deep ? 2 : 1);
        run([&] {
            if (type == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
            if (grey) png_set_expand_gray_1_2_4_to_8(png_);
            if (alpha) {
                png_set_tRNS_to_alpha(png_);
                if (grey) png_set_gray_to_rgb(png_);
            } else {
                png_set_strip_alpha(png_);
            }
            if (deep && std::endian::native == std::endian::little) png_set_swap(png_);
            passes_ = png_set_interlace_handling(png_);
            png_read_update_info(png_, info_);
        });
        const Shape<3> shape{height, width, alpha ? 4u : grey ? 1u : 3u};
        if (deep) return rows(Array<std::uint16_t, 3>(shape));
        return rows(Array<std::uint8_t, 3>(shape));
    }

  private:
    // Returns whether a tRNS chunk gives alpha to a palette or to one colour.
    bool has_transparent_colors() const { return png_get_valid(png_, info_, PNG_INFO_tRNS) != 0; }

    template <class Step>
    void run(const Step& step) {
        if (!attempt(png_, step)) file_.fail(failure_.text.data());
    }

    template <class T>
    Samples rows(Array<T, 3> samples) {
        const std::size_t row = samples.extent(1) * samples.extent(2);
        if (png_get_rowbytes(png_, info_) != row * sizeof(T)) file_.fail("its rows have an unexpected size");
        T* const first = samples.data();
        const std::size_t height = samples.extent(0);
        for (int pass = 0; pass < passes_; ++pass)
            for_row_blocks(height, row, [&](std::size_t begin, std::size_t end) {
                run([&] {
                    for (std::size_t y = begin; y < end; ++y)
                        png_read_row(png_, reinterpret_cast<png_bytep>(first + y * row), nullptr);
                });
            });
        return samples;
    }

    const PictureBytes& file_;
    PngSource source_;
    Failure failure_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    int passes_ = 1;
};

// Output buffer of a writer. Exceptions of allocations must not pass through libpng.
struct Sink {
    std::vector<unsigned char>* bytes;
    bool full = false;
};

void put(png_structp png, png_bytep from, std::size_t size) {
    auto* sink = static_cast<Sink*>(png_get_io_ptr(png));
    try {
        sink->bytes->insert(sink->bytes->end(), from, from + size);
    } catch (const std::bad_alloc&) {
        sink->full = true;
    }
    if (sink->full) png_error(png, "there is not enough memory");
}

// Converts the texts to libpng's structures. libpng copies them.
std::vector<png_text> png_texts(Metadata& texts) {
    std::vector<png_text> list;
    for (auto& [key, text] : texts) {
        if (key.empty()) continue;
        for (const Keyword& keyword : keywords)
            if (key == keyword.common) key = keyword.png;
        png_text entry{};
        entry.compression = PNG_TEXT_COMPRESSION_NONE;
        entry.key = key.data();
        entry.text = text.data();
        entry.text_length = text.size();
        list.push_back(entry);
    }
    return list;
}

// libpng's structures for writing a file.
struct PngWriting {
    explicit PngWriting(Failure& failure)
        : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, note_failure, ignore_warning)),
          info(png != nullptr ? png_create_info_struct(png) : nullptr) {
        if (info != nullptr) return;
        png_destroy_write_struct(&png, nullptr);
        throw std::bad_alloc();
    }
    ~PngWriting() { png_destroy_write_struct(&png, &info); }
    PngWriting(const PngWriting&) = delete;
    PngWriting& operator=(const PngWriting&) = delete;

    png_structp png;
    png_infop info;
};

template <class T>
std::vector<unsigned char> encode(View<const T, 3> pixels, const Metadata& texts, Curve curve) {
    std::vector<unsigned char> bytes;
    Metadata named = texts;
    const std::vector<png_text> list = png_texts(named);
    Sink sink{&bytes};
    Failure failure;
    PngWriting writing(failure);
    png_structp png = writing.png;
    png_infop info = writing.info;
    const auto height = static_cast<png_uint_32>(pixels.extent(0)), width = static_cast<png_uint_32>(pixels.extent(1));
    const int type = pixels.extent(2) == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB;
    const std::size_t row = pixels.extent(1) * pixels.extent(2);
    bool done = attempt(png, [&] {
        png_set_write_fn(png, &sink, put, nullptr);
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_compression_level(png, 6);
        png_set_compression_strategy(png, Z_DEFAULT_STRATEGY);  // keeps the output of earlier versions
        png_set_IHDR(png, info, width, height, 8 * sizeof(T), type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                     PNG_FILTER_TYPE_DEFAULT);
        if (curve == Curve::srgb) png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
        if (!list.empty()) png_set_text(png, info, list.data(), static_cast<int>(list.size()));
        png_write_info(png, info);
        if (sizeof(T) == 2 && std::endian::native == std::endian::little) png_set_swap(png);
    });
    for_row_blocks(height, row, [&](std::size_t first, std::size_t last) {
        done = done && attempt(png, [&] {
                   for (std::size_t y = first; y < last; ++y)
                       png_write_row(png, reinterpret_cast<png_const_bytep>(pixels.data() + y * row));
               });
    });
    done = done && attempt(png, [&] { png_write_end(png, info); });
    if (!done) throw std::runtime_error(failure.text.data());
    return bytes;
}

}  // namespace

Picture read_png(const PictureBytes& file) {
    const std::string damage = png_structure_error(file.bytes);
    if (!damage.empty()) file.fail(damage);
    PngReader reader(file);
    reader.read_header();
    Picture picture{{}, reader.texts()};
    if (!file.only_texts) picture.samples = reader.pixels();
    return picture;
}

std::vector<unsigned char> png_file(View<const std::uint8_t, 3> pixels, const Metadata& texts, Curve curve) {
    return encode(pixels, texts, curve);
}

std::vector<unsigned char> png_file(View<const std::uint16_t, 3> pixels, const Metadata& texts, Curve curve) {
    return encode(pixels, texts, curve);
}

}  // namespace hogel::image
