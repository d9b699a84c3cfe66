// SPDX-License-Identifier: Apache-2.0
// Fields in pictures of amplitudes or phases, or in pairs of pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/image/picture_formats.h"
#include "hogel/io/arrays/field_entries.h"
#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {
namespace {

Number number_of(const RawChannels& picture) {
    return picture.largest == 0 ? Number::single : picture.largest < 256 ? Number::uint8 : Number::uint16;
}

// Returns the level that represents 0 in real or imaginary parts. Most programs stretch the values over all levels and
// do not store it. It is estimated as the median, as these parts are positive and negative equally often.
double zero_of(const RawChannels& picture, std::size_t colour, const ExternalField& description) {
    if (picture.largest == 0) return description.zero.value_or(0);
    if (description.zero) return *description.zero;
    const std::size_t channels = picture.values.extent(2);
    std::vector<float> values;
    for (std::size_t i = colour; i < picture.values.size(); i += channels) values.push_back(picture.values.data()[i]);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return double{*middle};
}

ExternalFacts facts_of(const RawChannels& picture) {
    ExternalFacts facts;
    facts.format = "picture";
    facts.numbers = picture.largest == 0 ? "real, floats" : fmt::format("whole numbers up to {}", picture.largest);
    facts.width = picture.values.extent(1);
    facts.height = picture.values.extent(0);
    facts.colours = picture.values.extent(2);
    return facts;
}

std::filesystem::path second_picture(const std::filesystem::path& path, const ExternalField& description) {
    if (!description.imaginary.empty() && !description.phases.empty())
        throw Error(ErrorCode::usage, "imaginary, phases",
                    fmt::format("'{}': a field has either imaginary parts or phases beside it", path.string()));
    return description.imaginary.empty() ? description.phases : description.imaginary;
}

// Fills in missing values and phase code from the file.
ExternalField completed(ExternalField description, const ExternalFacts& facts) {
    using Values = ExternalField::Values;
    if (description.values == Values::complex && !facts.values.empty())
        description.values = facts.values == "phase" ? Values::phase : Values::amplitude;
    const bool phases = description.values == Values::phase || !description.phases.empty();
    if (phases && !description.phase_code && !facts.phase_code.empty())
        description.phase_code = parse_phase_code(facts.phase_code);
    return description;
}

// Returns the number that stands for the full range of phases or for amplitude 1; 0: none, as the numbers have a point.
std::size_t largest_of(const RawChannels& picture, std::size_t largest) {
    return picture.largest > 0 && largest > 0 ? std::min(picture.largest, largest) : picture.largest;
}

// Reads the facts in the texts of the pictures. The second picture of a pair states the code of its phases.
void take_texts(const std::filesystem::path& path, const ExternalField& description, ExternalFacts& facts) {
    take_entries(read_metadata(path), facts);
    if (description.phases.empty() && description.imaginary.empty()) return;
    facts.values = facts.phase_code = "";
    if (description.phases.empty()) return;
    ExternalFacts phase_facts;
    take_entries(read_metadata(description.phases), phase_facts);
    facts.phase_code = phase_facts.phase_code;
}

// Returns the level of each number that a table sends: the nearest, where it sends others.
std::vector<float> inverse_of(const std::vector<std::uint16_t>& table, std::size_t largest) {
    std::vector<std::size_t> nearest(largest + 1, table.size());  // index of the table by number; its size: none
    for (std::size_t i = table.size(); i-- > 0;) nearest[std::min<std::size_t>(table[i], largest)] = i;
    const auto fill = [&](std::size_t number, std::size_t neighbour) {
        const auto distance = [&](std::size_t index) {
            return std::abs(static_cast<double>(table[index]) - static_cast<double>(number));
        };
        const std::size_t other = nearest[neighbour];
        if (other < table.size() && (nearest[number] == table.size() || distance(other) < distance(nearest[number])))
            nearest[number] = other;
    };
    for (std::size_t number = 1; number <= largest; ++number) fill(number, number - 1);
    for (std::size_t number = largest; number-- > 0;) fill(number, number + 1);
    return {nearest.begin(), nearest.end()};
}

// Undoes the order and the numbers of a panel.
void undo_panel(const PanelLevels& panel, std::size_t largest, const std::filesystem::path& path,
                RawChannels& picture) {
    Array<float, 3>& values = picture.values;
    if (panel.flipped_y)
        for (std::size_t y = 0; y < values.extent(0) / 2; ++y)
            std::ranges::swap_ranges(values[y].elements(), values[values.extent(0) - 1 - y].elements());
    for (std::size_t y = 0; panel.flipped_x && y < values.extent(0); ++y)
        for (std::size_t x = 0; x < values.extent(1) / 2; ++x)
            std::ranges::swap_ranges(values[y][x].elements(), values[y][values.extent(1) - 1 - x].elements());
    if (panel.table.empty()) return;
    if (panel.table.size() != largest + 1)
        fail_external(
            path, fmt::format("its level table has {} levels, but its numbers {}", panel.table.size(), largest + 1));
    const std::vector<float> levels = inverse_of(panel.table, largest);
    for (float& value : values.elements())
        value = levels[std::min(static_cast<std::size_t>(std::max(value, 0.0f)), largest)];
}

}  // namespace

