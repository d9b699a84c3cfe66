// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/film.h"
#include "hogel/ray_photograph.h"

#include <algorithm>
#include <optional>

#include "hogel/core/shared_order.h"
#include "hogel/core/shared_plane.h"
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

// A band of rows of the pictures of all cameras.
using Band = std::vector<Array<float, 3>>;

core::Sent<Band> sent_band() {
    return {[](core::MessageWriter& to, const Band& band) {
                to.put(band.size());
                for (const Array<float, 3>& rows : band) to.put(rows);
            },
            [](core::MessageReader& from) {
                Band band(from.get<std::size_t>());
                for (Array<float, 3>& rows : band) rows = from.get_array<float, 3>();
                return band;
            }};
}

// The processes of a team take bands of rows of the pictures, each with the hogels that it shows: as many bands as
// processes, because all pixels take about as long and neighbouring bands show the same hogels. All cameras share the
// reading of these.
void photograph_together(Team& team, const LightField& light_field, std::span<const Camera> cameras,
                         std::size_t lens_points, std::span<const FaceBlock> list, std::span<Image> pictures,
                         const Progress& progress) {
    const auto rows_of = [&](std::size_t band, std::size_t camera) {
        return core::lines_of(band, team.size(), cameras[camera].picture.height, 1);
    };
    core::shared_ordered<Band>(
        team.size(), core::default_in_flight(), sent_band(),
        [&](std::size_t i) {
            std::vector<Exposure> exposures;
            std::size_t top = light_field.grid().hogels_t, bottom = 0;
            for (std::size_t c = 0; c < cameras.size(); ++c) {
                const core::LineRange rows = rows_of(i, c);
                exposures.emplace_back(light_field.grids(), cameras[c], lens_points, rows.first, rows.end());
                const auto [first, end] = exposures.back().cells();
                top = std::min(top, first);
                bottom = std::max(bottom, end);
            }
            std::vector<FaceBlock> some;
            for (const FaceBlock& block : list)
                if (const std::optional<Block> part = part_of(block.block, top, bottom))
                    some.push_back({block.face, *part});
            core::isolate([&] { expose(light_field.faces(), some, 1, exposures, Progress(progress.stop())); });
            Band band;
            for (std::size_t c = 0; c < cameras.size(); ++c) {
                const core::LineRange rows = rows_of(i, c);
                Image picture(cameras[c].picture.width, cameras[c].picture.height, light_field.grid().channels);
                exposures[c].develop(picture);
                band.emplace_back(Shape<3>{rows.count, picture.width(), picture.channels()});
                if (rows.count > 0) std::copy_n(picture.pixels[rows.first].data(), band[c].size(), band[c].data());
            }
            return band;
        },
        [&](std::size_t i, Band& band) {
            for (std::size_t c = 0; c < cameras.size(); ++c)
                if (band[c].size() > 0)
                    std::ranges::copy(band[c].elements(), pictures[c].pixels[rows_of(i, c).first].data());
            progress.report(static_cast<double>(i + 1) / static_cast<double>(team.size()));
        });
    const auto sent = core::sent_array<float, 3>();
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
