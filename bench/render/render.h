// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/render/region_times.h"
#include "bench/scene.h"

namespace hogel::bench {

/// Defaults of `hogel-bench render` in its help.
struct RenderDefaults {
    std::size_t hogels = 360, directions = 128;
    std::size_t tiles_across = 64;  ///< --tiles, each of 4x4 hogels
    std::size_t few_hogels = 64;    ///< hogels along a side: --scaling, and first table row of a scene with --peers
    std::size_t stream_hogels = 512;
    std::size_t many_directions = 256;  ///< --peers, --stream
    double seconds = 8;                 ///< limit for a region
    std::size_t dense_across = 1440;    ///< --dense: number of hogels across the whole width
    std::size_t dense_side = 128;       ///< --dense: the largest region
    double dense_seconds = 30;          ///< --dense: limit for a region
    double peer_seconds = 1;            ///< limit for a peer in a round
};
inline constexpr RenderDefaults render_defaults;

/// Options of `hogel-bench render`. The defaults of options that are not given depend on the measurement.
struct RenderOptions {
    std::string output;   ///< folder for plots; empty: none
    std::string shading;  ///< empty: the shading of the thesis for its scenes, `vertex` for others
    std::vector<std::string> scenes, algorithms;
    std::vector<std::string> peers;  ///< for measure_peers(); empty, or only empty names: all
    std::optional<Counts> hogels, directions;
    std::optional<double> seconds, cache_spacing;
    double size = 20_mm;
    Angles field_of_view{40_deg, 40_deg};
    std::optional<std::size_t> max_side;  ///< of a region, in hogels; 128 if not given
    double gigabytes = 6;                 ///< limit for a region, see RegionLimits
    std::size_t rounds = 5;

    /// @param default_hogels, default_directions  counts along a side, used if they are not given
    LightFieldOptions light_field(std::size_t default_hogels, std::size_t default_directions) const;
    /// Returns the requested shading model, or the one of the thesis for its scene.
    std::string shading_of(const std::string& scene) const;
    /// Returns the first of the algorithms.
    std::string algorithm() const { return algorithms.empty() ? default_algorithm : algorithms.front(); }
    /// Creates the folder for plots, if there is one.
    void prepare_output() const;
    /// Writes a plot as KIND_SCENE.svg, if there is a folder for plots.
    void write_plot(const std::string& kind, const std::string& scene, const PlotText& text,
                    const std::vector<Curve>& curves) const;
};

/// Returns a shaded scene, moved behind the hologram, where every renderer can see it. A name like `pumpkin:10` is the
/// scene with each triangle cut into 10² parts.
std::shared_ptr<const ShadedScene> bench_scene(const Session& session, const std::string& name,
                                               const LightFieldOptions& options);

/// Prints the time of renderers per hogel against the side of the region that is rendered at once.
void measure_regions(const RenderOptions& options, const Session& session);
/// `--dense`: measures as measure_regions() with hogels so close that a point moves less than a direction from one to
/// the next ([K] 5.8). Draws the curves of [K] and of other renderers in panels with linear and logarithmic times.
void measure_dense(const RenderOptions& options, const Session& session);
/// Returns the scenes of [K] fig. 5.26 to 5.30.
std::vector<std::string> thesis_scene_names();
/// `--interpolation`: prints the loss of quality and the time of interpolation between viewpoints,
/// make_interpolating_renderer(), against `simplex`, by shading model and side of the regions.
void measure_interpolation(const RenderOptions& options, const Session& session);
/// `--peers`: prints the speed of other projects' renderers beside one of hogel's, row by row.
void measure_peers(const RenderOptions& options, const Session& session);
/// `--scaling`: prints the growth of time with hogels, directions and triangles, the gain of a second thread, and the
/// speed relative to plain memory writes.
void measure_scaling(const RenderOptions& options, const Session& session);
/// `--tiles`: prints the processor time of each tile of a light field in microseconds, row-major. The costs differ by
/// much; they serve to judge a division of work among processes.
void measure_tiles(const RenderOptions& options, const Session& session);
/// `--stream`: prints the time of whole light fields, which may be larger than memory and are not kept.
void measure_stream(const RenderOptions& options, const Session& session);

}  // namespace hogel::bench
