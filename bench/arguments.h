// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace hogel::bench {

/// Columns and rows: "256x128", or "256" for a square.
struct Counts {
    std::size_t columns = 0, rows = 0;
};

/// Full angles, radians: "40,30deg", or "40deg" for both.
struct Angles {
    double across = 0, down = 0;
};

/// Parse the values of options. Each throws Error(usage) naming the option if the text is not a valid value.
/// @param option  name of the option, e.g. "--hogels"
std::size_t parse_count(const std::string& text, const std::string& option);
Counts parse_counts(const std::string& text, const std::string& option);
Angles parse_angles(const std::string& text, const std::string& option);

/// Return a value as typed on a command line: "64x48", "40deg", "20mm".
std::string typed(const Counts& counts);
std::string typed(const Angles& angles);
std::string typed_length(double metres);

}  // namespace hogel::bench
