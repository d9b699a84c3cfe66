// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/obj.h"

#include <string_view>

namespace hogel::scene::mesh_files {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the next number begins with its point, from a place on; npos: nowhere.
std::size_t find_bare_point(std::string_view text, std::size_t from) {
    for (std::size_t at = from; (at = text.find('.', at)) != text.npos; ++at) {
        std::size_t before = at;
        if (before > 0 && (text[before - 1] == '-' || text[before - 1] == '+')) --before;
        if (before == 0 || !is_space(text[before - 1]) || at + 1 == text.size() || !is_digit(text[at + 1])) continue;
        const std::size_t line = text.rfind('\n', at) + 1;  // 0 if there is no line before
        const std::size_t word = text.find_first_not_of(" \t", line);
        if (text[word] == 'v') return at;
    }
    return text.npos;
}

}  // namespace

std::string with_leading_zeros(std::string text) {
    std::size_t at = find_bare_point(text, 0), done = 0;
    if (at == text.npos) return text;
    std::string whole;
    whole.reserve(text.size() + text.size() / 8);
    for (; at != text.npos; at = find_bare_point(text, at + 1)) {
        whole.append(text, done, at - done).push_back('0');
        done = at;
    }
    return whole.append(text, done);
}

}  // namespace hogel::scene::mesh_files
