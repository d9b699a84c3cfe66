// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

#include "hogel/core/stop_scope.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/ply.h"

namespace hogel::scene::mesh_files::ply {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool ends_line(char c) { return c == '\r' || c == '\n'; }

/// Removes and returns the part of a text before the first character for which `is_end` holds. std::string_view
/// searches a character list instead, which dominates the time of parsing.
template <class IsEnd>
std::string_view take_until(std::string_view& text, const IsEnd& is_end) {
    const auto end = std::ranges::find_if(text, is_end);
    const std::string_view part = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    text.remove_prefix(part.size());
    return part;
}

double binary_number(const char* from, const Type& type, Format format) {
    std::array<char, 8> raw{};
    std::copy_n(from, type.size, raw.begin());
    if (format == Format::big_endian) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(type.size));
    const auto as = [&]<class T>(T value) {
        std::memcpy(&value, raw.data(), sizeof value);
        return static_cast<double>(value);
    };
    if (!type.is_integer) return type.size == 4 ? as(float{}) : as(double{});
    const bool is_unsigned = type.name.starts_with('u');
    if (type.size == 1) return is_unsigned ? as(std::uint8_t{}) : as(std::int8_t{});
    if (type.size == 2) return is_unsigned ? as(std::uint16_t{}) : as(std::int16_t{});
    return is_unsigned ? as(std::uint32_t{}) : as(std::int32_t{});
}

/// Returns the bytes of a row with empty lists.
std::size_t min_bytes(const Element& element) {
    std::size_t bytes = 0;
    for (const Property& property : element.properties)
        bytes += property.count ? property.count->size : property.type.size;
    return bytes;
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || status != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

std::string_view Words::next() {
    take_until(rest_, [](char c) { return !is_blank(c); });
    return take_until(rest_, is_blank);
}

void RowReader::reject_end(const Element& element, std::size_t rows) const {
    if (format_ == Format::ascii)
        reject_file(*file_, fmt::format("has {} lines of data for element '{}'", rows, element.name),
                    fmt::format("one for each of the {} that the header promises", element.count));
    reject_file(*file_, fmt::format("ends in element '{}' {} of {}", element.name, rows, element.count),
                "the data that the header promises");
}

void RowReader::check_room(const Element& element) const {
    // Rows without properties take no bytes in binary data, and a line in text.
    const std::size_t least = format_ == Format::ascii ? 1 : std::max<std::size_t>(min_bytes(element), 1);
    if (element.count > data_.size() / least) reject_end(element, format_ == Format::ascii ? 0 : data_.size() / least);
}

void RowReader::read(const Element& element, std::size_t number, Row& row) {
    constexpr std::size_t rows_between_stops = 1 << 16;
    if (number % rows_between_stops == 0) core::throw_if_stopped();
    row.values.clear();
    row.ends.clear();
    format_ == Format::ascii ? read_text(element, number, row) : read_binary(element, number, row);
}

void RowReader::skip(const Element& element) {
    check_room(element);
    const bool has_lists =
        std::ranges::any_of(element.properties, [](const Property& p) { return p.count.has_value(); });
    if (format_ != Format::ascii && !has_lists) {
        data_.remove_prefix(element.count * min_bytes(element));
        return;
    }
    Row row;
    for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) read(element, i, row);
}

void RowReader::read_text(const Element& element, std::size_t number, Row& row) {
    std::string_view line;
    do {
        take_until(data_, [](char c) { return !is_blank(c) && !ends_line(c); });
        line = take_until(data_, ends_line);
    } while (line.starts_with("comment"));
    if (line.empty()) reject_end(element, number);
    Words words(line);
    const auto reject_line = [&](const std::string& what, const char* expected) {
        reject_file(*file_, fmt::format("element '{}' {}: {}", element.name, number, what), expected);
    };
    constexpr const char* complete_line = "a line with all values that the header promises";
    const auto quoted = [](std::string_view word) { return one_line(std::string(word.substr(0, 40))); };
    for (const Property& property : element.properties) {
        std::size_t values = 1;
        if (property.count) {
            const std::string_view word = words.next();
            const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), values);
            if (status != std::errc{} || end != word.data() + word.size() || values > words.bytes_left())
                reject_line(fmt::format("list length '{}'", quoted(word)), complete_line);
        }
        for (; values > 0; --values) {
            const std::string_view word = words.next();
            if (word.empty()) reject_line("ends early", complete_line);
            const auto value = parse_number(word);
            if (!value) reject_line(fmt::format("has '{}'", quoted(word)), "a number");
            // As in binary data.
            const bool is_single = !property.type.is_integer && property.type.size == 4;
            row.values.push_back(is_single ? static_cast<double>(static_cast<float>(*value)) : *value);
        }
        row.ends.push_back(row.values.size());
    }
}

std::string_view RowReader::take(const Element& element, std::size_t number, std::size_t bytes) {
    if (bytes > data_.size()) reject_end(element, number);
    const std::string_view part = data_.substr(0, bytes);
    data_.remove_prefix(bytes);
    return part;
}

void RowReader::read_binary(const Element& element, std::size_t number, Row& row) {
    for (const Property& property : element.properties) {
        double values = 1;
        if (property.count) {
            values = binary_number(take(element, number, property.count->size).data(), *property.count, format_);
            if (!(values >= 0) || values > static_cast<double>(data_.size())) reject_end(element, number);
        }
        const std::size_t size = property.type.size;
        const std::string_view raw = take(element, number, static_cast<std::size_t>(values) * size);
        for (std::size_t offset = 0; offset < raw.size(); offset += size)
            row.values.push_back(binary_number(raw.data() + offset, property.type, format_));
        row.ends.push_back(row.values.size());
    }
}

}  // namespace hogel::scene::mesh_files::ply
