// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/formats/formats.h"
#include "hogel/image/formats/row_blocks.h"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace hogel::image {
namespace {

// A file in memory and the first error that libtiff reports for it.
struct Memory {
    const unsigned char* data = nullptr;  // input, or null when writing
    std::size_t size = 0;
    std::vector<unsigned char> written;
    std::size_t offset = 0;
    std::string error;

    std::size_t end() const { return data != nullptr ? size : written.size(); }
};

Memory& memory_of(thandle_t handle) { return *static_cast<Memory*>(handle); }

tmsize_t take(thandle_t handle, void* into, tmsize_t size) {
    Memory& memory = memory_of(handle);
    const std::size_t begin = std::min(memory.offset, memory.end());
    const std::size_t count = std::min(static_cast<std::size_t>(std::max<tmsize_t>(size, 0)), memory.end() - begin);
    const unsigned char* from = memory.data != nullptr ? memory.data : memory.written.data();
    if (count > 0) std::memcpy(into, from + begin, count);
    memory.offset = begin + count;
    return static_cast<tmsize_t>(count);
}

tmsize_t put(thandle_t handle, void* from, tmsize_t size) {
    Memory& memory = memory_of(handle);
    if (memory.data != nullptr || size < 0) return -1;
    const std::size_t end = memory.offset + static_cast<std::size_t>(size);
    if (end > memory.written.size()) memory.written.resize(end);
    if (size > 0) std::memcpy(memory.written.data() + memory.offset, from, static_cast<std::size_t>(size));
    memory.offset = end;
    return size;
}

toff_t seek(thandle_t handle, toff_t to, int from) {
    Memory& memory = memory_of(handle);
    const std::size_t base = from == SEEK_CUR ? memory.offset : from == SEEK_END ? memory.end() : 0;
    memory.offset = base + static_cast<std::size_t>(to);
    return memory.offset;
}

int close(thandle_t) { return 0; }
toff_t end(thandle_t handle) { return memory_of(handle).end(); }

// libtiff's handlers are global. The handle identifies the file; it is null if there is none.
void note_error(thandle_t handle, const char*, const char* format, va_list values) {
    if (handle == nullptr || !memory_of(handle).error.empty()) return;
    std::array<char, 200> text;
    std::vsnprintf(text.data(), text.size(), format, values);
    memory_of(handle).error = text.data();
}

struct Close {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using File = std::unique_ptr<TIFF, Close>;

File open(Memory& memory, const char* mode) {
    static const bool silent = [] {
        TIFFSetErrorHandler(nullptr);
        TIFFSetWarningHandler(nullptr);
        TIFFSetWarningHandlerExt(nullptr);
        TIFFSetErrorHandlerExt(note_error);
        return true;
    }();
    static_cast<void>(silent);
    // "m" disables memory mapping.
    return File(TIFFClientOpen("picture", mode, &memory, take, put, seek, close, end, nullptr, nullptr));
}

struct Layout {
    std::uint32_t width = 0, height = 0;
    std::uint16_t channels = 1, bits = 1, format = SAMPLEFORMAT_UINT, light = PHOTOMETRIC_MINISBLACK;
    std::uint16_t planes = PLANARCONFIG_CONTIG;

    explicit Layout(TIFF* tiff) {
        TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
        TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
        TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &channels);
        TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
        TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
        TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &light);
        TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planes);
    }
    // Returns whether rows can be read unchanged; libtiff converts other layouts to 8 bits.
    bool plain(TIFF* tiff) const {
        const bool known =
            (format == SAMPLEFORMAT_UINT && (bits == 8 || bits == 16)) || (format == SAMPLEFORMAT_IEEEFP && bits == 32);
        return known && TIFFIsTiled(tiff) == 0 && planes == PLANARCONFIG_CONTIG &&
               ((light == PHOTOMETRIC_MINISBLACK && channels < 3) || (light == PHOTOMETRIC_RGB && channels >= 3));
    }
};

[[noreturn]] void fail(const PictureBytes& file, const Memory& memory) {
    file.fail(memory.error.empty() ? "it is damaged" : memory.error);
}

template <class T>
Samples read_rows(TIFF* tiff, const Layout& layout, const PictureBytes& file, const Memory& memory) {
    const std::size_t stored = layout.channels, kept = stored >= 3 ? 3 : 1, width = layout.width;
    if (static_cast<std::size_t>(TIFFScanlineSize(tiff)) != width * stored * sizeof(T)) fail(file, memory);
    Array<T, 3> samples({layout.height, width, kept});
    std::vector<T> row(width * stored);
    for_row_blocks(layout.height, width * stored, [&](std::size_t first, std::size_t last) {
        for (std::size_t y = first; y < last; ++y) {
            if (TIFFReadScanline(tiff, row.data(), static_cast<std::uint32_t>(y), 0) != 1) fail(file, memory);
            for (std::size_t x = 0; x < width; ++x) std::copy_n(&row[x * stored], kept, &samples(y, x, 0u));
        }
    });
    return samples;
}

