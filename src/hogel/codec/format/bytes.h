// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/core/checksum.h"
#include "hogel/error.h"

namespace hogel::codec::format {

// Writes the numbers and texts of a stream. Numbers are little-endian; a text is its length in 32 bits, then its bytes.
class ByteWriter {
  public:
    template <std::unsigned_integral T>
    void put(T value) {
        for (std::size_t i = 0; i < sizeof(T); ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
    void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
    void put(float value) { put(std::bit_cast<std::uint32_t>(value)); }
    void put(std::span<const std::uint8_t> more) { bytes.insert(bytes.end(), more.begin(), more.end()); }
    void put(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size()));
        bytes.insert(bytes.end(), text.begin(), text.end());
    }

    std::vector<std::uint8_t> bytes;
};

// Reads the output of ByteWriter. Throws Error(bad_input), with a message that begins with `what`, if the bytes end too
// early.
class ByteReader {
  public:
    ByteReader(std::span<const std::uint8_t> bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}

    template <std::unsigned_integral T>
    T take() {
        T value = 0;
        const std::span<const std::uint8_t> part = take(sizeof(T));
        for (std::size_t i = 0; i < sizeof(T); ++i) value = static_cast<T>(value | (std::uint64_t{part[i]} << (8 * i)));
        return value;
    }
    double take_double() { return std::bit_cast<double>(take<std::uint64_t>()); }
    float take_float() { return std::bit_cast<float>(take<std::uint32_t>()); }
    std::string take_text() {
        const std::span<const std::uint8_t> part = take(take<std::uint32_t>());
        return {part.begin(), part.end()};
    }
    std::span<const std::uint8_t> take(std::size_t count) {
        if (count > bytes_.size()) damaged("it ends too early");
        const std::span<const std::uint8_t> part = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return part;
    }
    ByteReader take_part(std::size_t count) { return {take(count), what_}; }
    std::size_t left() const { return bytes_.size(); }
    [[noreturn]] void damaged(const std::string& why) const { throw Error(ErrorCode::bad_input, what_ + ": " + why); }

  private:
    std::span<const std::uint8_t> bytes_;
    std::string what_;
};

}  // namespace hogel::codec::format
