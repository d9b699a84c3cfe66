// SPDX-License-Identifier: Apache-2.0
// Fields in pictures: of amplitudes or phases, or in two pictures.
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

// The number of 0 in real or imaginary parts: nearly all programs spread what they have over all levels, and keep
// nothing of where 0 went. It is the median of a part that is as often positive as negative.
double zero_of(const RawChannels& picture, std::size_t colour, const ExternalField& what) {
    if (picture.largest == 0) return what.zero.value_or(0);
    if (what.zero) return *what.zero;
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

std::filesystem::path second_picture(const std::filesystem::path& path, const ExternalField& what) {
    if (!what.imaginary.empty() && !what.phases.empty())
        throw Error(ErrorCode::usage, "imaginary, phases",
                    fmt::format("'{}': a field has either imaginary parts or phases beside it", path.string()));
    return what.imaginary.empty() ? what.phases : what.imaginary;
}

// A description with the values and the phase code that the file says, where it leaves them out.
ExternalField completed(ExternalField what, const ExternalFacts& facts) {
    using Values = ExternalField::Values;
    if (what.values == Values::complex && !facts.values.empty())
        what.values = facts.values == "phase" ? Values::phase : Values::amplitude;
    const bool phases = what.values == Values::phase || !what.phases.empty();
    if (phases && !what.phase_code && !facts.phase_code.empty()) what.phase_code = parse_phase_code(facts.phase_code);
    return what;
}

// Takes what the pictures say of themselves. Of two the second one says in which code its phases are.
void take_texts(const std::filesystem::path& path, const ExternalField& what, ExternalFacts& facts) {
    take_entries(read_metadata(path), facts);
    if (what.phases.empty() && what.imaginary.empty()) return;
    facts.values = facts.phase_code = "";
    if (what.phases.empty()) return;
    ExternalFacts of_phases;
    take_entries(read_metadata(what.phases), of_phases);
    facts.phase_code = of_phases.phase_code;
}

}  // namespace

bool is_picture_field(const std::filesystem::path& path) {
    const image::PictureFormat* const format = image::format_by_extension(path);
    if (format == nullptr || !format->built_in || !format->written_as_levels) return false;
    ExternalFacts facts;
    take_entries(read_metadata(path), facts);
    return facts.pitch_x > 0 && !facts.values.empty();
}

ExternalFacts picture_facts(const std::filesystem::path& path, const ExternalField& what) {
    ExternalFacts facts = facts_of(read_raw_channels(path));
    const std::filesystem::path second = second_picture(path, what);
    // Parts of three colours of which one part is grey are still three colours.
    if (!second.empty()) facts.colours = std::max(facts.colours, facts_of(read_raw_channels(second)).colours);
    take_texts(path, what, facts);
    return facts;
}

std::unique_ptr<FieldSource> open_picture_field(const std::filesystem::path& path, const ExternalField& what) {
    const std::filesystem::path second_path = second_picture(path, what);
    const bool two = !second_path.empty();
    if (what.zero && what.imaginary.empty())
        throw Error(ErrorCode::usage, "zero",
                    fmt::format("'{}': a zero level is one of real and imaginary parts", path.string()));
    const RawChannels first = read_raw_channels(path), second = two ? read_raw_channels(second_path) : first;
    if (second.values.extent(0) != first.values.extent(0) || second.values.extent(1) != first.values.extent(1))
        fail_external(second_path, fmt::format("it has {}x{} pixels, but '{}' has {}x{}", second.values.extent(1),
                                               second.values.extent(0), path.string(), first.values.extent(1),
                                               first.values.extent(0)));
    const Content content = !two ? Content::real : what.imaginary.empty() ? Content::amplitude_phase : Content::complex;
    ExternalFacts facts = facts_of(first);
    facts.colours = std::max(facts.colours, second.values.extent(2));
    take_texts(path, what, facts);
    const ExternalField meant = completed(what, facts);
    SampleConverter convert(path, meant, content, number_of(first), number_of(second));
    convert.set_largest_phase(two ? second.largest : first.largest);
    auto field = std::make_unique<Field>(external_grid(path, what, facts));
    const std::size_t channels[2] = {first.values.extent(2), second.values.extent(2)};
    const std::size_t colour[2] = {channels[0] == 1 ? 0 : what.colour, channels[1] == 1 ? 0 : what.colour};
    if (content == Content::complex)
        convert.set_zero(zero_of(first, colour[0], what), zero_of(second, colour[1], what));
    // A pattern has the amplitudes of its hologram; its largest level is the amplitude 1 of the light on it.
    const double power = two ? 0 : power_of_pattern(read_metadata(path), field->grid().wavelength);
    const bool levels = meant.values == ExternalField::Values::amplitude && first.largest > 0;
    const auto scale =
        static_cast<float>(power > 0 ? std::sqrt(power) / (levels ? static_cast<double>(first.largest) : 1) : 1);
    for (std::size_t i = 0; i < field->samples.size(); ++i)
        field->samples.data()[i] = scale * convert(double{first.values.data()[i * channels[0] + colour[0]]},
                                                   two ? double{second.values.data()[i * channels[1] + colour[1]]} : 0);
    require_finite(*field, what.colour, path);
    return field;
}

}  // namespace hogel::io::arrays
