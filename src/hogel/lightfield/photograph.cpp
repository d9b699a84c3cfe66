// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/film.h"
#include "hogel/ray_photograph.h"

#include <algorithm>

#include "hogel/core/parallel.h"
#include "hogel/lightfield/exposure.h"
#include "hogel/lightfield/ray_blocks.h"

namespace hogel {
namespace {

using lightfield::Block;
using lightfield::Exposure;
using lightfield::HeldHogels;
using lightfield::hold;

struct FaceBlock {
    std::size_t face;
    Block block;
};

}  // namespace

std::vector<Image> photograph(const LightField& light_field, std::span<const Camera> cameras,
                              const RayPhotographOptions& options, const Progress& progress) {
    std::vector<Image> pictures(cameras.size());
    photograph_into(light_field, cameras, options, pictures, progress);
    return pictures;
}

void photograph_into(const LightField& light_field, std::span<const Camera> cameras,
                     const RayPhotographOptions& options, std::span<Image> pictures, const Progress& progress) {
    const core::StopScope scope(progress);
    image::require_a_picture_for_each(cameras, pictures);
    const std::vector<LightFieldGrid> grids = light_field.grids();
    const std::span<const LightField::Source> faces = light_field.faces();
    std::vector<Exposure> exposures;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Camera& camera = cameras[i];
        lightfield::require_ray_camera(camera);
        exposures.emplace_back(grids, camera, std::max<std::size_t>(options.pupil_samples, 1));
    }
    image::load_film(cameras, light_field.grid().channels, light_field.provenance(), pictures);
    std::vector<FaceBlock> list;
    for (std::size_t face = 0; face < faces.size(); ++face)
        for (const Block& block : lightfield::blocks(grids[face])) list.push_back({face, block});
    // Reading may involve rendering, so several blocks are read in parallel; they are added in order. What is in memory
    // is looked at where it is.
    core::parallel_ordered<HeldHogels>(
        list.size(), thread_count(), [&](std::size_t i) { return hold(*faces[list[i].face], list[i].block.hogels); },
        [&](std::size_t i, HeldHogels& held) {
            const auto& [face, block] = list[i];
            for (Exposure& exposure : exposures) exposure.add(face, held.block, block.cells);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(list.size()));
        });
    for (std::size_t i = 0; i < exposures.size(); ++i) exposures[i].develop(pictures[i]);
}

}  // namespace hogel
