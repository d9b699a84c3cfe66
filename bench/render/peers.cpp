// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "bench/render/race.h"
#include "bench/render/render.h"
#include "hogel/resources.h"

namespace hogel::bench {
namespace {

// Objects and interiors from few triangles to many.
constexpr std::array peer_scenes{"pumpkin", "chandelier", "church", "pumpkin:10", "church-radiance"};

std::string cell(const Racer& racer) {
    return fmt::format(" {:.3g} ({:.3g}–{:.3g}) |", racer.median, racer.min, racer.max);
}

// Returns the scene without textures, which peers do not draw.
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
        const bool found = racer != race.racers.end();
        row += found ? cell(*racer) + fmt::format(" {:.3g} |", racer->ours_is_faster) : " | |";
        if (found) worst = std::max(worst, racer->differing);
    }
    fmt::print("{} {:.2g} % |\n", row, 100 * worst);
    std::fflush(stdout);
}

}  // namespace

void measure_peers(const RenderOptions& options, const Session& session) {
    std::vector<RenderPeerInfo> peers;
    const bool all = std::ranges::all_of(options.peers, &std::string::empty);
    for (const RenderPeerInfo& peer : render_peers())
        if (all || std::ranges::count(options.peers, peer.name) > 0) peers.push_back(peer);
    std::vector<std::string> scenes = options.scenes;
    if (scenes.empty()) scenes.assign(peer_scenes.begin(), peer_scenes.end());
    const std::string algorithm = options.algorithm();
    RaceLimits limits{0, options.rounds, options.seconds.value_or(render_defaults.peer_seconds)};

    LightFieldOptions light_field = options.light_field(render_defaults.hogels, render_defaults.many_directions);
    std::vector<Counts> hogels{light_field.hogels};
    if (!options.hogels) hogels.insert(hogels.begin(), {render_defaults.few_hogels, render_defaults.few_hogels});
    fmt::print(
        "{}x{} directions over {:.4g} degrees, interpolated radiance of vertices, {} threads.\n"
        "Million samples a second, median of {} rounds (least to most); how many times as fast {} is; samples "
        "that differ.\n\n",
        light_field.directions.columns, light_field.directions.rows,
        light_field.field_of_view.across * 180 / std::numbers::pi, thread_count(), limits.rounds, algorithm);
    print_head(peers, algorithm);
    double bytes = 0;
    for (const std::string& name : scenes) {
        light_field.shading = name == "church-radiance" ? "given" : "vertex";
        const auto scene = untextured(bench_scene(session, name, light_field));
        for (const Counts& count : hogels) {
            light_field.hogels = count;
            // Enough rows for the same load balance among threads as with the whole light field.
            constexpr std::size_t max_hogels = 2160, max_rows = 16;
            limits.rows = std::clamp<std::size_t>(max_hogels / count.columns, 1, max_rows);
            const LightFieldGrid grid = light_field.grid();
            const Race result = race(session, algorithm, peers, scene, grid, limits);
            print_row(fmt::format("{}, {} triangles", name, scene->triangles.size()), grid, peers, result);
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
}

}  // namespace hogel::bench