Samples read_converted(TIFF* tiff, const Layout& layout, const PictureBytes& file, const Memory& memory) {
    std::vector<std::uint32_t> packed(std::size_t{layout.width} * layout.height);
    if (TIFFReadRGBAImageOriented(tiff, layout.width, layout.height, packed.data(), ORIENTATION_TOPLEFT, 1) != 1)
        fail(file, memory);
    Array<std::uint8_t, 3> samples({layout.height, layout.width, 3});
    for (std::size_t i = 0; i < packed.size(); ++i) {
        samples.data()[3 * i] = static_cast<std::uint8_t>(TIFFGetR(packed[i]));
        samples.data()[3 * i + 1] = static_cast<std::uint8_t>(TIFFGetG(packed[i]));
        samples.data()[3 * i + 2] = static_cast<std::uint8_t>(TIFFGetB(packed[i]));
    }
    return samples;
}

// TIFF has no text fields with free names: hogel stores texts as lines "key: text" in the description.
Metadata texts_of(TIFF* tiff) {
    constexpr std::array<std::pair<std::uint32_t, const char*>, 4> tags{{{TIFFTAG_IMAGEDESCRIPTION, "ImageDescription"},
                                                                         {TIFFTAG_SOFTWARE, "Software"},
                                                                         {TIFFTAG_DATETIME, "DateTime"},
                                                                         {TIFFTAG_ARTIST, "Artist"}}};
    Metadata texts;
    for (const auto& [tag, name] : tags) {
        const char* text = nullptr;
        if (TIFFGetField(tiff, tag, &text) != 1 || text == nullptr) continue;
        std::istringstream lines(text);
        std::string line;
        std::size_t colon = 0;
        if (tag == TIFFTAG_IMAGEDESCRIPTION && lines.str().ends_with('\n'))
            while (std::getline(lines, line) && (colon = line.find(": ")) != std::string::npos)
                texts.emplace_back(line.substr(0, colon), line.substr(colon + 2));
        else
            texts.emplace_back(name, text);
    }
    return texts;
}

}  // namespace

Picture read_tiff(const PictureBytes& file) {
    Memory memory;
    memory.data = file.bytes.data();
    memory.size = file.bytes.size();
    const File tiff = open(memory, "rm");
    if (!tiff) fail(file, memory);
    Picture picture{{}, texts_of(tiff.get())};
    if (file.only_texts) return picture;
    const Layout layout(tiff.get());
    file.check_size(layout.width, layout.height, layout.channels, std::max(layout.bits / 8, 1));
    if (!layout.plain(tiff.get()))
        picture.samples = read_converted(tiff.get(), layout, file, memory);
    else if (layout.bits == 8)
        picture.samples = read_rows<std::uint8_t>(tiff.get(), layout, file, memory);
    else if (layout.bits == 16)
        picture.samples = read_rows<std::uint16_t>(tiff.get(), layout, file, memory);
    else
        picture.samples = read_rows<float>(tiff.get(), layout, file, memory);
    return picture;
}

std::vector<unsigned char> tiff_file(View<const std::uint8_t, 3> pixels, const Metadata& texts) {
    const std::size_t height = pixels.extent(0), row = pixels.extent(1) * pixels.extent(2);
    const bool grey = pixels.extent(2) == 1;
    std::string lines;
    for (const auto& [key, text] : texts) lines += fmt::format("{}: {}\n", key, text);
    Memory memory;
    bool done = false;
    if (File tiff = open(memory, "wm")) {
        TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(pixels.extent(1)));
        TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(height));
        TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, grey ? 1 : 3);
        TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, 8);
        TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, grey ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
        TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
        TIFFSetField(tiff.get(), TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
        TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
        TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
        TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, 32);
        if (!lines.empty()) TIFFSetField(tiff.get(), TIFFTAG_IMAGEDESCRIPTION, lines.c_str());
        std::vector<std::uint8_t> line(row);
        done = true;
        for_row_blocks(height, row, [&](std::size_t first, std::size_t last) {
            for (std::size_t y = first; y < last && done; ++y) {
                std::copy_n(pixels.data() + y * row, row, line.data());  // libtiff modifies its input
                done = TIFFWriteScanline(tiff.get(), line.data(), static_cast<std::uint32_t>(y), 0) == 1;
            }
        });
        done = done && TIFFWriteDirectory(tiff.get()) == 1;
    }
    if (!done) throw std::runtime_error(memory.error);
    return std::move(memory.written);
}

}  // namespace hogel::image
