// SPDX-License-Identifier: Apache-2.0
#include "view/query.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "hogel/error.h"
#include "hogel/parameters.h"

namespace hogel::view {
namespace {

constexpr std::size_t max_query = 2048, max_words = 64, max_text = 100;
// Limits on the cost of a picture: 3840x2160 pixels with 64 pupil samples take seconds; the next request cancels it.
constexpr std::size_t max_side = 4096, max_samples = 1024, max_looks = 1024;
// Names that other parsers read from the same query.
constexpr std::string_view other_words[] = {"token", "x", "y", "what", "colour", "side", "encoding"};

using Words = std::map<std::string, std::string>;

[[noreturn]] void refuse(const std::string& name, const std::string& text, const std::string& expected) {
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not {}", name, text, expected));
}

unsigned hex_digit(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10;
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10;
    return 16;
}

std::string decode(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (c == '%') {
            const unsigned high = i + 2 < text.size() ? hex_digit(text[i + 1]) : 16;
            const unsigned low = i + 2 < text.size() ? hex_digit(text[i + 2]) : 16;
            if (high > 15 || low > 15)
                throw Error(ErrorCode::usage, "query: '%' must be followed by two hexadecimal digits");
            c = static_cast<char>(16 * high + low);
            i += 2;
        }
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            throw Error(ErrorCode::usage, "query: contains a control character");
        decoded += c;
    }
    return decoded;
}

std::size_t parse_count(const std::string& name, const std::string& text, std::size_t max) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size() || number == 0 || number > max)
        refuse(name, text.substr(0, 40), fmt::format("a whole number from 1 to {}", max));
    return number;
}

double exposure(const std::string& text) {
    if (text == "auto") return 0;
    const std::optional<double> number = parse_number(text);
    if (!number || !(*number > 0 && *number < 1e12)) refuse("exposure", text, "auto or a positive number");
    return *number;
}

constexpr std::pair<const char*, PictureMethod> methods[] = {
    {"rays", PictureMethod::rays},         {"waves", PictureMethod::waves},
    {"side", PictureMethod::side},         {"difference", PictureMethod::difference},
    {"original", PictureMethod::original}, {"error", PictureMethod::error}};

PictureMethod method_named(std::string_view text) {
    return std::ranges::find(methods, text, [](const auto& row) { return std::string_view(row.first); })->second;
}

double parse_fraction(const Words& words, const std::string& name) {
    const auto found = words.find(name);
    const std::optional<double> number = found == words.end() ? std::nullopt : parse_number(found->second);
    if (!number || !(*number >= 0 && *number <= 1))
        refuse(name, found == words.end() ? "" : found->second, "a number from 0 to 1");
    return *number;
}

// Table of the parameters of a PictureQuery, with the values that are converted afterwards.
struct PictureQueryReader {
    PictureQuery query;
    std::string by = "rays", exposure = "auto", display = "intensity";
    std::size_t quality = 90;
    Parameters table;

    PictureQueryReader() {
        query.camera.resolution = {512, 0};
        std::vector<std::string> names;
        for (const auto& row : methods) names.emplace_back(row.first);
        query.camera.declare(table);
        table.choice("--by", by, names, "", "");
        table.count("--looks", query.looks, "").range(1, max_looks);
        table.flag("--preview", query.preview, "");
        table.positive_length("--eyes", query.eyes, "");
        table.count("--pupil-samples", query.pupil_samples, "").range(1, max_samples);
        table.text("--exposure", exposure, "", "");
        table.choice("--display", display, {"intensity", "log"}, "", "");
        table.choice("--format", query.format, {"jpeg", "png", "exr"}, "", "");
        table.count("--quality", quality, "").range(1, 100);
        table.flag("--moving", query.moving, "");
        table.text("--id", query.id, "", "");
    }

    // Reads a parameter; returns false if the name is unknown.
    bool read(const std::string& name, const std::string& text) {
        Parameter* const word = table.look_up(name);
        if (word == nullptr) return false;
        with_parameter(word->keyword(), [&] { set(*word, text); });
        return true;
    }

    PictureQuery complete() {
        table.require_compatible();
        query.by = method_named(by);
        query.logarithmic = display == "log";
        query.quality = static_cast<int>(quality);
        query.id.resize(std::min<std::size_t>(query.id.size(), 40));
        return query;
    }

  private:
    void set(Parameter& word, const std::string& text) {
        const std::string& name = word.name;
        if (name != "id" && text.size() > max_text)
            refuse(name, text.substr(0, 40), fmt::format("a text of at most {} characters", max_text));
        word.read({text}, name);
        if (std::max(query.camera.resolution.columns, query.camera.resolution.rows) > max_side)
            refuse(name, text, fmt::format("at most {} pixels on a side", max_side));
        if (name == "exposure") query.exposure = hogel::view::exposure(text);
    }
};

}  // namespace

Words parse_query(std::string_view query) {
    if (query.size() > max_query)
        throw Error(ErrorCode::usage, fmt::format("query: longer than {} characters", max_query));
    Words words;
    while (!query.empty()) {
        const std::size_t end = std::min(query.find('&'), query.size());
        const std::string_view word = query.substr(0, end);
        query.remove_prefix(std::min(end + 1, query.size()));
        if (word.empty()) continue;
        const std::size_t equals = std::min(word.find('='), word.size());
        std::string name = decode(word.substr(0, equals));
        std::string value = equals < word.size() ? decode(word.substr(equals + 1)) : "";
        if (!words.emplace(name, std::move(value)).second)
            throw Error(ErrorCode::usage, fmt::format("query: '{}' occurs twice", name.substr(0, 40)));
        if (words.size() > max_words) throw Error(ErrorCode::usage, "query: too many parameters");
    }
    return words;
}

PictureQuery parse_picture_query(const Words& words) {
    PictureQueryReader query;
    for (const auto& word : words) {
        const std::string& name = word.first;
        if (!query.read(name, word.second) && !std::ranges::count(other_words, name))
            throw Error(ErrorCode::usage, fmt::format("query: '{}' is unknown", name.substr(0, 40)));
    }
    return query.complete();
}

PictureQuery query_of_eye(PictureQuery query, int side) {
    query.camera.eye.x += 0.5 * side * query.eyes;
    query.eyes = 0;
    return query;
}

PickPoint parse_pick_point(const Words& words) { return {parse_fraction(words, "x"), parse_fraction(words, "y")}; }

InsideQuery parse_inside(const Words& words) {
    constexpr std::size_t max_inside = 1024, max_colours = 3;
    InsideQuery inside;
    for (const auto& [name, text] : words) {
        if (name == "what") inside.what = text.substr(0, 40);
        if (name == "colour") inside.colour = parse_count(name, text, max_colours) - 1;
        if (name == "side") inside.side = parse_count(name, text, max_inside);
    }
    return inside;
}

}  // namespace hogel::view
