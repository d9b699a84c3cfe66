// SPDX-License-Identifier: Apache-2.0
// Fields in the channels of an EXR file, two per field. The names denote real and imaginary parts, or amplitude and
// phase: "real" and "imaginary", "field0.re" and "field0.im", "R.amplitude" and "R.phase".
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hogel/error.h"
#include "hogel/image/channels.h"
#include "hogel/io/arrays/field_entries.h"
#include "hogel/io/arrays/named_arrays.h"

namespace hogel::io::arrays {
namespace {

using Channels = std::vector<std::pair<std::string, Array<float, 2>>>;

// Returns the pairs ordered by channel name, but red, green and blue in this order.
std::vector<PartPair> pairs_of(const Channels& channels) {
    std::vector<PartName> names;
    for (const auto& [name, samples] : channels) names.push_back({name, ""});
    std::vector<PartPair> pairs = pairs_of_parts(names, channels.size());
    // A lone "A" is alpha, and "R" red, except in a file of two parts.
    const auto is_lone = [&](std::size_t i) { return channels[i].first.size() < 2; };
    if (channels.size() > 2)
        std::erase_if(pairs, [&](const PartPair& pair) { return is_lone(pair.first) || is_lone(pair.second); });
    const auto order = [&](const PartPair& pair) {
        const std::string& name = channels[pair.first].first;
        constexpr std::string_view colours = "RGB";
        std::size_t colour = std::string::npos;  // "R.amplitude", "amplitude.R"
        if (name.size() > 1 && name[1] == '.') colour = colours.find(name[0]);
        if (name.size() > 1 && name[name.size() - 2] == '.') colour = std::min(colour, colours.find(name.back()));
        return std::pair(colour, name);
    };
    std::ranges::stable_sort(pairs, {}, order);
    return pairs;
}

ExternalFacts facts_of(const image::NamedChannels& picture, const std::vector<PartPair>& pairs) {
    ExternalFacts facts;
    facts.format = "exr";
    facts.numbers = pairs.front().content == Content::complex ? "complex, floats" : "amplitudes and phases, floats";
    facts.width = picture.channels.front().second.extent(1);
    facts.height = picture.channels.front().second.extent(0);
    facts.colours = pairs.size();
    take_entries(picture.texts, facts);
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

std::unique_ptr<FieldSource> open_exr_field(const std::filesystem::path& path, const ExternalField& description) {
    const image::NamedChannels picture = image::read_named_channels(path);
    const std::vector<PartPair> pairs = pairs_of(picture.channels);
    auto field = std::make_unique<Field>(external_grid(path, description, facts_of(picture, pairs)));
    const PartPair& pair = pairs[description.colour];
    const SampleConverter convert(path, description, pair.content, Number::single, Number::single);
    const float* const first = picture.channels[pair.first].second.data();
    const float* const second = picture.channels[pair.second].second.data();
    for (std::size_t i = 0; i < field->samples.size(); ++i)
        field->samples.data()[i] = convert(double{first[i]}, double{second[i]});
    require_finite(*field, description.colour, path);
    return field;
}

}  // namespace hogel::io::arrays