bool is_picture_field(const std::filesystem::path& path) {
    const image::PictureFormat* const format = image::format_by_extension(path);
    if (format == nullptr || !format->built_in || !format->written_as_levels) return false;
    ExternalFacts facts;
    take_entries(read_metadata(path), facts);
    return facts.pitch_x > 0 && !facts.values.empty();
}

ExternalFacts picture_facts(const std::filesystem::path& path, const ExternalField& description) {
    ExternalFacts facts = facts_of(read_raw_channels(path));
    const std::filesystem::path second = second_picture(path, description);
    // A grey part may belong to three-colour parts.
    if (!second.empty()) facts.colours = std::max(facts.colours, facts_of(read_raw_channels(second)).colours);
    take_texts(path, description, facts);
    if (facts.largest > 0) facts.numbers = fmt::format("whole numbers up to {}", facts.largest);
    return facts;
}

std::unique_ptr<FieldSource> open_picture_field(const std::filesystem::path& path, const ExternalField& description) {
    const std::filesystem::path second_path = second_picture(path, description);
    const bool two = !second_path.empty();
    if (description.zero && description.imaginary.empty())
        throw Error(ErrorCode::usage, "zero",
                    fmt::format("'{}': a zero level applies to real and imaginary parts only", path.string()));
    RawChannels first = read_raw_channels(path);
    const RawChannels second = two ? read_raw_channels(second_path) : first;
    if (second.values.extent(0) != first.values.extent(0) || second.values.extent(1) != first.values.extent(1))
        fail_external(second_path, fmt::format("it has {}x{} pixels, but '{}' has {}x{}", second.values.extent(1),
                                               second.values.extent(0), path.string(), first.values.extent(1),
                                               first.values.extent(0)));
    const Content content = !two                            ? Content::real
                            : description.imaginary.empty() ? Content::amplitude_phase
                                                            : Content::complex;
    ExternalFacts facts = facts_of(first);
    facts.colours = std::max(facts.colours, second.values.extent(2));
    take_texts(path, description, facts);
    const ExternalField resolved = completed(description, facts);
    SampleConverter convert(path, resolved, content, number_of(first), number_of(second));
    const std::size_t said = two ? 0 : description.largest > 0 ? description.largest : facts.largest;
    const std::size_t largest = largest_of(two ? second : first, said);
    convert.set_largest_phase(largest);
    if (!two) undo_panel(facts.panel, largest, path, first);
    auto field = std::make_unique<Field>(external_grid(path, description, facts));
    const std::size_t channels[2] = {first.values.extent(2), second.values.extent(2)};
    const std::size_t colour[2] = {channels[0] == 1 ? 0 : description.colour,
                                   channels[1] == 1 ? 0 : description.colour};
    if (content == Content::complex)
        convert.set_zero(zero_of(first, colour[0], description), zero_of(second, colour[1], description));
    // A pattern holds scaled amplitudes: its largest level is amplitude 1 of the illumination.
    const double power = two                       ? 0
                         : description.reflectance ? 1
                                                   : power_of_pattern(read_metadata(path), field->grid().wavelength);
    const bool levels = resolved.values == ExternalField::Values::amplitude && largest > 0;
    const auto scale =
        static_cast<float>(power > 0 ? std::sqrt(power) / (levels ? static_cast<double>(largest) : 1) : 1);
    for (std::size_t i = 0; i < field->samples.size(); ++i)
        field->samples.data()[i] = scale * convert(double{first.values.data()[i * channels[0] + colour[0]]},
                                                   two ? double{second.values.data()[i * channels[1] + colour[1]]} : 0);
    require_finite(*field, description.colour, path);
    return field;
}

}  // namespace hogel::io::arrays
