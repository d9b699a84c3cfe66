// SPDX-License-Identifier: Apache-2.0
// MAT files of version 5 (MATLAB 5 to 7.2, the version that most programs write). A header of 128 bytes is followed by
// elements: type, length and data, padded to eight bytes. An array is an element of elements: flags, extents, name,
// real parts, imaginary parts. Version 7 compresses whole arrays with zlib.
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
    std::uint32_t number(std::size_t offset) const {
        std::uint32_t value;
        std::memcpy(&value, &rest_[offset], sizeof value);
        return value;
    }

    const std::filesystem::path& path_;
    std::span<const unsigned char> rest_;
};

// Inflates a compressed array, or its first `most` bytes.
std::vector<unsigned char> inflated(const std::filesystem::path& path, std::span<const unsigned char> compressed,
                                    std::size_t most = ~std::size_t{0}) {
    const auto fill = [&](std::span<unsigned char> bytes) {
        if (!inflate(path, compressed, bytes, Extent::first)) fail_external(path, "a compressed array is damaged");
    };
    // The array's own header states its length.
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
    for (const auto& [code, known_type] : types)
        if (code == type) {
            number = known_type;
            return true;
        }
    return false;
}

// Array classes by their number in the flags: 6 double, 7 single, 8 to 15 integers.
constexpr Number classes[] = {Number::real,   Number::single, Number::int8,   Number::uint8, Number::int16,
                              Number::uint16, Number::int32,  Number::uint32, Number::int64, Number::uint64};
constexpr unsigned char first_number = 6, last_number = 15, complex_flag = 0x08;

constexpr std::size_t max_head = 1024;  // bytes, sufficient for the head of an array

// Reads the head of an array. Returns nothing if it is empty or not numeric.
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
        // An element has at most 2³² bytes, and the product with another extent fits 64 bits.
        head.count = std::min(head.count * static_cast<std::uint64_t>(extent), std::uint64_t{1} << 32);
    }
    head.complex = (flags.bytes[1] & complex_flag) != 0;
    head.number_class = classes[kind - first_number];
    // Doubles may be stored as small integers, but phases are still in radians.
    head.floating = kind == first_number || kind == first_number + 1;
    return head;
}

struct Selection {
    std::span<const std::string> only;
    std::size_t max_axes = field_axes;
    Reads reads = Reads::all;
};

// Returns the head of a selected array. The type is that of the class; numbers may be stored smaller.
std::optional<NumberArray> wanted_head(const std::filesystem::path& path, Elements& parts, const Selection& selection) {
    std::optional<NumberArray> head = read_head(path, parts);
    if (!head || head->shape.size() > selection.max_axes || !is_wanted(head->name, head->samples(), selection.only))
        return {};
    head->real_number = head->imaginary_number = head->number_class;
    return head;
}

std::span<const unsigned char> take_numbers(const std::filesystem::path& path, Elements& parts,
                                            const NumberArray& array, Number& number) {
    const Element numbers = parts.next();
    if (!number_of(numbers.type, number) || numbers.bytes.size() != array.samples() * bytes_of(number))
        fail_external(path, fmt::format("its array '{}' is damaged", array.name));
    return numbers.bytes;
}

void take_array(const std::filesystem::path& path, std::span<const unsigned char> bytes, const Selection& selection,
                std::vector<NumberArray>& arrays) {
    Elements parts(path, bytes);
    std::optional<NumberArray> array = wanted_head(path, parts, selection);
    if (!array) return;
    if (has_numbers(array->samples(), selection.reads)) {
        const auto take = [&](Number& number, std::vector<unsigned char>& to) {
            const std::span<const unsigned char> numbers = take_numbers(path, parts, *array, number);
            to.assign(numbers.begin(), numbers.end());
        };
        take(array->real_number, array->real);
        if (array->complex) take(array->imaginary_number, array->imaginary);
    }
    arrays.push_back(std::move(*array));
}

// As take_array(), but inflates only arrays whose numbers are read, and reuses the buffer of a real one.
void take_compressed(const std::filesystem::path& path, std::span<const unsigned char> compressed,
                     const Selection& selection, std::vector<NumberArray>& arrays) {
    constexpr std::size_t tag = 8;
    const std::vector<unsigned char> start = inflated(path, compressed, max_head);
    std::uint32_t type = 0;
    std::memcpy(&type, start.data(), sizeof type);
    if (type != type_array) return;
    Elements beginning(path, std::span(start).subspan(tag));
    std::optional<NumberArray> array = wanted_head(path, beginning, selection);
    if (!array) return;
    if (!has_numbers(array->samples(), selection.reads)) return arrays.push_back(std::move(*array));
    std::vector<unsigned char> inflated_bytes = inflated(path, compressed);
    if (array->complex) return take_array(path, std::span(inflated_bytes).subspan(tag), selection, arrays);
    Elements parts(path, std::span(inflated_bytes).subspan(tag));
    wanted_head(path, parts, selection);
    const std::span<const unsigned char> numbers = take_numbers(path, parts, *array, array->real_number);
    const auto first = inflated_bytes.begin() + (numbers.data() - inflated_bytes.data());
    inflated_bytes.erase(first + static_cast<std::ptrdiff_t>(numbers.size()), inflated_bytes.end());
    inflated_bytes.erase(inflated_bytes.begin(), first);
    array->real = std::move(inflated_bytes);
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
    const Selection selection{only, max_axes, reads};
    require_version_5(path, bytes);
    std::vector<NumberArray> arrays;
    Elements elements(path, bytes.subspan(header_bytes));
    while (!elements.empty()) {
        const Element element = elements.next();
        if (element.type == type_array) take_array(path, element.bytes, selection, arrays);
        if (element.type == type_compressed) take_compressed(path, element.bytes, selection, arrays);
    }
    return arrays;
}

std::vector<NumberArray> mat5_heads(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    const std::uint64_t end = file.size();
    const auto bytes_at = [&](std::uint64_t offset, std::uint64_t count) {
        std::vector<unsigned char> bytes(static_cast<std::size_t>(std::min(count, end - offset)));
        file.read(offset, bytes.data(), bytes.size());
        return bytes;
    };
    require_version_5(path, bytes_at(0, header_bytes));
    constexpr std::size_t packed_bytes = 8192;  // sufficient for the head of an array
    std::vector<NumberArray> arrays;
    for (std::uint64_t offset = header_bytes; offset + 8 <= end;) {
        std::uint32_t tag[2];
        file.read(offset, tag, sizeof tag);
        const std::uint64_t size = tag[1];
        std::vector<unsigned char> start;
        if (tag[0] == type_array) start = bytes_at(offset + 8, std::min<std::uint64_t>(size, max_head));
        if (tag[0] == type_compressed) {
            start = inflated(path, bytes_at(offset + 8, std::min<std::uint64_t>(size, packed_bytes)), max_head);
            std::uint32_t type = 0;
            std::memcpy(&type, start.data(), sizeof type);
            start.erase(start.begin(), start.begin() + (type == type_array ? 8 : static_cast<long>(start.size())));
        }
        if (!start.empty()) {
            Elements parts(path, start);
            if (std::optional<NumberArray> head = read_head(path, parts)) arrays.push_back(std::move(*head));
        }
        offset += tag[0] >> 16 != 0 ? 8 : 8 + (tag[0] == type_compressed ? size : (size + 7) / 8 * 8);
    }
    return arrays;
}

}  // namespace hogel::io::arrays
