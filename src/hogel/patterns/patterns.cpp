// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/stop_scope.h"
#include "hogel/pattern.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {
namespace {

void put_numbers(work::MessageWriter& message, const Pattern& pattern) {
    message.put(pattern.efficiency);
    message.put(pattern.light_field_efficiency);
    message.put(pattern.reference_angle);
    message.put(pattern.iterations);
    message.put(pattern.correlation);
    message.put(pattern.aperture);
    message.put(pattern.power);
}

void get_numbers(work::MessageReader& message, Pattern& pattern) {
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
    pattern.levels = message.get_array<std::uint8_t, 2>();
    get_numbers(message, pattern);
    return pattern;
}

}  // namespace

std::vector<Pattern> encode_patterns(std::span<const std::shared_ptr<const FieldSource>> fields,
                                     const PatternOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    std::vector<Pattern> patterns(fields.size());
    work::shared_jobs<Pattern>(
        fields.size(), {put, get},
        [&](std::size_t i) { return encode_pattern(*fields[i], options, progress.part(i, fields.size())); },
        [&](std::size_t i, Pattern& pattern) { patterns[i] = std::move(pattern); });
    for (Pattern& pattern : patterns) work::broadcast_result<Pattern>(pattern, {put, get});
    return patterns;
}

SuitablePatterns encode_suitably(std::span<const std::shared_ptr<const FieldSource>> fields,
                                 const PatternOptions& options, const Progress& progress) {
    return patterns::find_suitable(options, progress, [&](const PatternOptions& candidate, const Progress& part) {
        return encode_patterns(fields, candidate, part);
    });
}

}  // namespace hogel
