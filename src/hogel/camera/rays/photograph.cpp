// SPDX-License-Identifier: Apache-2.0
#include "hogel/photograph.h"
#include "hogel/image/film.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "hogel/camera/rays/exposure.h"
#include "hogel/camera/rays/ray_blocks.h"
#include "hogel/core/rates.h"
#include "hogel/core/stop_scope.h"
#include "hogel/work/chunks.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {
namespace {

using camera::rays::Block;
using camera::rays::Exposure;
using camera::rays::LoadedHogels;

struct FaceBlock {
    std::size_t face;
    Block block;
};

// Exposes films to blocks of hogels, in order. Reads several blocks in parallel, because reading may render.
void expose(std::span<const LightField::Source> faces, std::span<const FaceBlock> list, std::size_t blocks_at_once,
            std::span<camera::rays::Exposure> exposures, const Progress& progress) {
    for (camera::rays::Exposure& exposure : exposures)
        exposure.cache_rays(camera::rays::max_cached_ray_bytes / exposures.size());
    work::local_ordered_reduce<camera::rays::LoadedHogels>(
        list.size(), blocks_at_once,
        [&](std::size_t i) { return camera::rays::load_hogels(*faces[list[i].face], list[i].block.hogels); },
        [&](std::size_t i, camera::rays::LoadedHogels& loaded) {
            const auto& [face, block] = list[i];
            for (camera::rays::Exposure& exposure : exposures) exposure.add(face, loaded.block, block.cells);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(list.size()));
        });
}

struct CameraRange {
    std::size_t first = 0, count = 0;
};

// Returns groups of cameras. One MPI rank photographs a group, which shares the reading of hogels, so there is a group
// per rank. With a result log there is only one group, independent of the number of ranks.
std::vector<CameraRange> groups_of(std::size_t cameras) {
    const Communicator* const communicator = work::communicator_of_several();
    const std::size_t groups =
        communicator == nullptr || work::result_log() != nullptr ? 1 : std::min(communicator->size(), cameras);
    std::vector<CameraRange> list;
    for (std::size_t i = 0; i < groups; ++i)
        list.push_back({i * cameras / groups, (i + 1) * cameras / groups - i * cameras / groups});
    return list;
}

}  // namespace

std::vector<Image> photograph(const LightField& light_field, std::span<const Camera> cameras, const RayCamera& model,
                              const Progress& progress) {
    std::vector<Image> pictures(cameras.size());
    photograph_into(light_field, cameras, model, pictures, progress);
    return pictures;
}

Image photograph(const LightField& light_field, const Camera& camera, const RayCamera& model,
                 const Progress& progress) {
    return std::move(photograph(light_field, std::span(&camera, 1), model, progress).front());
}

void photograph_into(const LightField& light_field, std::span<const Camera> cameras, const RayCamera& model,
                     std::span<Image> pictures, const Progress& progress) {
    const core::StopScope scope(progress);
    image::require_a_picture_for_each(cameras, pictures);
    const std::vector<LightFieldGrid> grids = light_field.grids();
    const std::span<const LightField::Source> faces = light_field.faces();
    for (const Camera& camera : cameras) camera::rays::require_ray_camera(camera);
    image::load_film(cameras, light_field.grid().channels, light_field.provenance(), pictures);
    std::vector<FaceBlock> list;
    for (std::size_t face = 0; face < faces.size(); ++face)
        for (const Block& block : camera::rays::blocks(grids[face])) list.push_back({face, block});
    const std::size_t lens_points = std::max<std::size_t>(model.pupil_samples, 1);
    const std::vector<CameraRange> groups = groups_of(cameras.size());
    work::shared_jobs<std::vector<Image>>(
        groups.size(), image::sent_pictures(),
        [&](std::size_t i) {
            const auto [first, count] = groups[i];
            std::vector<camera::rays::Exposure> exposures;
            for (const Camera& camera : cameras.subspan(first, count))
                exposures.emplace_back(grids, camera, lens_points);
            expose(faces, list, thread_count(), exposures, progress.part(i, groups.size()));
            std::vector<Image> group_pictures(count);
            for (std::size_t k = 0; k < count; ++k) {
                group_pictures[k].pixels = std::move(pictures[first + k].pixels);  // reuses its memory
                exposures[k].develop(group_pictures[k]);
            }
            return group_pictures;
        },
        [&](std::size_t i, std::vector<Image>& group_pictures) {
            for (std::size_t k = 0; k < group_pictures.size(); ++k)
                pictures[groups[i].first + k].pixels = std::move(group_pictures[k].pixels);
        });
    Communicator* const communicator = work::communicator_of_several();
    for (std::size_t i = 0; i < pictures.size() && communicator != nullptr; ++i) {
        Array<float, 3>& pixels = pictures[i].pixels;
        const Grid& picture = cameras[i].picture;
        if (!communicator->is_root())
            pixels = Array<float, 3>({picture.height, picture.width, light_field.grid().channels});
        work::broadcast_in_chunks<float>(*communicator, pixels.elements());
    }
}

Plan plan_ray_photographs(std::span<const LightFieldGrid> faces, std::span<const Camera> cameras,
                          const RayCamera& model) {
    namespace rates = core::rates;
    double hogels = 0;
    for (const LightFieldGrid& face : faces) hogels += static_cast<double>(face.hogels());
    const auto points = static_cast<double>(std::max<std::size_t>(model.pupil_samples, 1));
    Plan plan;
    plan.memory = static_cast<double>(thread_count() + 1) * camera::rays::max_block_bytes;  // hogels in flight
    for (const Camera& camera : cameras) {
        const auto pixels = static_cast<double>(camera.picture.samples());
        const double rays = points * static_cast<double>(camera::rays::bytes_of_rays(faces.front(), camera));
        const std::size_t cached_bytes_per_camera = camera::rays::max_cached_ray_bytes / cameras.size();
        const bool are_cached = rays <= static_cast<double>(cached_bytes_per_camera);
        plan.memory += points * sizeof(Exposure::LensPoint) +
                       pixels * static_cast<double>(faces.front().channels) * sizeof(float) + (are_cached ? rays : 0);
        plan.seconds += rates::on_all_threads(points * (hogels * rates::seen_hogel + pixels * rates::seen_pixel));
    }
    return plan;
}

}  // namespace hogel
