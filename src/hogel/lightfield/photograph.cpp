// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/film.h"
#include "hogel/ray_photograph.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "hogel/core/pieces.h"
#include "hogel/core/shared_order.h"
#include "hogel/core/shared_plane.h"
#include "hogel/core/speeds.h"
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

// The part of a block whose cells begin in rows [first, end) of hogels; nothing if there is none.
std::optional<Block> part_of(const Block& block, std::size_t first, std::size_t end) {
    const std::size_t t0 = std::max(block.cells.t0, first), t1 = std::min(block.cells.t0 + block.cells.nt, end);
    if (t0 >= t1) return std::nullopt;
    Block part = block;
    part.cells.t0 = part.hogels.t0 = t0;
    part.cells.nt = t1 - t0;
    part.hogels.nt = std::min(part.cells.nt + 1, block.hogels.t0 + block.hogels.nt - t0);
    return part;
}

// Exposes films to the rays of blocks of hogels, in their order. Reading may involve rendering, so several blocks are
// read in parallel. What is in memory is looked at where it is.
void expose(std::span<const LightField::Source> faces, std::span<const FaceBlock> list, std::size_t blocks_at_once,
            std::span<Exposure> exposures, const Progress& progress) {
    for (Exposure& exposure : exposures) exposure.keep_rays(lightfield::max_kept_rays / exposures.size());
    core::parallel_ordered<HeldHogels>(
        list.size(), blocks_at_once, [&](std::size_t i) { return hold(*faces[list[i].face], list[i].block.hogels); },
        [&](std::size_t i, HeldHogels& held) {
            const auto& [face, block] = list[i];
            for (Exposure& exposure : exposures) exposure.add(face, held.block, block.cells);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(list.size()));
        });
}

// The processes of a team take bands of rows of the pictures, each with the hogels that it shows: as many bands as
// processes, of as many rows as each is fast, because all pixels take about as long and neighbouring bands show the
// same hogels. All cameras share the reading of these.
void photograph_together(Team& team, const LightField& light_field, std::span<const Camera> cameras,
                         std::size_t lens_points, std::span<const FaceBlock> list, std::span<Image> pictures,
                         const Progress& progress) {
    const std::vector<double> speeds = core::speeds_of_processes(team);
    const auto rows_of = [&](std::size_t process, std::size_t camera) {
        return core::lines_in_parts(speeds, process, cameras[camera].picture.height);
    };
    std::vector<Exposure> exposures;
    std::size_t top = light_field.grid().hogels_t, bottom = 0;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const core::LineRange rows = rows_of(team.rank(), c);
        exposures.emplace_back(light_field.grids(), cameras[c], lens_points, rows.first, rows.end());
        const auto [first, end] = exposures.back().cells();
        top = std::min(top, first);
        bottom = std::max(bottom, end);
    }
    std::vector<FaceBlock> some;
    for (const FaceBlock& block : list)
        if (const std::optional<Block> part = part_of(block.block, top, bottom)) some.push_back({block.face, *part});
    expose(light_field.faces(), some, thread_count(), exposures, progress);
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        exposures[c].develop(pictures[c]);
        core::share_lines(team, pictures[c].pixels.data(), pictures[c].pixels[0].size(),
                          [&](std::size_t process) { return rows_of(process, c); });
    }
}

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
    for (const Camera& camera : cameras) lightfield::require_ray_camera(camera);
    image::load_film(cameras, light_field.grid().channels, light_field.provenance(), pictures);
    std::vector<FaceBlock> list;
    for (std::size_t face = 0; face < faces.size(); ++face)
        for (const Block& block : lightfield::blocks(grids[face])) list.push_back({face, block});
    const std::size_t lens_points = std::max<std::size_t>(options.pupil_samples, 1);
    const auto expose_all = [&](std::span<Image> films) {
        if (Team* const all = core::team_of_several())
            return photograph_together(*all, light_field, cameras, lens_points, list, films, progress);
        std::vector<Exposure> exposures;
        for (const Camera& camera : cameras) exposures.emplace_back(grids, camera, lens_points);
        expose(faces, list, thread_count(), exposures, progress);
        for (std::size_t i = 0; i < exposures.size(); ++i) exposures[i].develop(films[i]);
    };
    if (core::result_log() == nullptr) return expose_all(pictures);
    core::kept_one_by_one<std::vector<Image>>(
        1, image::sent_pictures(),
        [&](std::size_t) {
            std::vector<Image> made(pictures.begin(), pictures.end());
            expose_all(made);
            return made;
        },
        [&](std::size_t, std::vector<Image>& made) {
            for (std::size_t i = 0; i < pictures.size(); ++i)
                std::ranges::copy(made[i].pixels.elements(), pictures[i].pixels.data());
        });
    if (Team* const all = core::team_of_several())
        for (Image& picture : pictures) core::share_in_pieces<float>(*all, picture.pixels.elements());
}

}  // namespace hogel
