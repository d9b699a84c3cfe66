// SPDX-License-Identifier: Apache-2.0
// MAT files of version 5: see mat5.cpp.
#include "hogel/io/arrays/mat_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string_view>

#include "hogel/error.h"
#include "hogel/io/arrays/mat5_types.h"

namespace hogel::io::arrays {
namespace {

constexpr unsigned char class_text = 4, class_double = 6, class_single = 7, class_uint8 = 9, class_uint16 = 11;

template <class T>
std::span<const unsigned char> bytes_of_values(std::span<const T> values) {
    return {reinterpret_cast<const unsigned char*>(values.data()), values.size_bytes()};
}

}  // namespace

MatWriter::MatWriter(const std::filesystem::path& path) : path_(path), bytes_(128, ' ') {
    constexpr std::string_view text = "MATLAB 5.0 MAT-file, written by hogel", end{"\0\1IM", 4};
    std::memcpy(bytes_.data(), text.data(), text.size());
    std::memset(&bytes_[116], 0, 8);  // no subsystem data
    std::memcpy(&bytes_[124], end.data(), end.size());
}

void MatWriter::element(unsigned type, std::span<const unsigned char> data) {
    const std::uint32_t head[2] = {type, static_cast<std::uint32_t>(data.size())};
    const auto* const first = reinterpret_cast<const unsigned char*>(head);
    bytes_.insert(bytes_.end(), first, first + sizeof head);
    bytes_.insert(bytes_.end(), data.begin(), data.end());
    bytes_.resize((bytes_.size() + 7) / 8 * 8, 0);
}

std::size_t MatWriter::begin_array(const std::string& name, unsigned char kind, bool complex,
                                   std::span<const std::size_t> shape) {
    const std::size_t begin = bytes_.size();
    element(type_array, {});
    const std::uint32_t flags[2] = {kind + (complex ? 0x0800u : 0u), 0};
    element(type_uint32, bytes_of_values(std::span<const std::uint32_t>(flags)));
    std::vector<std::int32_t> extents;
    for (const std::size_t extent : shape) {
        if (extent > 0x7fffffff)
            throw Error(ErrorCode::usage,
                        fmt::format("'{}' cannot hold {} numbers on an axis", path_.string(), extent));
        extents.push_back(static_cast<std::int32_t>(extent));
    }
    element(type_int32, bytes_of_values(std::span<const std::int32_t>(extents)));
    element(type_int8, {reinterpret_cast<const unsigned char*>(name.data()), name.size()});
    return begin;
}

void MatWriter::end_array(std::size_t begin) {
    const auto size = static_cast<std::uint32_t>(bytes_.size() - begin - 8);
    std::memcpy(&bytes_[begin + 4], &size, sizeof size);
}

void MatWriter::numbers(const std::string& name, std::span<const double> values) {
    const std::size_t shape[2] = {1, values.size()};
    const std::size_t begin = begin_array(name, class_double, false, shape);
    element(type_double, bytes_of_values(values));
    end_array(begin);
}

void MatWriter::text(const std::string& name, const std::string& value) {
    const std::size_t shape[2] = {1, value.size()};
    const std::size_t begin = begin_array(name, class_text, false, shape);
    std::vector<std::uint16_t> letters;
    for (const char letter : value) letters.push_back(static_cast<unsigned char>(letter));
    element(type_uint16, bytes_of_values(std::span<const std::uint16_t>(letters)));
    end_array(begin);
}

void MatWriter::require_size(std::uint64_t bytes) const {
    constexpr std::uint64_t most = std::uint64_t{1} << 31;  // bytes of an array
    if (bytes > most - 4096)
        throw Error(
            ErrorCode::usage,
            fmt::format("'{}': an array of {} bytes was asked for, but MAT files of version 5 hold at most 2 GiB",
                        path_.string(), bytes));
}

void MatWriter::array(const std::string& name, std::span<const std::size_t> shape, std::span<const float> real,
                      std::span<const float> imaginary) {
    require_size(real.size_bytes() + imaginary.size_bytes());
    const std::size_t begin = begin_array(name, class_single, !imaginary.empty(), shape);
    bytes_.reserve(bytes_.size() + real.size_bytes() + imaginary.size_bytes() + 64);
    element(type_single, bytes_of_values(real));
    if (!imaginary.empty()) element(type_single, bytes_of_values(imaginary));
    end_array(begin);
}

void MatWriter::begin_numbers(const std::string& name, std::span<const std::size_t> shape, Number number) {
    struct Code {
        Number number;
        unsigned type;
        unsigned char kind;
    };
    static constexpr Code codes[] = {{Number::uint8, type_uint8, class_uint8},
                                     {Number::uint16, type_uint16, class_uint16},
                                     {Number::single, type_single, class_single},
                                     {Number::real, type_double, class_double}};
    const auto* const code = std::ranges::find(codes, number, &Code::number);
    if (code == std::end(codes)) throw Error(ErrorCode::internal, "a number that MAT files are not written with");
    std::uint64_t bytes = bytes_of(number);
    for (const std::size_t extent : shape) {
        bytes *= extent;
        require_size(bytes);
    }
    const std::size_t begin = begin_array(name, code->kind, false, shape);
    element(code->type, {});
    const auto size = static_cast<std::uint32_t>(bytes),
               all = static_cast<std::uint32_t>(bytes_.size() - begin - 8 + (bytes + 7) / 8 * 8);
    std::memcpy(&bytes_[bytes_.size() - 4], &size, sizeof size);
    std::memcpy(&bytes_[begin + 4], &all, sizeof all);
}

}  // namespace hogel::io::arrays
