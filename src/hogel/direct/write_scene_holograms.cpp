// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/shared_order.h"
#include "hogel/core/shared_tiles.h"
#include "hogel/error.h"
#include "hogel/scene_hologram.h"

namespace hogel {

void write_scene_holograms(const SceneHologramMethod& method, const ShadedScene& scene,
                           std::span<const FieldGrid> grids, std::span<const SceneHologramOptions> options,
                           std::span<const std::unique_ptr<FieldSink>> sinks, const Progress& progress) {
    const core::StopScope scope(progress);
    if (options.size() != grids.size() || sinks.size() != grids.size())
        throw Error(ErrorCode::usage, "holograms of a scene need options and a sink for each wavelength");
    const auto make = [&](std::size_t i) {
        return method.make(scene, grids[i], options[i], progress.part(i, grids.size()));
    };
    Team* const all = core::team_of_several();
    if (all == nullptr) {
        for (std::size_t i = 0; i < grids.size(); ++i) copy(make(i), *sinks[i]);
        return;
    }
    // A method makes a field as a whole, with all threads of a process.
    core::TileQueue queue(*all, all->next_number(), grids.size());
    while (const std::optional<std::size_t> i = queue.next()) {
        const Field field = make(*i);
        const Grid& plane = grids[*i].plane;
        constexpr std::size_t rows = 256;
        for (std::size_t y = 0; y < plane.height; y += rows) {
            const std::size_t height = std::min(rows, plane.height - y);
            sinks[*i]->write({0, y, plane.width, height},
                             View<const std::complex<float>, 2>(&field.samples(y, 0), {height, plane.width}));
        }
    }
    for (const auto& sink : sinks) sink->finish();
}

}  // namespace hogel
