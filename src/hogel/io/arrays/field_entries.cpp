// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/field_entries.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel {

using namespace io::arrays;

namespace {

constexpr const char *pitch_x_key = "pitch_x_m", *pitch_y_key = "pitch_y_m", *values_key = "values",
                     *phase_code_key = "phase_code", *max_level_key = "max_level", *flip_key = "flip",
                     *table_key = "level_table", *correction_key = "correction_file";

std::string wavelength_key(std::size_t field) { return fmt::format("field{}_wavelength_m", field); }

const std::string* find_text(const Metadata& entries, const std::string& key) {
    const auto found = std::ranges::find(entries, key, [](const auto& entry) { return entry.first; });
    return found == entries.end() ? nullptr : &found->second;
}

// Returns 0 if there is no positive number.
double positive_number(const Metadata& entries, const std::string& key) {
    const std::string* const text = find_text(entries, key);
    double value = 0;
    if (text == nullptr) return 0;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
    return error == std::errc() && std::isfinite(value) && value > 0 ? value : 0;
}

void add_panel(const PanelLevels& panel, Metadata& entries) {
    if (panel.flipped_x || panel.flipped_y)
        entries.emplace_back(flip_key, panel.flipped_x && panel.flipped_y ? "both"
                                       : panel.flipped_x                  ? "horizontal"
                                                                          : "vertical");
    if (!panel.table.empty()) entries.emplace_back(table_key, fmt::format("{}", fmt::join(panel.table, " ")));
    if (!panel.correction.empty()) entries.emplace_back(correction_key, panel.correction);
}

PanelLevels panel_of(const Metadata& entries) {
    PanelLevels panel;
    if (const std::string* const flip = find_text(entries, flip_key)) {
        panel.flipped_x = *flip == "horizontal" || *flip == "both";
        panel.flipped_y = *flip == "vertical" || *flip == "both";
    }
    if (const std::string* const correction = find_text(entries, correction_key)) panel.correction = *correction;
    const std::string* const table = find_text(entries, table_key);
    if (table == nullptr) return panel;
    const char *at = table->data(), *const end = table->data() + table->size();
    for (std::from_chars_result read{}; at < end; at = read.ptr + 1) {
        read = std::from_chars(at, end, panel.table.emplace_back());
        if (read.ec != std::errc()) panel.table.back() = 0;
    }
    return panel;
}

}  // namespace

Metadata field_entries(const ExternalField& description, std::span<const double> wavelengths) {
    Metadata entries{{pitch_x_key, fmt::format("{}", description.pitch_x)},
                     {pitch_y_key, fmt::format("{}", description.pitch_y)}};
    for (std::size_t i = 0; i < wavelengths.size(); ++i)
        entries.emplace_back(wavelength_key(i), fmt::format("{}", wavelengths[i]));
    const bool phases = description.values == ExternalField::Values::phase;
    if (phases || description.values == ExternalField::Values::amplitude)
        entries.emplace_back(values_key, phases ? "phase" : "amplitude");
    if (phases && description.phase_code)
        entries.emplace_back(phase_code_key, phase_code_text(*description.phase_code));
    add_panel(description.panel, entries);
    if (description.largest > 255) entries.emplace_back(max_level_key, fmt::format("{}", description.largest));
    return entries;
}

void io::arrays::take_entries(const Metadata& entries, ExternalFacts& facts) {
    facts.pitch_x = positive_number(entries, pitch_x_key);
    facts.pitch_y = positive_number(entries, pitch_y_key);
    for (std::size_t i = 0; i < facts.colours; ++i)
        if (const double length = positive_number(entries, wavelength_key(i)); length > 0)
            facts.wavelengths.push_back(length);
    if (facts.wavelengths.size() != facts.colours) facts.wavelengths.clear();
    const std::string* const values = find_text(entries, values_key);
    if (values == nullptr || (*values != "phase" && *values != "amplitude")) return;
    facts.values = *values;
    facts.panel = panel_of(entries);
    if (const double largest = positive_number(entries, max_level_key); largest >= 1 && largest <= 65535)
        facts.largest = static_cast<std::size_t>(largest);
    const std::string* const code = find_text(entries, phase_code_key);
    if (code == nullptr || *values != "phase") return;
    try {
        parse_phase_code(*code);
        facts.phase_code = *code;
    } catch (const Error&) {
        // Unknown code of a later version: the user has to state it.
    }
}

double io::arrays::power_of_pattern(const Metadata& entries, double wavelength) {
    const double power = positive_number(entries, "power at " + format_length(wavelength));
    return power > 1e-12 && power < 1e12 ? power : 0;
}

}  // namespace hogel
