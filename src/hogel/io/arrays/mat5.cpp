// SPDX-License-Identifier: Apache-2.0
// MAT files of version 5 (MATLAB 5 to 7.2, and the version that most programs write): a header of 128 bytes, then
// elements, each a type, a length and that number of bytes, padded to eight. An array is an element that contains
// elements: flags, extents, name, real parts, imaginary parts. Version 7 compresses whole arrays with zlib.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "hogel/core/raw_file.h"
#include "hogel/io/arrays/inflate.h"
#include "hogel/io/arrays/mat.h"
#include "hogel/io/arrays/mat5_types.h"

namespace hogel::io::arrays {
namespace {

constexpr std::size_t header_bytes = 128;

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

// The array that is compressed, or its first `most` bytes.
std::vector<unsigned char> inflated(const std::filesystem::path& path, std::span<const unsigned char> compressed,
                                    std::size_t most = ~std::size_t{0}) {
    const auto fill = [&](std::span<unsigned char> bytes) {
        if (!inflate(path, compressed, bytes, Extent::first)) fail_external(path, "a compressed array is damaged");
    };
    // The header of the array inside gives its length.
    std::vector<unsigned char> bytes(8);
    fill(bytes);
    std::uint32_t size = 0;
    std::memcpy(&size, &bytes[4], sizeof size);
    if (std::min<std::size_t>(size, most) / max_expansion > compressed.size())
        fail_external(path, "a compressed array is damaged");
    bytes.resize(std::min(8 + std::size_t{size}, most));
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

// The class of an array by its number in the flags: 6 double, 7 single, 8 to 15 whole numbers.
constexpr Number classes[] = {Number::real,   Number::single, Number::int8,   Number::uint8, Number::int16,
                              Number::uint16, Number::int32,  Number::uint32, Number::int64, Number::uint64};
constexpr unsigned char first_number = 6, last_number = 15, complex_flag = 0x08;

constexpr std::size_t max_head = 1024;  // bytes that hold the head of an array

// Reads what stands before the numbers of an array; nothing for one that is not numeric, or that is empty.
std::optional<NumberArray> read_head(const std::filesystem::path& path, Elements& parts) {
    const Element flags = parts.next(), extents = parts.next(), label = parts.next();
    if (flags.type != type_uint32 || flags.bytes.size() != 8 || extents.type != type_int32 || label.type != type_int8)
        fail_external(path, "an array's head is damaged");
    NumberArray head;
    head.name.assign(label.bytes.begin(), label.bytes.end());
    head.by_columns = true;
    const unsigned char kind = flags.bytes[0];
    const std::size_t axes = extents.bytes.size() / 4;
    if (kind < first_number || kind > last_number || extents.bytes.size() % 4 != 0 || axes < 2) return {};
    head.count = 1;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        std::int32_t extent = 0;
        std::memcpy(&extent, &extents.bytes[4 * axis], sizeof extent);
        if (extent <= 0) return {};
        head.shape.push_back(static_cast<std::size_t>(extent));
        // No element has more than 2³² bytes, and no product with another extent exceeds 64 bits.
        head.count = std::min(head.count * static_cast<std::uint64_t>(extent), std::uint64_t{1} << 32);
    }
    head.complex = (flags.bytes[1] & complex_flag) != 0;
    head.number_class = classes[kind - first_number];
    // Doubles may be stored as small whole numbers, but phases are then still in radians.
    head.floating = kind == first_number || kind == first_number + 1;
    return head;
}

// What to take of the arrays of a file.
struct Wanted {
    std::span<const std::string> only;
    std::size_t max_axes = field_axes;
    Reads reads = Reads::all;
};

// The head of an array, without its numbers, if it is numeric, has two axes to `max_axes`, and is wanted. Where numbers
// are not read, their type is that of the head: it may be stored as a smaller one.
std::optional<NumberArray> wanted_head(const std::filesystem::path& path, Elements& parts, const Wanted& wanted) {
    std::optional<NumberArray> head = read_head(path, parts);
    if (!head || head->shape.size() > wanted.max_axes || !is_wanted(head->name, head->samples(), wanted.only))
        return {};
    head->real_number = head->imaginary_number = head->number_class;
    return head;
}

// The numbers that follow in `parts`.
std::span<const unsigned char> take_numbers(const std::filesystem::path& path, Elements& parts,
                                            const NumberArray& array, Number& number) {
    const Element numbers = parts.next();
    if (!number_of(numbers.type, number) || numbers.bytes.size() != array.samples() * bytes_of(number))
        fail_external(path, fmt::format("its array '{}' is damaged", array.name));
    return numbers.bytes;
}

// Appends an array that is wanted.
void take_array(const std::filesystem::path& path, std::span<const unsigned char> bytes, const Wanted& wanted,
                std::vector<NumberArray>& arrays) {
    Elements parts(path, bytes);
    std::optional<NumberArray> array = wanted_head(path, parts, wanted);
    if (!array) return;
    if (has_numbers(array->samples(), wanted.reads)) {
        const auto take = [&](Number& number, std::vector<unsigned char>& to) {
            const std::span<const unsigned char> numbers = take_numbers(path, parts, *array, number);
            to.assign(numbers.begin(), numbers.end());
        };
        take(array->real_number, array->real);
        if (array->complex) take(array->imaginary_number, array->imaginary);
    }
    arrays.push_back(std::move(*array));
}

// The same of an array that is compressed. It is inflated once, and only if its numbers are read; those of a real array
// stay where they were inflated.
void take_compressed(const std::filesystem::path& path, std::span<const unsigned char> compressed, const Wanted& wanted,
                     std::vector<NumberArray>& arrays) {
    constexpr std::size_t tag = 8;
    const std::vector<unsigned char> start = inflated(path, compressed, max_head);
    std::uint32_t type = 0;
    std::memcpy(&type, start.data(), sizeof type);
    if (type != type_array) return;
    Elements beginning(path, std::span(start).subspan(tag));
    std::optional<NumberArray> array = wanted_head(path, beginning, wanted);
    if (!array) return;
    if (!has_numbers(array->samples(), wanted.reads)) return arrays.push_back(std::move(*array));
    std::vector<unsigned char> held = inflated(path, compressed);
    if (array->complex) return take_array(path, std::span(held).subspan(tag), wanted, arrays);
    Elements parts(path, std::span(held).subspan(tag));
    wanted_head(path, parts, wanted);
    const std::span<const unsigned char> numbers = take_numbers(path, parts, *array, array->real_number);
    const auto first = held.begin() + (numbers.data() - held.data());
    held.erase(first + static_cast<std::ptrdiff_t>(numbers.size()), held.end());
    held.erase(held.begin(), first);
    array->real = std::move(held);
    arrays.push_back(std::move(*array));
}

void require_version_5(const std::filesystem::path& path, std::span<const unsigned char> header) {
    if (header.size() < header_bytes || header[126] != 'I' || header[127] != 'M')
        fail_external(path, "it is not a little-endian MAT file");
    if (header[125] != 1) fail_external(path, fmt::format("its MAT version {} is not known", header[125]));
}

}  // namespace

std::vector<NumberArray> read_mat5(const std::filesystem::path& path, std::span<const unsigned char> bytes,
                                   std::span<const std::string> only, std::size_t max_axes, Reads reads) {
    const Wanted wanted{only, max_axes, reads};
    require_version_5(path, bytes);
    std::vector<NumberArray> arrays;
    Elements elements(path, bytes.subspan(header_bytes));
    while (!elements.empty()) {
        const Element element = elements.next();
        if (element.type == type_array) take_array(path, element.bytes, wanted, arrays);
        if (element.type == type_compressed) take_compressed(path, element.bytes, wanted, arrays);
    }
    return arrays;
}

std::vector<NumberArray> mat5_heads(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    const std::uint64_t end = file.size();
    const auto bytes_at = [&](std::uint64_t at, std::uint64_t count) {
        std::vector<unsigned char> bytes(static_cast<std::size_t>(std::min(count, end - at)));
        file.read(at, bytes.data(), bytes.size());
        return bytes;
    };
    require_version_5(path, bytes_at(0, header_bytes));
    constexpr std::size_t packed_bytes = 8192;  // enough for the head of an array
    std::vector<NumberArray> arrays;
    for (std::uint64_t at = header_bytes; at + 8 <= end;) {
        std::uint32_t tag[2];
        file.read(at, tag, sizeof tag);
        const std::uint64_t size = tag[1];
        std::vector<unsigned char> start;
        if (tag[0] == type_array) start = bytes_at(at + 8, std::min<std::uint64_t>(size, max_head));
        if (tag[0] == type_compressed) {
            start = inflated(path, bytes_at(at + 8, std::min<std::uint64_t>(size, packed_bytes)), max_head);
            std::uint32_t type = 0;
            std::memcpy(&type, start.data(), sizeof type);
            start.erase(start.begin(), start.begin() + (type == type_array ? 8 : static_cast<long>(start.size())));
        }
        if (!start.empty()) {
            Elements parts(path, start);
            if (std::optional<NumberArray> head = read_head(path, parts)) arrays.push_back(std::move(*head));
        }
        at += tag[0] >> 16 != 0 ? 8 : 8 + (tag[0] == type_compressed ? size : (size + 7) / 8 * 8);
    }
    return arrays;
}

}  // namespace hogel::io::arrays
