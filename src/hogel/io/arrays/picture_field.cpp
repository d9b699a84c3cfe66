// SPDX-License-Identifier: Apache-2.0
// Fields in pictures: of amplitudes or phases, or in two pictures.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/io/arrays/numbers.h"
#include "hogel/units.h"

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
        throw Error(ErrorCode::usage,
                    fmt::format("'{}': a field has either imaginary parts or phases beside it", path.string()));
    return what.imaginary.empty() ? what.phases : what.imaginary;
}

// What a pattern is to be multiplied with to have the amplitudes of its hologram, if the file says which power its
// light needs, as those of `hogel slm` do; otherwise 1.
float amplitude_scale(const std::filesystem::path& path, double wavelength) {
    const std::string key = "power at " + format_length(wavelength);
    for (const auto& [name, text] : read_metadata(path)) {
        double power = 0;
        if (name != key || std::from_chars(text.data(), text.data() + text.size(), power).ec != std::errc()) continue;
        if (power > 1e-12 && power < 1e12) return static_cast<float>(std::sqrt(power));
    }
    return 1;
}

}  // namespace

ExternalFacts picture_facts(const std::filesystem::path& path, const ExternalField& what) {
    ExternalFacts facts = facts_of(read_raw_channels(path));
    // Parts of three colours of which one part is grey are still three colours.
    if (const std::filesystem::path second = second_picture(path, what); !second.empty())
        facts.colours = std::max(facts.colours, facts_of(read_raw_channels(second)).colours);
    return facts;
}

std::unique_ptr<FieldSource> open_picture_field(const std::filesystem::path& path, const ExternalField& what) {
    const std::filesystem::path second_path = second_picture(path, what);
    const bool two = !second_path.empty();
    if (what.zero && what.imaginary.empty())
        throw Error(ErrorCode::usage,
                    fmt::format("'{}': a zero level is one of real and imaginary parts", path.string()));
    const RawChannels first = read_raw_channels(path), second = two ? read_raw_channels(second_path) : first;
    if (second.values.extent(0) != first.values.extent(0) || second.values.extent(1) != first.values.extent(1))
        fail_external(second_path, fmt::format("it has {}x{} pixels, but '{}' has {}x{}", second.values.extent(1),
                                               second.values.extent(0), path.string(), first.values.extent(1),
                                               first.values.extent(0)));
    const Content content = !two ? Content::real : what.imaginary.empty() ? Content::amplitude_phase : Content::complex;
    SampleConverter convert(path, what, content, number_of(first), number_of(second));
    convert.set_largest_phase(two ? second.largest : first.largest);
    ExternalFacts facts = facts_of(first);
    facts.colours = std::max(facts.colours, second.values.extent(2));
    auto field = std::make_unique<Field>(external_grid(path, what, facts));
    const std::size_t channels[2] = {first.values.extent(2), second.values.extent(2)};
    const std::size_t colour[2] = {channels[0] == 1 ? 0 : what.colour, channels[1] == 1 ? 0 : what.colour};
    if (content == Content::complex)
        convert.set_zero(zero_of(first, colour[0], what), zero_of(second, colour[1], what));
    const float scale = two ? 1 : amplitude_scale(path, what.wavelength);
    for (std::size_t i = 0; i < field->samples.size(); ++i)
        field->samples.data()[i] = scale * convert(double{first.values.data()[i * channels[0] + colour[0]]},
                                                   two ? double{second.values.data()[i * channels[1] + colour[1]]} : 0);
    require_finite(*field, what.colour, path);
    return field;
}

}  // namespace hogel::io::arrays
