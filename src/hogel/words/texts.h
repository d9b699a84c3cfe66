// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/geometry.h"
#include "hogel/parameters.h"

namespace hogel::words {

// Parse texts of parameters. They throw Error(usage), with messages that begin with `what`.
double parse_positive_length(const std::string& text, const std::string& what);
double parse_finite_number(const std::string& text, const std::string& what);
std::size_t parse_count(const std::string& text, const std::string& what);
std::uint64_t parse_whole(const std::string& text, const std::string& what, std::uint64_t max);
Counts parse_counts(const std::string& text, const std::string& what);
/// Returns rows = 0 for a single number.
Counts parse_resolution(const std::string& text, const std::string& what);
Angles parse_angles(const std::string& text, const std::string& what);
Vec3 parse_rotation(const std::string& text, const std::string& what);
std::vector<double> parse_wavelengths(const std::string& text, const std::string& what);
bool parse_flag(const std::string& text, const std::string& what);
std::string parse_choice(const std::string& text, const std::string& what, std::span<const std::string> choices);

// Return the shortest text that is parsed to the same value.
std::string number_text(double number);
std::string counts_text(const Counts& counts);
std::string resolution_text(const Counts& counts);

/// Returns a word for a shell's command line, quoted if necessary.
std::string shell_word(const std::string& word);

}  // namespace hogel::words
