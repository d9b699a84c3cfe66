// SPDX-License-Identifier: Apache-2.0
// What is sent to a panel: level tables, wavefront corrections, flips, and phases of lenses and gratings.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>

#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/patterns/pattern_parts.h"

namespace hogel {

using namespace patterns;

namespace {

// Phases in cycles that are added to those of a pattern, by its row and column.
class AddedPhases {
  public:
    AddedPhases(const PanelOptions& panel, const Shape<2>& shape, double pitch, double wavelength)
        : panel_(panel),
          middle_x_(0.5 * (static_cast<double>(shape[1]) - 1)),
          middle_y_(0.5 * (static_cast<double>(shape[0]) - 1)),
          curvature_(panel.lens == 0 ? 0 : -pitch * pitch / (2 * wavelength * panel.lens)) {}

    double operator()(std::size_t y, std::size_t x) const {
        const double right = static_cast<double>(x) - middle_x_, down = static_cast<double>(y) - middle_y_;
        return curvature_ * (right * right + down * down) + panel_.blaze_x * right - panel_.blaze_y * down;
    }

  private:
    const PanelOptions& panel_;
    double middle_x_, middle_y_, curvature_;
};

}  // namespace

void require_panel(const PanelOptions& panel, const PatternOptions& options) {
    const Modulator& modulator = options.modulator;
    if (!is_phase_only(options.encoding) &&
        (panel.lens != 0 || panel.blaze_x != 0 || panel.blaze_y != 0 || panel.correction.size() > 0))
        throw Error(ErrorCode::usage, "lens, blaze, correction", "are phases, but this encoding shows amplitudes");
    if (panel.correction.size() > 0 && panel.correction.shape() != Shape<2>{modulator.height, modulator.width})
        throw Error(ErrorCode::usage, "correction",
                    fmt::format("the correction has {}x{} pixels, but the modulator {}x{}", panel.correction.extent(1),
                                panel.correction.extent(0), modulator.width, modulator.height));
    const std::vector<std::uint16_t>& table = panel.levels.table;
    const std::size_t largest = Rounding{modulator.levels, false, {}}.largest();
    if (!table.empty() && table.size() != largest + 1)
        throw Error(ErrorCode::usage, "lut",
                    fmt::format("the level table has {} levels; expected {}", table.size(), largest + 1));
    for (const std::uint16_t level : table)
        if (level > largest)
            throw Error(ErrorCode::usage, "lut",
                        fmt::format("the level table has the level {}; expected 0 to {}", level, largest));
}

Array<std::uint16_t, 2> panel_levels(const Pattern& pattern, const PatternOptions& options, const PanelOptions& panel,
                                     double wavelength) {
    require_panel(panel, options);
    const bool phases = is_phase_only(options.encoding);
    const Shape<2>& shape = pattern.values.shape();
    const Rounding round{options.modulator.levels, phases, options.phase_code};
    const AddedPhases added(panel, shape, options.modulator.pitch, wavelength);
    // The levels of a correction rise or fall with the phase as those of the code do.
    const double cycles_of_level = (options.phase_code.inverted ? -1.0 : 1.0) / (pattern.max_level + 1.0);
    const PanelLevels& sent = panel.levels;
    Array<std::uint16_t, 2> levels(shape);
    work::parallel_for(shape[0], [&](std::size_t y) {
        const std::size_t from_y = sent.flipped_y ? shape[0] - 1 - y : y;
        for (std::size_t x = 0; x < shape[1]; ++x) {
            const std::size_t from_x = sent.flipped_x ? shape[1] - 1 - x : x;
            double value = pattern.values(from_y, from_x);
            if (phases) {
                value += added(from_y, from_x);
                if (panel.correction.size() > 0) value += cycles_of_level * panel.correction(y, x);
                value -= std::floor(value);
            }
            const std::uint16_t level = round(static_cast<float>(value));
            levels(y, x) = sent.table.empty() ? level : sent.table[level];
        }
    });
    return levels;
}

std::vector<std::uint16_t> read_level_table(const std::filesystem::path& path) {
    std::ifstream file(path);
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::bad_input, fmt::format("{}: {}", path.string(), why));
    };
    if (!file) fail("cannot be opened");
    std::vector<std::uint16_t> table;
    std::size_t number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        std::vector<unsigned> values;
        const char *at = line.data(), *const end = line.data() + line.size();
        while (at != end && *at != '#') {
            if (std::string_view(" \t\r,;").find(*at) != std::string_view::npos) {
                ++at;
                continue;
            }
            const auto [next, error] = std::from_chars(at, end, values.emplace_back());
            if (error != std::errc()) fail(fmt::format("line {}: expected a level, or its index and a level", number));
            at = next;
        }
        if (values.empty()) continue;
        if (values.size() > 2 || values.back() >= max_modulator_levels ||
            (values.size() == 2 && values[0] != table.size()))
            fail(fmt::format("line {}: expected a level below {}, or the index {} and a level", number,
                             max_modulator_levels, table.size()));
        table.push_back(static_cast<std::uint16_t>(values.back()));
        if (table.size() > max_modulator_levels) fail(fmt::format("has more than {} levels", max_modulator_levels));
    }
    if (table.empty()) fail("has no levels");
    return table;
}

}  // namespace hogel
