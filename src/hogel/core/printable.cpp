// SPDX-License-Identifier: Apache-2.0
#include "hogel/printable.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace hogel {
namespace {

constexpr std::size_t letters_per_end = 200;
constexpr char32_t damaged = 0xFFFFFFFF;

struct Letter {
    char32_t code;      // `damaged` for a byte that is not valid UTF-8
    std::size_t bytes;  // length
};

// Returns the first letter of a nonempty text.
Letter first_letter(std::string_view text) {
    const unsigned first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return {first, 1};
    const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return {damaged, 1};
    char32_t code = first & (0xFFu >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        const unsigned next = static_cast<unsigned char>(text[i]);
        if ((next & 0xC0) != 0x80) return {damaged, 1};
        code = code << 6 | (next & 0x3F);
    }
    constexpr std::array<char32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    return code < smallest[bytes] || code > 0x10FFFF || surrogate ? Letter{damaged, 1} : Letter{code, bytes};
}

bool is_shown(char32_t code) {
    // Hides control characters, line separators, direction marks, annotations and tags.
    constexpr std::array<std::pair<char32_t, char32_t>, 10> hidden{{{0, 0x1F},
                                                                    {0x7F, 0x9F},
                                                                    {0x61C, 0x61C},
                                                                    {0x200E, 0x200F},
                                                                    {0x2028, 0x202E},
                                                                    {0x2066, 0x2069},
                                                                    {0xFEFF, 0xFEFF},
                                                                    {0xFFF9, 0xFFFB},
                                                                    {0xE0000, 0xE007F},
                                                                    {damaged, damaged}}};
    return std::ranges::none_of(hidden,
                                [code](const auto& range) { return code >= range.first && code <= range.second; });
}

}  // namespace

std::string printable(std::string_view text) {
    std::string line;
    std::vector<std::size_t> offsets;  // offset of each letter in `line`
    while (!text.empty()) {
        const auto [code, bytes] = first_letter(text);
        offsets.push_back(line.size());
        if (code == '\n' || code == '\t' || code == '\r')
            line += ' ';
        else if (is_shown(code))
            line += text.substr(0, bytes);
        else
            line += '?';
        text.remove_prefix(bytes);
    }
    if (offsets.size() <= 2 * letters_per_end) return line;
    return line.substr(0, offsets[letters_per_end]) + "..." + line.substr(offsets[offsets.size() - letters_per_end]);
}

}  // namespace hogel
