// SPDX-License-Identifier: Apache-2.0
// Portable pixmaps and float maps. The text header has a magic number and three numbers (columns, rows, and the largest
// code or a scale), and ends with one white-space character. The samples follow without padding.
//   P5, P6  grey and colour (pgm(5), ppm(5)): codes 0 to at most 65535; above 255 two bytes each, big-endian Pf, PF
//   grey and colour floats (Debevec's Portable Float Map): rows from the bottom up; a negative scale means
//           little-endian; the magnitude of the scale has no agreed meaning and is ignored
#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "hogel/image/formats/formats.h"

namespace hogel::image {
namespace {

struct Header {
    std::size_t width = 0, height = 0, channels = 1;
    double last = 0;        // largest code, or scale
    std::size_t begin = 0;  // offset of the samples
};

bool is_space(unsigned char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Returns the next word of a header, after white space and comments from '#' to the end of the line.
std::string_view take_word(const PictureBytes& file, std::size_t& position) {
    constexpr std::size_t max_word = 32;
    const std::span<const unsigned char> bytes = file.bytes;
    while (position < bytes.size() && (is_space(bytes[position]) || bytes[position] == '#')) {
        if (bytes[position] == '#')
            while (position < bytes.size() && bytes[position] != '\n' && bytes[position] != '\r') ++position;
        else
            ++position;
    }
    const std::size_t first = position;
    while (position < bytes.size() && !is_space(bytes[position]) && position - first <= max_word) ++position;
    if (position == first || position == bytes.size() || position - first > max_word)
        file.fail("it ends inside its header");
    return {reinterpret_cast<const char*>(bytes.data()) + first, position - first};
}

template <class T>
T take_number(const PictureBytes& file, std::size_t& position) {
    const std::string_view word = take_word(file, position);
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
        file.fail("its header holds a word where a number was expected");
    return value;
}

Header read_header(const PictureBytes& file, char grey) {
    Header header;
    std::size_t position = 2;
    header.channels = file.bytes[1] == grey ? 1 : 3;
    header.width = take_number<std::uint32_t>(file, position);
    header.height = take_number<std::uint32_t>(file, position);
    header.last = take_number<double>(file, position);
    header.begin = position + 1;
    return header;
}

void require_samples(const PictureBytes& file, const Header& header, std::size_t sample_bytes) {
    file.check_size(header.width, header.height, header.channels, sample_bytes);
    const std::size_t wanted = header.width * header.height * header.channels * sample_bytes;
    const std::size_t present = file.bytes.size() - std::min(header.begin, file.bytes.size());
    if (present < wanted) file.fail(fmt::format("it is truncated: {} bytes of samples instead of {}", present, wanted));
}

// Scales codes 0 … max to the range of T, rounded to nearest. Different codes stay different.
template <class T>
Array<T, 3> read_codes(const PictureBytes& file, const Header& header, std::uint32_t max) {
    require_samples(file, header, sizeof(T));
    constexpr std::uint32_t full = sizeof(T) == 1 ? 255 : 65535;
    Array<T, 3> samples(Shape<3>{header.height, header.width, header.channels});
    const unsigned char* from = file.bytes.data() + header.begin;
    for (T& sample : samples.elements()) {
        std::uint32_t code = *from++;
        if constexpr (sizeof(T) == 2) code = code << 8 | *from++;
        if (code > max) file.fail(fmt::format("a sample is {}, but the header says that none exceeds {}", code, max));
        sample = static_cast<T>((code * full + max / 2) / max);
    }
    return samples;
}

std::vector<unsigned char> begin_file(const std::string& header, std::size_t bytes) {
    std::vector<unsigned char> file(header.begin(), header.end());
    file.reserve(header.size() + bytes);
    return file;
}

}  // namespace

Picture read_pnm(const PictureBytes& file) {
    if (file.bytes.size() < 2 || file.bytes[1] < '5')
        file.fail("pixmaps are read as binary ones (P5, P6), not as text or bitmaps");
    if (file.only_texts) return {};
    const Header header = read_header(file, '5');
    const double max = header.last;
    if (!(max >= 1 && max <= 65535 && max == std::floor(max)))
        file.fail(fmt::format("its largest sample is {}, but 1 to 65535 was expected", max));
    Picture picture;
    picture.max_code = static_cast<std::uint32_t>(max);
    if (picture.max_code <= 255)
        picture.samples = read_codes<std::uint8_t>(file, header, picture.max_code);
    else
        picture.samples = read_codes<std::uint16_t>(file, header, picture.max_code);
    return picture;
}

Picture read_pfm(const PictureBytes& file) {
    if (file.only_texts) return {};
    const Header header = read_header(file, 'f');
    if (!std::isfinite(header.last) || header.last == 0)
        file.fail(fmt::format("its scale is {}, but a number other than 0 was expected", header.last));
    require_samples(file, header, sizeof(float));
    const bool swap = (header.last < 0) != (std::endian::native == std::endian::little);
    Array<float, 3> samples(Shape<3>{header.height, header.width, header.channels});
    const std::size_t row = header.width * header.channels;
    for (std::size_t y = 0; y < header.height; ++y) {
        float* const to = samples[header.height - 1 - y].data();
        std::memcpy(to, file.bytes.data() + header.begin + y * row * sizeof(float), row * sizeof(float));
        if (!swap) continue;
        for (std::size_t x = 0; x < row; ++x)
            to[x] = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(to[x])));
    }
    return {std::move(samples), {}};
}

std::vector<unsigned char> pnm_file(View<const std::uint16_t, 3> codes, std::uint32_t max_code) {
    const bool wide = max_code > 255;
    std::vector<unsigned char> file = begin_file(
        fmt::format("P{}\n{} {}\n{}\n", codes.extent(2) == 1 ? 5 : 6, codes.extent(1), codes.extent(0), max_code),
        codes.size() * (wide ? 2 : 1));
    for (const std::uint16_t code : codes.elements()) {
        if (wide) file.push_back(static_cast<unsigned char>(code >> 8));
        file.push_back(static_cast<unsigned char>(code));
    }
    return file;
}

std::vector<unsigned char> pfm_file(View<const float, 3> pixels) {
    static_assert(std::endian::native == std::endian::little);
    const std::size_t row = pixels.extent(1) * pixels.extent(2) * sizeof(float);
    std::vector<unsigned char> file = begin_file(
        fmt::format("P{}\n{} {}\n-1.0\n", pixels.extent(2) == 1 ? 'f' : 'F', pixels.extent(1), pixels.extent(0)),
        row * pixels.extent(0));
    for (std::size_t y = pixels.extent(0); y-- > 0;) {
        const auto* from = reinterpret_cast<const unsigned char*>(pixels[y].data());
        file.insert(file.end(), from, from + row);
    }
    return file;
}

}  // namespace hogel::image
