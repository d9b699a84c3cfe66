// SPDX-License-Identifier: Apache-2.0
// MAT files of version 5 (MATLAB 5 to 7.2, and the version that most programs write): a header of 128 bytes, then
// elements, each a type, a length and that number of bytes, padded to eight. An array is an element that contains
// elements: flags, extents, name, real parts, imaginary parts. Version 7 compresses whole arrays with zlib.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hogel/io/arrays/inflate.h"
#include "hogel/io/arrays/mat.h"

namespace hogel::io::arrays {
namespace {

constexpr std::uint32_t type_int8 = 1, type_int32 = 5, type_uint32 = 6, type_array = 14, type_compressed = 15;
constexpr std::size_t header_bytes = 128;
// Deflate expands by at most 1032.
constexpr std::size_t max_expansion = 1040;

struct Element {
    std::uint32_t type = 0;
    std::span<const unsigned char> bytes;
};

// Reads elements one after the other.
class Elements {
  public:
    Elements(const std::filesystem::path& path, std::span<const unsigned char> bytes) : path_(path), rest_(bytes) {}

    bool empty() const { return rest_.empty(); }

    Element next() {
        if (rest_.size() < 8) fail_external(path_, "it ends inside an element");
        const std::uint32_t word = number(0);
        if (word >> 16 != 0) {  // a small element is stored with its type and size in 8 bytes
            const std::size_t size = word >> 16;
            if (size > 4) fail_external(path_, "a small element is damaged");
            const Element small{word & 0xffff, rest_.subspan(4, size)};
            rest_ = rest_.subspan(8);
            return small;
        }
        const std::size_t size = number(4);
        if (size > rest_.size() - 8) fail_external(path_, fmt::format("it ends inside an element of {} bytes", size));
        const Element element{word, rest_.subspan(8, size)};
        const std::size_t padded = word == type_compressed ? size : (size + 7) / 8 * 8;
        rest_ = rest_.subspan(std::min(8 + padded, rest_.size()));
        return element;
    }

  private:
    std::uint32_t number(std::size_t at) const {
        std::uint32_t value;
        std::memcpy(&value, &rest_[at], sizeof value);
        return value;
    }

    const std::filesystem::path& path_;
    std::span<const unsigned char> rest_;
};

std::vector<unsigned char> inflated(const std::filesystem::path& path, std::span<const unsigned char> compressed) {
    const auto fill = [&](std::span<unsigned char> bytes) {
        if (!inflate(path, compressed, bytes, Extent::first)) fail_external(path, "a compressed array is damaged");
    };
    // The header of the array inside gives its length.
    std::vector<unsigned char> bytes(8);
    fill(bytes);
    std::uint32_t size = 0;
    std::memcpy(&size, &bytes[4], sizeof size);
    if (size / max_expansion > compressed.size()) fail_external(path, "a compressed array is damaged");
    bytes.resize(8 + std::size_t{size});
    fill(bytes);
    return bytes;
}

bool number_of(std::uint32_t type, Number& number) {
    static constexpr std::pair<std::uint32_t, Number> types[] = {
        {1, Number::int8},   {2, Number::uint8},  {3, Number::int16}, {4, Number::uint16}, {5, Number::int32},
        {6, Number::uint32}, {7, Number::single}, {9, Number::real},  {12, Number::int64}, {13, Number::uint64}};
    for (const auto& [code, meant] : types)
        if (code == type) {
            number = meant;
            return true;
        }
    return false;
}

// Appends the array if it is numeric, has two or three axes, and is wanted.
void take_array(const std::filesystem::path& path, std::span<const unsigned char> bytes,
                std::span<const std::string> only, std::vector<NumberArray>& arrays) {
    Elements parts(path, bytes);
    const Element flags = parts.next(), extents = parts.next(), label = parts.next();
    if (flags.type != type_uint32 || flags.bytes.size() != 8 || extents.type != type_int32 || label.type != type_int8)
        fail_external(path, "an array's head is damaged");
    constexpr unsigned char first_number = 6, last_number = 15, complex = 0x08;
    NumberArray array;
    array.name.assign(label.bytes.begin(), label.bytes.end());
    array.by_columns = true;
    const unsigned char kind = flags.bytes[0];
    const std::size_t axes = extents.bytes.size() / 4;
    if (kind < first_number || kind > last_number || extents.bytes.size() % 4 != 0 || axes < 2 || axes > 3) return;
    std::uint64_t count = 1;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        std::int32_t extent = 0;
        std::memcpy(&extent, &extents.bytes[4 * axis], sizeof extent);
        if (extent <= 0) return;
        array.shape.push_back(static_cast<std::size_t>(extent));
        count = std::min(count * static_cast<std::uint64_t>(extent), std::uint64_t{1} << 40);
    }
    if (!is_wanted(array.name, count, only)) return;
    const auto take = [&](Number& number, std::vector<unsigned char>& to) {
        const Element numbers = parts.next();
        if (!number_of(numbers.type, number) || numbers.bytes.size() != count * bytes_of(number))
            fail_external(path, fmt::format("its array '{}' is damaged", array.name));
        to.assign(numbers.bytes.begin(), numbers.bytes.end());
    };
    take(array.real_number, array.real);
    if ((flags.bytes[1] & complex) != 0) take(array.imaginary_number, array.imaginary);
    // Doubles may be stored as small whole numbers, but phases are then still in radians.
    array.floating = kind == first_number || kind == first_number + 1;
    arrays.push_back(std::move(array));
}

}  // namespace

std::vector<NumberArray> read_mat5(const std::filesystem::path& path, std::span<const unsigned char> bytes,
                                   std::span<const std::string> only) {
    if (bytes.size() < header_bytes || bytes[126] != 'I' || bytes[127] != 'M')
        fail_external(path, "it is not a little-endian MAT file");
    if (bytes[125] != 1) fail_external(path, fmt::format("its MAT version {} is not known", bytes[125]));
    std::vector<NumberArray> arrays;
    Elements elements(path, bytes.subspan(header_bytes));
    while (!elements.empty()) {
        const Element element = elements.next();
        if (element.type == type_array) take_array(path, element.bytes, only, arrays);
        if (element.type != type_compressed) continue;
        const std::vector<unsigned char> held = inflated(path, element.bytes);
        Elements inside(path, held);
        const Element array = inside.next();
        if (array.type == type_array) take_array(path, array.bytes, only, arrays);
    }
    return arrays;
}

}  // namespace hogel::io::arrays
