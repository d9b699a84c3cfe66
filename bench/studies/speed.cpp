// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/session.h"
#include "bench/studies/studies.h"
#include "hogel/core/parallel.h"
#include "hogel/renderer.h"

namespace hogel::bench {
namespace {

// A sphere with bumps, behind the hologram.
ShadedScene displaced_sphere(std::size_t triangles) {
    const auto around = static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles)));
    const std::size_t down = around / 2;
    ShadedScene scene;
    for (std::size_t j = 0; j <= down; ++j)
        for (std::size_t i = 0; i < around; ++i) {
            const double theta = std::numbers::pi * double(j) / double(down);
            const double phi = 2 * std::numbers::pi * double(i) / double(around);
            const double radius = 2.5e-3 * (1 + 0.08 * std::sin(7 * phi) * std::sin(9 * theta) * std::sin(theta));
            const Vec3 n{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
            scene.positions.push_back(radius * n + Vec3{0, 0, -12e-3});
            scene.radiance.push_back({float(0.5 + 0.5 * n.x), float(0.5 + 0.5 * n.y), float(0.5 + 0.5 * n.z)});
        }
    scene.texture_coordinates.resize(scene.positions.size());
    const auto at = [&](std::size_t j, std::size_t i) { return static_cast<std::uint32_t>(j * around + i % around); };
    for (std::size_t j = 0; j < down; ++j)
        for (std::size_t i = 0; i < around; ++i) {
            scene.triangles.push_back({{at(j, i), at(j + 1, i), at(j + 1, i + 1)}, ShadedScene::no_texture, 0});
            scene.triangles.push_back({{at(j, i), at(j + 1, i + 1), at(j, i + 1)}, ShadedScene::no_texture, 0});
        }
    return scene;
}

// Eight wavy sheets, one behind the other, which fill the view; the first hides the others.
ShadedScene sheets(std::size_t triangles) {
    const std::size_t side = static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles) / 16));
    ShadedScene scene;
    for (std::size_t sheet = 0; sheet < 8; ++sheet) {
        const auto base = static_cast<std::uint32_t>(scene.positions.size());
        for (std::size_t j = 0; j <= side; ++j)
            for (std::size_t i = 0; i <= side; ++i) {
                const double x = 2 * double(i) / double(side) - 1, y = 2 * double(j) / double(side) - 1;
                const double depth = 6e-3 + 1.5e-3 * (double(sheet) + 0.3 * std::sin(9 * x) * std::sin(11 * y));
                scene.positions.push_back({12e-3 * x, 12e-3 * y, -depth});
                scene.radiance.push_back({float(0.5 + 0.5 * x), float(0.5 + 0.5 * y), float(sheet) / 8});
            }
        for (std::uint32_t j = 0; j < side; ++j)
            for (std::uint32_t i = 0; i < side; ++i) {
                const auto width = static_cast<std::uint32_t>(side + 1), at = base + j * width + i;
                scene.triangles.push_back({{at, at + width, at + width + 1}, ShadedScene::no_texture, 0});
                scene.triangles.push_back({{at, at + width + 1, at + 1}, ShadedScene::no_texture, 0});
            }
    }
    scene.texture_coordinates.resize(scene.positions.size());
    return scene;
}

// Samples per second.
struct Speed {
    double wall, processor;
};

// Samples per second of rendering the tiles on all threads.
Speed measure(const LightFieldSource& source, std::vector<LightFieldTile>& tiles) {
    double samples = 0;
    for (const LightFieldTile& tile : tiles)
        samples += static_cast<double>(tile.range.hogels() * source.grid().directions());
    const Times times =
        time_of([&] { core::parallel_for(tiles.size(), [&](std::size_t i) { source.read(tiles[i]); }); });
    return {samples / times.wall, samples / times.processor};
}

// Tiles of that width for two rows of hogels of the grid.
std::vector<LightFieldTile> two_rows(const LightFieldGrid& grid, std::size_t width) {
    std::vector<LightFieldTile> tiles;
    for (std::size_t row = 0; row < 2; ++row)
        for (std::size_t s = 0; s < grid.hogels_s; s += width)
            tiles.emplace_back(
                grid, HogelRange{s, grid.hogels_t / 4 + row * grid.hogels_t / 4, std::min(width, grid.hogels_s - s), 1},
                true);
    return tiles;
}

double percent_covered(const std::vector<LightFieldTile>& tiles) {
    std::ptrdiff_t covered = 0;
    std::size_t rays = 0;
    for (const LightFieldTile& tile : tiles) {
        covered += std::ranges::count_if(tile.depth.elements(), [](float depth) { return std::isfinite(depth); });
        rays += tile.depth.size();
    }
    return 100 * static_cast<double>(covered) / static_cast<double>(rays);
}

}  // namespace

void study_speed(const SpeedStudy& study) {
    std::vector<std::string> names = study.algorithms;
    if (names.empty())
        for (const RendererInfo& info : renderers().rows()) names.emplace_back(info.name);
    const std::size_t hogels = study.hogels, directions = study.directions;
    const std::size_t width = study.tile > 0 ? std::min(study.tile, hogels) : hogels;
    const auto scene = std::make_shared<const ShadedScene>(study.scene == "sheets" ? sheets(study.triangles)
                                                                                   : displaced_sphere(study.triangles));
    const LightFieldGrid grid{hogels, hogels, 8e-3 / double(hogels), directions, directions, Perspective{0.364, 0.364},
                              3};
    std::vector<LightFieldTile> tiles = two_rows(grid, width);
    std::vector<std::unique_ptr<LightFieldSource>> sources;
    for (const std::string& name : names) sources.push_back(make_renderer(name, scene, grid));
    std::vector<std::vector<double>> wall(names.size()), processor(names.size());
    for (std::size_t round = 0; round < study.rounds; ++round)
        for (std::size_t i = 0; i < names.size(); ++i) {
            stop_if_interrupted();
            const Speed speed = measure(*sources[i], tiles);
            wall[i].push_back(speed.wall);
            processor[i].push_back(speed.processor);
        }
    std::printf(
        "%s of %zu triangles, %zux%zu hogels in tiles of %zux1, %zux%zu directions, %.1f%% covered, %zu threads\n",
        study.scene.c_str(), scene->triangles.size(), hogels, hogels, width, directions, directions,
        percent_covered(tiles), thread_count());
    for (std::size_t i = 0; i < names.size(); ++i)
        std::printf("  %-10s %8.2f Msamples/s  %8.2f per processor second  %6.1f times the first\n", names[i].c_str(),
                    1e-6 * median(wall[i]), 1e-6 * median(processor[i]), median(wall[i]) / median(wall[0]));
}

}  // namespace hogel::bench
