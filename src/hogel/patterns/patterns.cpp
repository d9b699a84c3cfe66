// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/pattern.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {
namespace {

void put_numbers(work::MessageWriter& message, const Pattern& pattern) {
    message.put(pattern.max_level);
    message.put(pattern.efficiency);
    message.put(pattern.light_field_efficiency);
    message.put(pattern.reference_angle);
    message.put(pattern.iterations);
    message.put(pattern.correlation);
    message.put(pattern.aperture);
    message.put(pattern.power);
}

void get_numbers(work::MessageReader& message, Pattern& pattern) {
    pattern.max_level = message.get<std::uint16_t>();
    pattern.efficiency = message.get<double>();
    pattern.light_field_efficiency = message.get<double>();
    pattern.reference_angle = message.get<double>();
    pattern.iterations = message.get<std::size_t>();
    pattern.correlation = message.get<double>();
    pattern.aperture = message.get<Aperture>();
    pattern.power = message.get<double>();
}

void put(work::MessageWriter& message, const Pattern& pattern) {
    message.put(pattern.values);
    message.put(pattern.levels);
    put_numbers(message, pattern);
}

Pattern get(work::MessageReader& message) {
    Pattern pattern;
    pattern.values = message.get_array<float, 2>();
    pattern.levels = message.get_array<std::uint16_t, 2>();
    get_numbers(message, pattern);
    return pattern;
}

void put_supervised(work::MessageWriter& message, const SupervisedPatterns& supervised) {
    message.put(supervised.frames.size());
    for (const Pattern& pattern : supervised.frames) put(message, pattern);
    message.put(supervised.quality);
}

SupervisedPatterns get_supervised(work::MessageReader& message) {
    SupervisedPatterns supervised;
    supervised.frames.resize(message.get<std::size_t>());
    for (Pattern& pattern : supervised.frames) pattern = get(message);
    supervised.quality = message.get<PupilQuality>();
    return supervised;
}

// Computes encode(i, progress) for every field on one of the ranks, and returns all results on all ranks.
template <class Result, class Encode>
std::vector<Result> encode_shared(std::size_t fields, const work::Sent<Result>& sent, const Progress& progress,
                                  const Encode& encode) {
    std::vector<Result> results(fields);
    work::shared_jobs<Result>(
        fields, sent, [&](std::size_t i) { return encode(i, progress.part(i, fields)); },
        [&](std::size_t i, Result& result) { results[i] = std::move(result); });
    for (Result& result : results) work::broadcast_result<Result>(result, sent);
    return results;
}

}  // namespace

std::vector<Pattern> encode_patterns(std::span<const std::shared_ptr<const FieldSource>> fields,
                                     const PatternOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    return encode_shared<Pattern>(fields.size(), {put, get}, progress, [&](std::size_t i, const Progress& part) {
        return encode_pattern(*fields[i], options, part);
    });
}

std::vector<SupervisedPatterns> encode_supervised(std::span<const std::shared_ptr<const FieldSource>> fields,
                                                  const LightFieldSource& light_field,
                                                  std::span<const std::size_t> channels, const PatternOptions& options,
                                                  const Progress& progress) {
    const core::StopScope scope(progress);
    if (channels.size() != fields.size())
        throw Error(ErrorCode::usage, fmt::format("{} channels for {} fields", channels.size(), fields.size()));
    return encode_shared<SupervisedPatterns>(
        fields.size(), {put_supervised, get_supervised}, progress, [&](std::size_t i, const Progress& part) {
            return patterns::supervise(*fields[i], light_field, channels[i], options, part);
        });
}

Array<std::uint16_t, 3> joined_levels(std::span<const Pattern> patterns) {
    const Shape<2> shape = patterns.empty() ? Shape<2>{} : patterns[0].levels.shape();
    Array<std::uint16_t, 3> joined({shape[0], shape[1], patterns.size()});
    for (std::size_t c = 0; c < patterns.size(); ++c) {
        if (patterns[c].levels.shape() != shape) throw Error(ErrorCode::usage, "patterns of one modulator are needed");
        for (std::size_t i = 0; i < patterns[c].levels.size(); ++i)
            joined.data()[i * patterns.size() + c] = patterns[c].levels.data()[i];
    }
    return joined;
}

SuitablePatterns encode_suitably(std::span<const std::shared_ptr<const FieldSource>> fields,
                                 const PatternOptions& options, const Progress& progress) {
    return patterns::find_suitable(options, progress, [&](const PatternOptions& candidate, const Progress& part) {
        return encode_patterns(fields, candidate, part);
    });
}

}  // namespace hogel
