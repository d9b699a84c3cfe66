// SPDX-License-Identifier: Apache-2.0
// The object headers of HDF5 files with superblock version 0 or 1 (HDF5 file format specification 3.0, IV.A).
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hogel/io/arrays/hdf5_v0.h"

namespace hogel::io::arrays {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::uint64_t undefined = ~std::uint64_t{0};
constexpr std::size_t max_rank = 32;
constexpr std::size_t max_blocks = 1024;  // no valid header has as many; blocks of a damaged one may be circular

std::vector<std::uint64_t> extents(const Hdf5V0& file, std::span<const unsigned char> message) {
    ByteCursor rest(file, message);
    const std::uint64_t version = rest.number(1), rank = rest.number(1);
    if ((version != 1 && version != 2) || rank > max_rank) file.fail("an array's extents are damaged");
    rest.skip(version == 1 ? 6 : 2);
    std::vector<std::uint64_t> shape;
    for (std::uint64_t axis = 0; axis < rank; ++axis) shape.push_back(rest.number(8));
    return shape;
}

std::optional<Number> plain_number(std::uint64_t kind, std::uint64_t bits, std::uint64_t size, ByteCursor properties) {
    constexpr std::uint64_t whole = 0, floating = 1, big_endian = 0x41, with_sign = 0x08;
    if ((bits & big_endian) != 0) return {};
    const std::uint64_t offset = properties.number(2), precision = properties.number(2);
    if (offset != 0 || precision != 8 * size) return {};
    if (kind == floating) {
        const std::uint64_t exponent = properties.number(4) >> 8 & 0xff;
        if (size == 4 && exponent == 8) return Number::single;
        if (size == 8 && exponent == 11) return Number::real;
        return {};
    }
    if (kind != whole) return {};
    const bool sign = (bits & with_sign) != 0;
    switch (size) {
        case 1:
            return sign ? Number::int8 : Number::uint8;
        case 2:
            return sign ? Number::int16 : Number::uint16;
        case 4:
            return sign ? Number::int32 : Number::uint32;
        case 8:
            return sign ? Number::int64 : Number::uint64;
        default:
            return {};
    }
}

struct Type {
    std::uint64_t kind = 0, bits = 0, size = 0, version = 0;
};

Type type_head(ByteCursor& rest) {
    Type type;
    const std::uint64_t head = rest.number(1);
    type.kind = head & 15;
    type.version = head >> 4;
    type.bits = rest.number(3);
    type.size = rest.number(4);
    return type;
}

// Reads the type of the elements, a number or a compound of numbers (IV.A.2.d); any other type gives no members.
void take_type(const Hdf5V0& file, const Bytes& message, Hdf5V0Dataset& dataset) {
    constexpr std::uint64_t compound = 6;
    ByteCursor rest(file, message);
    const Type type = type_head(rest);
    dataset.element_bytes = type.size;
    if (type.kind != compound) {
        const auto number = type.kind <= 1 ? plain_number(type.kind, type.bits, type.size, rest) : std::nullopt;
        if (number) dataset.members.push_back({"", *number, 0});
        return;
    }
    if (type.version < 1 || type.version > 3) return;
    std::vector<Hdf5V0Dataset::Member> members;
    for (std::uint64_t i = 0; i < (type.bits & 0xffff); ++i) {
        Hdf5V0Dataset::Member member;
        const std::size_t begin = rest.taken();
        member.name = rest.text();
        if (type.version < 3) rest.skip((8 - (rest.taken() - begin) % 8) % 8);
        std::size_t width = 4;
        if (type.version == 3) width = type.size < 256 ? 1 : type.size < 65536 ? 2 : type.size < 16777216 ? 3 : 4;
        member.offset = rest.number(width);
        if (type.version == 1) rest.skip(28);  // dimensions of members that are arrays
        const Type own = type_head(rest);
        if (own.kind > 1) return;
        const auto number = plain_number(own.kind, own.bits, own.size, rest);
        if (!number) return;
        rest.skip(own.kind == 0 ? 4 : 12);
        member.number = *number;
        if (member.offset > type.size || bytes_of(*number) > type.size - member.offset)
            file.fail("a type of compound numbers is damaged");
        members.push_back(std::move(member));
    }
    dataset.members = std::move(members);
}

void take_layout(const Hdf5V0& file, const Bytes& message, Hdf5V0Dataset& dataset) {
    ByteCursor rest(file, message);
    if (rest.number(1) != 3) return;  // not supported; Hdf5V0::read() refuses it
    const auto address = [&]() -> std::optional<std::uint64_t> {
        const std::uint64_t at = rest.number(8);
        return at == undefined ? std::nullopt : std::optional(at);
    };
    switch (rest.number(1)) {
        case 0: {
            dataset.layout = Hdf5V0Dataset::Layout::compact;
            const auto held = rest.take(rest.number(2));
            dataset.compact.assign(held.begin(), held.end());
            break;
        }
        case 1:
            dataset.layout = Hdf5V0Dataset::Layout::contiguous;
            dataset.address = address();
            dataset.bytes = rest.number(8);
            break;
        case 2: {
            dataset.layout = Hdf5V0Dataset::Layout::chunked;
            const std::uint64_t axes = rest.number(1);  // the axes of the array, plus one for the bytes of an element
            if (axes < 2 || axes > max_rank + 1) file.fail("an array's layout is damaged");
            dataset.address = address();
            for (std::uint64_t axis = 0; axis + 1 < axes; ++axis) dataset.chunk.push_back(rest.number(4));
            break;
        }
        default:
            break;
    }
}

void take_filters(const Hdf5V0& file, const Bytes& message, Hdf5V0Dataset& dataset) {
    ByteCursor rest(file, message);
    const std::uint64_t version = rest.number(1), count = rest.number(1);
    if (version != 1 && version != 2) file.fail("an array's filters are damaged");
    if (version == 1) rest.skip(6);
    for (std::uint64_t i = 0; i < count; ++i) {
        Hdf5V0Dataset::Filter filter;
        filter.id = rest.number(2);
        const std::uint64_t name_bytes = version == 1 || filter.id >= 256 ? rest.number(2) : 0;
        rest.skip(2);
        const std::uint64_t values = rest.number(2);
        const auto name = rest.take(version == 1 ? (name_bytes + 7) / 8 * 8 : name_bytes);
        filter.name.assign(name.begin(), std::find(name.begin(), name.end(), 0));
        rest.skip(4 * (values + (version == 1 ? values % 2 : 0)));
        dataset.filters.push_back(std::move(filter));
    }
}

void take_attribute(const Hdf5V0& file, const Bytes& message, Hdf5V0Dataset& dataset) {
    ByteCursor rest(file, message);
    const std::uint64_t version = rest.number(1), flags = rest.number(1);
    if (version < 1 || version > 3 || (version > 1 && flags != 0)) return;
    const std::uint64_t name_bytes = rest.number(2), type_bytes = rest.number(2), space_bytes = rest.number(2);
    if (version == 3) rest.skip(1);
    const auto part = [&](std::uint64_t bytes) {
        const auto held = rest.take(bytes);
        if (version == 1) rest.skip((8 - bytes % 8) % 8);
        return held;
    };
    const auto name = part(name_bytes), kind = part(type_bytes);
    part(space_bytes);
    ByteCursor of_type(file, kind);
    const Type type = type_head(of_type);
    constexpr std::uint64_t text = 3;
    if (type.kind != text) return;
    const auto value = rest.take(std::min<std::size_t>(type.size, rest.left()));
    dataset.texts[std::string(name.begin(), std::find(name.begin(), name.end(), 0))] =
        std::string(value.begin(), std::find(value.begin(), value.end(), 0));
}

}  // namespace

