// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/film.h"
#include "hogel/ray_photograph.h"

#include <algorithm>
#include <optional>

#include "hogel/core/shared_order.h"
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
    core::parallel_ordered<HeldHogels>(
        list.size(), blocks_at_once, [&](std::size_t i) { return hold(*faces[list[i].face], list[i].block.hogels); },
        [&](std::size_t i, HeldHogels& held) {
            const auto& [face, block] = list[i];
            for (Exposure& exposure : exposures) exposure.add(face, held.block, block.cells);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(list.size()));
        });
}

// Rows of one camera's picture.
struct Band {
    std::size_t camera, first, end;
};

std::vector<Band> bands(std::span<const Camera> cameras, std::size_t processes) {
    // One for each process, because all pixels take about as long and neighbouring bands show the same hogels.
    constexpr std::size_t min_rows = 8;
    std::vector<Band> list;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const std::size_t height = cameras[c].picture.height;
        const std::size_t rows = std::max(min_rows, (height + processes - 1) / processes);
        for (std::size_t first = 0; first < height; first += rows)
            list.push_back({c, first, std::min(first + rows, height)});
    }
    return list;
}

// The processes of a team take bands of rows of the pictures, each with the hogels that it shows.
void photograph_together(Team& team, const LightField& light_field, std::span<const Camera> cameras,
                         std::size_t lens_points, std::span<const FaceBlock> list, std::span<Image> pictures,
                         const Progress& progress) {
    const std::vector<Band> all = bands(cameras, team.size());
    const auto sent = core::sent_array<float, 3>();
    core::shared_ordered<Array<float, 3>>(
        all.size(), core::default_in_flight(), sent,
        [&](std::size_t i) {
            const auto& [camera, first, end] = all[i];
            Exposure exposure(light_field.grids(), cameras[camera], lens_points, first, end);
            const auto [top, bottom] = exposure.cells();
            std::vector<FaceBlock> some;
            for (const FaceBlock& block : list)
                if (const std::optional<Block> part = part_of(block.block, top, bottom))
                    some.push_back({block.face, *part});
            Image picture(cameras[camera].picture.width, cameras[camera].picture.height, light_field.grid().channels);
            core::isolate([&] {
                expose(light_field.faces(), some, 1, {&exposure, 1}, Progress(progress.stop()));
                exposure.develop(picture);
            });
            Array<float, 3> rows({end - first, picture.width(), picture.channels()});
            std::copy_n(picture.pixels[first].data(), rows.size(), rows.data());
            return rows;
        },
        [&](std::size_t i, Array<float, 3>& rows) {
            std::ranges::copy(rows.elements(), pictures[all[i].camera].pixels[all[i].first].data());
            progress.report(static_cast<double>(i + 1) / static_cast<double>(all.size()));
        });
    for (Image& picture : pictures) core::share_result(picture.pixels, sent);
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
    if (Team* const all = core::team_of_several())
        return photograph_together(*all, light_field, cameras, std::max<std::size_t>(options.pupil_samples, 1), list,
                                   pictures, progress);
    expose(faces, list, thread_count(), exposures, progress);
    for (std::size_t i = 0; i < exposures.size(); ++i) exposures[i].develop(pictures[i]);
}

}  // namespace hogel
