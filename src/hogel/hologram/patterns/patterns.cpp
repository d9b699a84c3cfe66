// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/pieces.h"
#include "hogel/core/shared_order.h"
#include "hogel/core/shared_tiles.h"
#include "hogel/hologram/patterns/pattern_parts.h"
#include "hogel/pattern.h"

namespace hogel {
namespace {

void put_numbers(core::MessageWriter& message, const Pattern& pattern) {
    message.put(pattern.efficiency);
    message.put(pattern.light_field_efficiency);
    message.put(pattern.reference_angle);
    message.put(pattern.iterations);
    message.put(pattern.correlation);
    message.put(pattern.aperture);
    message.put(pattern.power);
}

void get_numbers(core::MessageReader& message, Pattern& pattern) {
    pattern.efficiency = message.get<double>();
    pattern.light_field_efficiency = message.get<double>();
    pattern.reference_angle = message.get<double>();
    pattern.iterations = message.get<std::size_t>();
    pattern.correlation = message.get<double>();
    pattern.aperture = message.get<Aperture>();
    pattern.power = message.get<double>();
}

void put(core::MessageWriter& message, const Pattern& pattern) {
    message.put(pattern.values);
    message.put(pattern.levels);
    put_numbers(message, pattern);
}

Pattern get(core::MessageReader& message) {
    Pattern pattern;
    pattern.values = message.get_array<float, 2>();
    pattern.levels = message.get_array<std::uint8_t, 2>();
    get_numbers(message, pattern);
    return pattern;
}

// The arrays follow in pieces.
void send(Team& team, std::size_t process, const Pattern& pattern) {
    core::MessageWriter message;
    message.put(pattern.values.shape());
    message.put(pattern.levels.shape());
    put_numbers(message, pattern);
    team.send_to(process, message.take());
    core::send_in_pieces<float>(team, process, pattern.values.elements());
    core::send_in_pieces<std::uint8_t>(team, process, pattern.levels.elements());
}

Pattern receive(Team& team, std::size_t process) {
    const std::string bytes = team.receive_from(process);
    core::MessageReader message(bytes);
    Pattern pattern;
    pattern.values = Array<float, 2>(message.get<Shape<2>>());
    pattern.levels = Array<std::uint8_t, 2>(message.get<Shape<2>>());
    get_numbers(message, pattern);
    core::receive_in_pieces(team, process, pattern.values.elements());
    core::receive_in_pieces(team, process, pattern.levels.elements());
    return pattern;
}

}  // namespace

std::vector<Pattern> encode_patterns(std::span<const std::shared_ptr<const FieldSource>> fields,
                                     const PatternOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    const auto encode = [&](std::size_t i) {
        return encode_pattern(*fields[i], options, progress.part(i, fields.size()));
    };
    std::vector<Pattern> patterns(fields.size());
    Team* const all = core::team_of_several();
    if (all == nullptr || core::result_log() != nullptr) {
        // One after the other, so that those that are done can be kept.
        Team* const shared = hologram::patterns::can_be_shared(options.encoding) ? all : nullptr;
        core::kept_one_by_one<Pattern>(
            fields.size(), {put, get},
            [&](std::size_t i) {
                return hologram::patterns::encode_by(shared, *fields[i], options, progress.part(i, fields.size()));
            },
            [&](std::size_t i, Pattern& pattern) { patterns[i] = std::move(pattern); });
        for (Pattern& pattern : patterns) core::share_result<Pattern>(pattern, {put, get});
        return patterns;
    }
    // As many patterns as go round are encoded by one process each, with all its threads; those that are left by all
    // together, where the encoding allows it.
    const std::size_t left = hologram::patterns::can_be_shared(options.encoding) ? fields.size() % all->size() : 0;
    core::TileQueue queue(*all, all->next_number(), fields.size() - left);
    std::vector<std::size_t> own;
    while (const std::optional<std::size_t> i = queue.next()) {
        patterns[*i] = encode(*i);
        own.push_back(*i);
    }
    core::MessageWriter list;
    list.put(own);
    const std::vector<std::string> lists = core::all_of(*all, list.take());
    for (std::size_t process = 0; process < all->size(); ++process) {
        core::MessageReader message(lists[process]);
        for (const std::size_t i : message.get_vector<std::size_t>()) {
            if (process != all->rank())
                patterns[i] = receive(*all, process);
            else
                for (std::size_t other = 0; other < all->size(); ++other)
                    if (other != process) send(*all, other, patterns[i]);
        }
    }
    for (std::size_t i = fields.size() - left; i < fields.size(); ++i)
        patterns[i] = hologram::patterns::encode_by(all, *fields[i], options, progress.part(i, fields.size()));
    return patterns;
}

SuitablePatterns encode_suitably(std::span<const std::shared_ptr<const FieldSource>> fields,
                                 const PatternOptions& options, const Progress& progress) {
    return hologram::patterns::find_suitable(options, progress, [&](const PatternOptions& tried, const Progress& part) {
        return encode_patterns(fields, tried, part);
    });
}

}  // namespace hogel