// Object headers of version 1 (IV.A.1.a).
void for_each_hdf5_v0_message(
    const Hdf5V0& file, std::uint64_t address,
    const std::function<void(std::uint64_t type, std::uint64_t flags, const Bytes& message)>& use) {
    const Bytes prefix = file.at(address, 16);
    if (prefix[0] != 1) file.fail("an object's header is damaged or of a later version");
    ByteCursor head(file, prefix);
    head.skip(8);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> blocks{{address + 16, head.number(4)}};
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Bytes block = file.at(blocks[i].first, blocks[i].second);
        ByteCursor rest(file, block);
        while (rest.left() >= 8) {
            const std::uint64_t type = rest.number(2), size = rest.number(2), flags = rest.number(1);
            rest.skip(3);
            const std::span<const unsigned char> held = rest.take(size);
            const Bytes message(held.begin(), held.end());
            constexpr std::uint64_t continuation = 0x10;
            if (type != continuation) {
                use(type, flags, message);
                continue;
            }
            ByteCursor more(file, message);
            const std::uint64_t offset = more.number(8);
            blocks.emplace_back(offset, more.number(8));
            if (blocks.size() > max_blocks) file.fail("an object's header is damaged");
        }
    }
}

Hdf5V0Dataset hdf5_v0_dataset(const Hdf5V0& file, const std::string& name, std::uint64_t header) {
    Hdf5V0Dataset dataset;
    dataset.name = name;
    for_each_hdf5_v0_message(file, header, [&](std::uint64_t type, std::uint64_t flags, const Bytes& message) {
        constexpr std::uint64_t shared = 2;
        if ((flags & shared) != 0) return;  // stored elsewhere, which is not supported
        if (type == 0x1) dataset.shape = extents(file, message);
        if (type == 0x3) take_type(file, message, dataset);
        if (type == 0x8) take_layout(file, message, dataset);
        if (type == 0xb) take_filters(file, message, dataset);
        if (type == 0xc) take_attribute(file, message, dataset);
    });
    return dataset;
}

}  // namespace hogel::io::arrays
