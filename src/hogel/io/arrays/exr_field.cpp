// SPDX-License-Identifier: Apache-2.0
// Fields in the channels of an EXR file: two for each field, of real and imaginary parts or of amplitudes and phases,
// which their names say: "real" and "imaginary", "field0.re" and "field0.im", "R.amplitude" and "R.phase".
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "hogel/error.h"
#include "hogel/image/channels.h"
#include "hogel/io/arrays/named_arrays.h"

namespace hogel::io::arrays {
namespace {

using Channels = std::vector<std::pair<std::string, Array<float, 2>>>;

// The numbers of the two channels of a field.
struct ChannelPair {
    std::size_t first = 0, second = 0;
    Content content = Content::complex;
};

// The pairs in the order of their channels' names; red, green and blue in this order.
std::vector<ChannelPair> pairs_of(const Channels& channels) {
    std::vector<ChannelPair> pairs;
    for (std::size_t i = 0; i < channels.size(); ++i)
        for (std::size_t j = 0; j < channels.size(); ++j) {
            const auto &a = channels[i].first, &b = channels[j].first;
            // A lone "A" is alpha, and "R" red, except in a file of two parts.
            if (i == j || (channels.size() > 2 && (a.size() < 2 || b.size() < 2))) continue;
            if (name_real_and_imaginary(a, b)) pairs.push_back({i, j, Content::complex});
            if (name_amplitude_and_phase(a, b)) pairs.push_back({i, j, Content::amplitude_phase});
        }
    const auto order = [&](const ChannelPair& pair) {
        const std::string& name = channels[pair.first].first;
        constexpr std::string_view colours = "RGB";
        std::size_t colour = std::string::npos;  // "R.amplitude", "amplitude.R"
        if (name.size() > 1 && name[1] == '.') colour = colours.find(name[0]);
        if (name.size() > 1 && name[name.size() - 2] == '.') colour = std::min(colour, colours.find(name.back()));
        return std::pair(colour, name);
    };
    std::ranges::sort(pairs, {}, order);
    return pairs;
}

// Lengths in the texts that hogel writes.
double length_of(const Metadata& texts, const std::string& name) {
    for (const auto& [key, text] : texts)
        if (double value = 0; key == name) {
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            return error == std::errc() && value > 0 ? value : 0;
        }
    return 0;
}

ExternalFacts facts_of(const image::NamedChannels& picture, const std::vector<ChannelPair>& pairs) {
    ExternalFacts facts;
    facts.format = "exr";
    facts.numbers = pairs.front().content == Content::complex ? "complex, floats" : "amplitudes and phases, floats";
    facts.width = picture.channels.front().second.extent(1);
    facts.height = picture.channels.front().second.extent(0);
    facts.colours = pairs.size();
    facts.pitch_x = length_of(picture.texts, "pitch_x_m");
    facts.pitch_y = length_of(picture.texts, "pitch_y_m");
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (const double length = length_of(picture.texts, fmt::format("field{}_wavelength_m", i)); length > 0)
            facts.wavelengths.push_back(length);
    if (facts.wavelengths.size() != pairs.size()) facts.wavelengths.clear();
    return facts;
}

}  // namespace

bool is_exr_field(const std::filesystem::path& path, std::span<const unsigned char> start) {
    constexpr unsigned char mark[4] = {0x76, 0x2f, 0x31, 0x01};
    if (start.size() < 4 || std::memcmp(start.data(), mark, 4) != 0) return false;
    return !pairs_of(image::read_named_channels(path, true).channels).empty();
}

ExternalFacts exr_facts(const std::filesystem::path& path) {
    const image::NamedChannels picture = image::read_named_channels(path);
    return facts_of(picture, pairs_of(picture.channels));
}

std::unique_ptr<FieldSource> open_exr_field(const std::filesystem::path& path, const ExternalField& what) {
    const image::NamedChannels picture = image::read_named_channels(path);
    const std::vector<ChannelPair> pairs = pairs_of(picture.channels);
    auto field = std::make_unique<Field>(external_grid(path, what, facts_of(picture, pairs)));
    const ChannelPair& pair = pairs[what.colour];
    const SampleConverter convert(path, what, pair.content, Number::single, Number::single);
    const float* const first = picture.channels[pair.first].second.data();
    const float* const second = picture.channels[pair.second].second.data();
    for (std::size_t i = 0; i < field->samples.size(); ++i)
        field->samples.data()[i] = convert(double{first[i]}, double{second[i]});
    return field;
}

}  // namespace hogel::io::arrays
