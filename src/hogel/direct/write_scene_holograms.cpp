// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/scene_hologram.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {
namespace {

void write_rows(const Field& field, FieldSink& sink) {
    const Grid& plane = field.grid().plane;
    constexpr std::size_t rows = 64;
    work::parallel_for((plane.height - 1) / rows + 1, [&](std::size_t i) {
        const Region region{0, i * rows, plane.width, std::min(rows, plane.height - i * rows)};
        if (!sink.has_already(region))
            sink.write(region, {&field.samples(region.y0, 0), {region.height, region.width}});
    });
}

}  // namespace

void write_scene_holograms(const SceneHologramMethod& method, const ShadedScene& scene,
                           std::span<const FieldGrid> grids, std::span<const SceneHologramOptions> options,
                           std::span<const std::unique_ptr<FieldSink>> sinks, const Progress& progress) {
    const core::StopScope scope(progress);
    if (options.size() != grids.size() || sinks.size() != grids.size())
        throw Error(ErrorCode::usage, "scene holograms: expected one set of options and one sink for each wavelength");
    const work::JobScope saved_by_sinks(work::DoneBy::all_ranks);
    work::shared_jobs<std::uint8_t>(
        grids.size(), {},
        [&](std::size_t i) {
            write_rows(method.make(scene, grids[i], options[i], progress.part(i, grids.size())), *sinks[i]);
            return std::uint8_t{1};
        },
        [](std::size_t, std::uint8_t&) {});
    for (const auto& sink : sinks) sink->finish();
}

}  // namespace hogel
