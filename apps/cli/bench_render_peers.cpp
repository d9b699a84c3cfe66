// SPDX-License-Identifier: Apache-2.0
#include "bench_render_peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bench_render_options.h"
#include "bench_rows.h"
#include "hogel/core/parallel.h"
#include "hogel/renderer.h"
#include "resources.h"

namespace hogel::cli {
namespace {

// Share of samples that differ by more than `tolerance`, which leaves room for a ray that passes an edge on the other
// side, where neighbouring triangles look alike.
double differing(const HogelRows& rows, const RenderPeer& peer, const std::vector<HogelPlace>& hogels,
                 const LightFieldGrid& grid) {
    const float tolerance = 1.0f / 64 + peer.rounding();
    std::size_t different = 0;
    for (std::size_t i = 0; i < hogels.size(); ++i)
        for (std::size_t v = 0; v < grid.directions_v; ++v)
            for (std::size_t u = 0; u < grid.directions_u; ++u) {
                const Rgb ours = rows.sample(hogels[i], v, u), theirs = peer.sample(i, v, u);
                const auto apart = [&](float a, float b) { return std::abs(std::min(a, peer.largest()) - b); };
                different +=
                    std::max({apart(ours.r, theirs.r), apart(ours.g, theirs.g), apart(ours.b, theirs.b)}) > tolerance;
            }
    return static_cast<double>(different) / static_cast<double>(hogels.size() * grid.directions());
}

// A racer with its times.
struct Lane {
    Racer racer;
    std::unique_ptr<RenderPeer> peer;  // null for the renderer
    std::vector<HogelPlace> hogels;
    std::vector<double> wall, processor;

    void add(Times times, const LightFieldGrid& grid) {
        const double samples = 1e-6 * static_cast<double>(racer.hogels * grid.directions());
        wall.push_back(samples / times.wall);
        processor.push_back(samples / times.processor);
    }
};

// As many hogels as a peer can do within the seconds, told from the fewest.
std::size_t affordable_hogels(RenderPeer& peer, const HogelRows& rows, double seconds) {
    const std::size_t fewest = std::min(peer.fewest(), rows.hogels());
    const std::vector<HogelPlace> first = rows.some(fewest);
    peer.render(first);  // memory and programs that are made only once
    const double each = time_of([&] { peer.render(first); }).wall / static_cast<double>(fewest);
    const auto batches = static_cast<std::size_t>(std::min(1e9, seconds / each)) / fewest;
    return std::clamp(batches * fewest, fewest, rows.hogels());
}

// Of the rays of some hogels.
double share_covered(const LightFieldSource& source, const std::vector<HogelPlace>& hogels) {
    std::ptrdiff_t hits = 0;
    std::size_t rays = 0;
    for (const HogelPlace& hogel : hogels) {
        LightFieldTile tile(source.grid(), {hogel.s, hogel.t, 1, 1}, true);
        source.read(tile);
        hits += std::ranges::count_if(tile.depth.elements(), [](float depth) { return std::isfinite(depth); });
        rays += tile.depth.size();
    }
    return static_cast<double>(hits) / static_cast<double>(rays);
}

}  // namespace

Race race(const Session& session, const std::string& algorithm, const std::vector<RenderPeerInfo>& peers,
          const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid, const RaceLimits& limits) {
    std::vector<Lane> lanes;
    const double before = forget_most_memory();
    const auto source = make_renderer(algorithm, scene, grid);
    HogelRows rows(*source, limits.rows);
    rows.render();
    lanes.push_back(
        {{.name = algorithm, .bytes = max_memory_held() - before, .hogels = rows.hogels()}, {}, {}, {}, {}});
    for (const RenderPeerInfo& info : peers) {
        if (interrupted_by() != 0) throw Error(ErrorCode::cancelled, "stopped");
        session.detail(fmt::format("preparing {}", info.name));
        try {
            const double held = forget_most_memory();
            Lane lane;
            lane.peer = info.make(*scene, grid);
            lane.hogels = rows.some(affordable_hogels(*lane.peer, rows, limits.seconds));
            lane.peer->render(lane.hogels);
            lane.racer = {.name = info.name,
                          .bytes = max_memory_held() - held,
                          .hogels = lane.hogels.size(),
                          .differing = differing(rows, *lane.peer, lane.hogels, grid)};
            lanes.push_back(std::move(lane));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::not_built_in) throw;
            session.say(fmt::format("{}: left out, {}", info.name, error.what()));
            continue;
        }
        constexpr double max_differing = 0.005;  // along edges
        const Racer& racer = lanes.back().racer;
        if (racer.differing > max_differing)
            throw Error(ErrorCode::internal, fmt::format("{} and {} see different pictures: {:.2g} % of samples",
                                                         algorithm, racer.name, 100 * racer.differing));
    }
    for (std::size_t round = 0; round < limits.rounds; ++round)
        for (Lane& lane : lanes) {
            if (interrupted_by() != 0) throw Error(ErrorCode::cancelled, "stopped");
            lane.add(time_of([&] { lane.peer ? lane.peer->render(lane.hogels) : rows.render(); }), grid);
        }
    constexpr std::size_t few = 8;
    Race result{{}, share_covered(*source, rows.some(std::min(few, rows.hogels())))};
    for (Lane& lane : lanes) {
        Racer& racer = lane.racer;
        racer.median = median(lane.wall);
        racer.least = std::ranges::min(lane.wall);
        racer.most = std::ranges::max(lane.wall);
        racer.per_processor_second = median(lane.processor);
        std::vector<double> ratios;
        for (std::size_t i = 0; i < limits.rounds; ++i) ratios.push_back(lanes.front().wall[i] / lane.wall[i]);
        racer.renderer_is_faster = median(ratios);
        result.racers.push_back(racer);
    }
    return result;
}

