// SPDX-License-Identifier: Apache-2.0
#include "bench/render/race.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/measure.h"
#include "bench/render/rows.h"
#include "hogel/error.h"
#include "hogel/renderer.h"

namespace hogel::bench {
namespace {

// Returns the fraction of samples that differ by more than 1/64 plus the rounding of the peer's format. The tolerance
// ignores rays that pass an edge between triangles of nearly equal radiance on the other side.
double differing(const HogelRows& rows, const RenderPeer& peer, const std::vector<HogelIndex>& hogels,
                 const LightFieldGrid& grid) {
    const float tolerance = 1.0f / 64 + peer.rounding();
    std::size_t different = 0;
    for (std::size_t i = 0; i < hogels.size(); ++i)
        for (std::size_t v = 0; v < grid.directions_v; ++v)
            for (std::size_t u = 0; u < grid.directions_u; ++u) {
                const Rgb ours = rows.sample(hogels[i], v, u), theirs = peer.sample(i, v, u);
                const auto difference = [&](float a, float b) {
                    return std::abs(std::min(a, peer.max_radiance()) - b);
                };
                different += std::max({difference(ours.r, theirs.r), difference(ours.g, theirs.g),
                                       difference(ours.b, theirs.b)}) > tolerance;
            }
    return static_cast<double>(different) / static_cast<double>(hogels.size() * grid.directions());
}

struct Lane {
    Racer racer;
    std::unique_ptr<RenderPeer> peer;  // null for hogel's renderer
    std::vector<HogelIndex> hogels;
    std::vector<double> wall, processor;

    void add(Times times, const LightFieldGrid& grid) {
        const double samples = 1e-6 * static_cast<double>(racer.hogels * grid.directions());
        wall.push_back(samples / times.wall);
        processor.push_back(samples / times.processor);
    }
};

// Returns the number of hogels that a peer renders within `seconds`, estimated from its minimum number.
std::size_t affordable_hogels(RenderPeer& peer, const HogelRows& rows, double seconds) {
    const std::size_t min_hogels = std::min(peer.min_hogels(), rows.hogels());
    const std::vector<HogelIndex> first = rows.subset(min_hogels);
    peer.render(first);  // allocates memory and compiles programs
    const double seconds_per_hogel = time_of([&] { peer.render(first); }).wall / static_cast<double>(min_hogels);
    const auto batches = static_cast<std::size_t>(std::min(1e9, seconds / seconds_per_hogel)) / min_hogels;
    return std::clamp(batches * min_hogels, min_hogels, rows.hogels());
}

// Returns the fraction of the hogels' rays that hit the scene.
double share_covered(const LightFieldSource& source, const std::vector<HogelIndex>& hogels) {
    std::ptrdiff_t hits = 0;
    std::size_t rays = 0;
    for (const HogelIndex& hogel : hogels) {
        LightFieldTile tile(source.grid(), {hogel.s, hogel.t, 1, 1}, true);
        source.read(tile);
        hits += std::ranges::count_if(tile.depth.elements(), [](float depth) { return std::isfinite(depth); });
        rays += tile.depth.size();
    }
    return static_cast<double>(hits) / static_cast<double>(rays);
}

// Prepares a peer and checks that it renders the same picture. Returns nothing if this machine lacks it.
std::optional<Lane> prepare(const Session& session, const std::string& algorithm, const RenderPeerInfo& info,
                            const ShadedScene& scene, const HogelRows& rows, const LightFieldGrid& grid,
                            double seconds) {
    stop_if_interrupted();
    session.detail(fmt::format("preparing {}", info.name));
    Lane lane;
    try {
        const double initial_bytes = reset_max_memory_held();
        lane.peer = info.make(scene, grid);
        lane.hogels = rows.subset(affordable_hogels(*lane.peer, rows, seconds));
        lane.peer->render(lane.hogels);
        lane.racer = {.name = info.name,
                      .bytes = max_memory_held() - initial_bytes,
                      .hogels = lane.hogels.size(),
                      .differing = differing(rows, *lane.peer, lane.hogels, grid)};
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_built_in) throw;
        session.say(fmt::format("{}: left out, {}", info.name, error.what()));
        return std::nullopt;
    }
    constexpr double max_differing = 0.005;  // along edges
    if (lane.racer.differing > max_differing)
        throw Error(ErrorCode::internal, fmt::format("{} and {} render different pictures: {:.2g} % of samples",
                                                     algorithm, info.name, 100 * lane.racer.differing));
    return lane;
}

Racer result_of(const Lane& lane, const Lane& ours) {
    Racer racer = lane.racer;
    racer.median = median(lane.wall);
    racer.min = std::ranges::min(lane.wall);
    racer.max = std::ranges::max(lane.wall);
    racer.per_processor_second = median(lane.processor);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < lane.wall.size(); ++i) ratios.push_back(ours.wall[i] / lane.wall[i]);
    racer.ours_is_faster = median(ratios);
    return racer;
}

}  // namespace

Race race(const Session& session, const std::string& algorithm, const std::vector<RenderPeerInfo>& peers,
          const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid, const RaceLimits& limits) {
    std::vector<Lane> lanes;
    const double initial_bytes = reset_max_memory_held();
    const auto source = make_renderer(algorithm, scene, grid);
    HogelRows rows(*source, limits.rows);
    rows.render();
    lanes.push_back(
        {{.name = algorithm, .bytes = max_memory_held() - initial_bytes, .hogels = rows.hogels()}, {}, {}, {}, {}});
    for (const RenderPeerInfo& info : peers)
        if (auto lane = prepare(session, algorithm, info, *scene, rows, grid, limits.seconds))
            lanes.push_back(std::move(*lane));
    for (std::size_t round = 0; round < limits.rounds; ++round)
        for (Lane& lane : lanes) {
            stop_if_interrupted();
            lane.add(time_of([&] { lane.peer ? lane.peer->render(lane.hogels) : rows.render(); }), grid);
        }
    constexpr std::size_t sampled_hogels = 8;
    Race result{{}, share_covered(*source, rows.subset(std::min(sampled_hogels, rows.hogels())))};
    for (const Lane& lane : lanes) result.racers.push_back(result_of(lane, lanes.front()));
    return result;
}

}  // namespace hogel::bench
