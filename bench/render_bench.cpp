// SPDX-License-Identifier: Apache-2.0
// Samples a second of every renderer, whole rows of hogels at a time, of a displaced sphere behind the hologram or of
// eight wavy sheets one behind the other, which fill the view and of which the first hides the others.
//   render_bench [sphere|sheets] [triangles=20000] [threads=1] [rounds=5] [hogels=64] [directions=256] [tile=hogels]
//                [names...]
// The renderers take turns in every round, so that whatever else runs on the machine disturbs all alike. Printed: the
// median over the rounds of samples (all channels of a ray are one sample) per second of wall time, and per second of
// processor time.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "hogel/core/parallel.h"
#include "hogel/renderer.h"

namespace {

using namespace hogel;

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

struct Speed {
    double wall, processor;
};

Speed measure(const LightFieldSource& source, std::vector<LightFieldTile>& tiles) {
    double samples = 0;
    for (const LightFieldTile& tile : tiles)
        samples += static_cast<double>(tile.range.hogels() * source.grid().directions());
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    core::parallel_for(tiles.size(), [&](std::size_t i) { source.read(tiles[i]); });
    const double used = double(std::clock() - processor) / CLOCKS_PER_SEC;
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return {samples / wall, samples / used};
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
    const std::string kind = argc > 1 ? argv[1] : "sphere";
    const auto argument = [&](int i, std::size_t otherwise) {
        return i < argc ? std::strtoull(argv[i], nullptr, 10) : otherwise;
    };
    const std::size_t triangles = argument(2, 20000), threads = argument(3, 1), rounds = argument(4, 5);
    const std::size_t hogels = argument(5, 64), directions = argument(6, 256), width = argument(7, hogels);
    std::vector<std::string> names(argv + std::min(argc, 8), argv + argc);
    if (names.empty())
        for (const RendererInfo& info : renderers()) names.emplace_back(info.name);

    const ThreadLimit limit(threads);
    const auto scene =
        std::make_shared<const ShadedScene>(kind == "sheets" ? sheets(triangles) : displaced_sphere(triangles));
    const LightFieldGrid grid{hogels, hogels, 8e-3 / double(hogels), directions, directions, Perspective{0.364, 0.364},
                              3};
    // Rows spread over the hologram, as many hogels for each renderer.
    std::vector<LightFieldTile> tiles;
    for (std::size_t row = 0; row < 2; ++row)
        for (std::size_t s = 0; s < hogels; s += width)
            tiles.emplace_back(grid, HogelRange{s, hogels / 4 + row * hogels / 4, width, 1}, true);

    std::vector<std::unique_ptr<LightFieldSource>> sources;
    for (const std::string& name : names) sources.push_back(make_renderer(name, scene, grid));
    std::vector<std::vector<double>> wall(names.size()), processor(names.size());
    for (std::size_t round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < names.size(); ++i) {
            const Speed speed = measure(*sources[i], tiles);
            wall[i].push_back(speed.wall);
            processor[i].push_back(speed.processor);
        }
    std::size_t covered = 0, all = 0;
    for (const LightFieldTile& tile : tiles)
        for (float depth : tile.depth.elements()) {
            covered += std::isfinite(depth) ? 1 : 0;
            ++all;
        }
    std::printf(
        "%s of %zu triangles, %zux%zu hogels in tiles of %zux1, %zux%zu directions, %.1f%% covered, %zu threads\n",
        kind.c_str(), scene->triangles.size(), hogels, hogels, width, directions, directions,
        100 * double(covered) / double(all), thread_count());
    for (std::size_t i = 0; i < names.size(); ++i)
        std::printf("  %-10s %8.2f Msamples/s  %8.2f per processor second  %6.1f times the first\n", names[i].c_str(),
                    1e-6 * median(wall[i]), 1e-6 * median(processor[i]), median(wall[i]) / median(wall[0]));
}