namespace {

// Objects and interiors from few triangles to many.
constexpr std::array peer_scenes{"pumpkin", "chandelier", "church", "pumpkin:10", "church-radiance"};

std::string cell(const Racer& racer) {
    return fmt::format(" {:.3g} ({:.3g}–{:.3g}) |", racer.median, racer.least, racer.most);
}

// Textures are no peer's business.
std::shared_ptr<const ShadedScene> untextured(const std::shared_ptr<const ShadedScene>& scene) {
    auto plain = std::make_shared<ShadedScene>(*scene);
    plain->textures.clear();
    for (ShadedScene::Triangle& triangle : plain->triangles) triangle.texture = ShadedScene::no_texture;
    return plain;
}

void print_head(const std::vector<RenderPeerInfo>& peers, const std::string& algorithm) {
    std::string head = fmt::format("| | hogels | covered | `{}` |", algorithm), line = "|---|---|---|---|";
    for (const RenderPeerInfo& peer : peers) {
        head += fmt::format(" {} | times |", peer.name);
        line += "---|---|";
    }
    fmt::print("{} differ |\n{}---|\n", head, line);
}

void print_row(const std::string& name, const LightFieldGrid& grid, const std::vector<RenderPeerInfo>& peers,
               const Race& race) {
    std::string row = fmt::format("| {} | {}x{} | {:.0f} % |{}", name, grid.hogels_s, grid.hogels_t, 100 * race.covered,
                                  cell(race.racers.front()));
    double worst = 0;
    for (const RenderPeerInfo& peer : peers) {
        const auto racer = std::ranges::find(race.racers, peer.name, &Racer::name);
        const bool there = racer != race.racers.end();
        row += there ? cell(*racer) + fmt::format(" {:.3g} |", racer->renderer_is_faster) : " | |";
        if (there) worst = std::max(worst, racer->differing);
    }
    fmt::print("{} {:.2g} % |\n", row, 100 * worst);
    std::fflush(stdout);
}

}  // namespace

int bench_render_peers(const BenchRenderOptions& options, const Session& session) {
    std::vector<RenderPeerInfo> peers;
    const bool all = std::ranges::all_of(options.peers, &std::string::empty);
    for (const RenderPeerInfo& peer : render_peers())
        if (all || std::ranges::count(options.peers, peer.name) > 0) peers.push_back(peer);
    std::vector<std::string> scenes = options.scenes;
    if (scenes.empty()) scenes.assign(peer_scenes.begin(), peer_scenes.end());
    const std::string algorithm =
        options.algorithms.empty() ? std::string(defaults.algorithm) : options.algorithms.front();
    RaceLimits limits{0, options.rounds, options.own_seconds ? options.limits.seconds : defaults.bench_peer_seconds};

    RenderOptions render = options.render;
    if (!options.own_directions) render.directions = {defaults.bench_peer_directions, defaults.bench_peer_directions};
    std::vector<Counts> hogels{render.hogels};
    if (!options.own_hogels) hogels.insert(hogels.begin(), {defaults.bench_few_hogels, defaults.bench_few_hogels});
    fmt::print(
        "{}x{} directions over {:.4g} degrees, interpolated radiance of vertices, {} threads.\n"
        "Million samples a second, median of {} rounds (least to most); how many times as fast {} is; samples "
        "that differ.\n\n",
        render.directions.columns, render.directions.rows, render.field_of_view.across * 180 / std::numbers::pi,
        thread_count(), limits.rounds, algorithm);
    print_head(peers, algorithm);
    double bytes = 0;
    for (const std::string& name : scenes) {
        render.shading = name == "church-radiance" ? "given" : "vertex";
        const auto scene = untextured(bench_scene(session, name, render));
        for (const Counts& count : hogels) {
            render.hogels = count;
            // In rows that are kept: enough that threads share them evenly, as they would the whole light field.
            constexpr std::size_t max_hogels = 2160, max_rows = 16;
            limits.rows = std::clamp<std::size_t>(max_hogels / count.columns, 1, max_rows);
            const Race result = race(session, algorithm, peers, scene, render.grid(), limits);
            print_row(fmt::format("{}, {} triangles", name, scene->triangles.size()), render.grid(), peers, result);
            bytes = std::max(bytes, result.racers.front().bytes);
            for (const Racer& racer : result.racers)
                session.detail(
                    fmt::format("{}: {} hogels a round, {:.3g} million samples a processor second, {} of "
                                "memory, {:.2g} % of samples differ",
                                racer.name, racer.hogels, racer.per_processor_second, format_bytes(racer.bytes),
                                100 * racer.differing));
        }
    }
    fmt::print("\n{} held at most {} of memory beside the scene's, with the rows of hogels that are compared.\n",
               algorithm, format_bytes(bytes));
    return 0;
}

}  // namespace hogel::cli
