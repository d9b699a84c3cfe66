// SPDX-License-Identifier: Apache-2.0
#include "hogel/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hogel/error.h"

namespace hogel {
namespace {

// Returns the optimal string alignment distance: insertions, deletions, replacements and swaps that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            d[i][j] = std::min({replaced, d[i - 1][j] + 1, d[i][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(std::string_view word, std::span<const std::string> words) {
    std::string nearest;
    std::size_t distance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : words) {
        const std::size_t d = edit_distance(word, candidate);
        if (d < distance && d < candidate.size()) {
            distance = d;
            nearest = candidate;
        }
    }
    if (!nearest.empty() || word.size() < 3) return nearest;
    const auto match =
        std::ranges::find_if(words, [&](const std::string& candidate) { return candidate.starts_with(word); });
    return match != words.end() ? *match : std::string();
}

void throw_unknown(std::string_view kind, std::string_view name, std::span<const std::string> known,
                   const std::string& parameter) {
    const std::string nearest = nearest_word(name, known);
    throw Error(
        ErrorCode::usage, parameter,
        fmt::format("no {} '{}'{}; expected one of {}", kind, name,
                    nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest), fmt::join(known, ", ")));
}

void throw_known(std::string_view kind, std::string_view name) {
    throw Error(ErrorCode::usage, fmt::format("there is a {} '{}' already", kind, name));
}

}  // namespace hogel
