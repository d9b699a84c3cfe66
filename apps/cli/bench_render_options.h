// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench_render.h"
#include "inputs.h"

namespace hogel::cli {

/// What `hogel bench render` was asked.
struct BenchRenderOptions {
    std::string output, shading;
    std::vector<std::string> scenes, algorithms;
    RenderOptions render;
    RegionLimits limits{defaults.bench_largest_region, defaults.bench_seconds, 1e9 * defaults.bench_gigabytes};
    double gigabytes = defaults.bench_gigabytes;
    std::vector<std::string> peers;
    bool scaling = false, stream = false;
    std::size_t rounds = defaults.bench_rounds;
    bool own_hogels = false, own_directions = false, own_seconds = false,
         own_spacing = false;  ///< whether the user gave them
};

/// The model of shading that was asked for, or the one that the thesis used for its scene.
std::string bench_shading(const std::string& scene, const BenchRenderOptions& options);

/// A scene pushed behind the hologram, where every renderer can see it, lit. A name like `pumpkin:10` stands for the
/// scene whose triangles are each cut into 10² ones.
std::shared_ptr<const ShadedScene> bench_scene(const Session& session, const std::string& name,
                                               const RenderOptions& render);

/// `--peers`: a table, a row as soon as it is there.
int bench_render_peers(const BenchRenderOptions& options, const Session& session);
/// `--scaling`: how the time grows with hogels, directions and triangles, what a second thread gains, and how far the
/// renderer is from the speed of plain writing.
int bench_render_scaling(const BenchRenderOptions& options, const Session& session);
/// `--stream`: whole light fields, larger than memory, into a sink that consumes them.
int bench_render_stream(const BenchRenderOptions& options, const Session& session);

}  // namespace hogel::cli
