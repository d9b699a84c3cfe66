// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_jobs.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "hogel/camera/photograph_plan.h"
#include "hogel/camera/photograph_together.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::pipeline {
namespace {

std::vector<std::size_t> indices_below(std::size_t count) {
    std::vector<std::size_t> indices(count);
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
}

// Reading the hogels of one colour takes as long as the pictures of about two viewpoints.
constexpr std::size_t viewpoints_per_job = 4;

// Returns the cameras of each job of one colour. Pictures with speckle depend on the other cameras if memory is short
// or if they show the surroundings of the hologram; speckle-free pictures depend only on cameras of the same viewpoint.
std::vector<std::vector<std::size_t>> cameras_of_jobs(std::span<const Camera> cameras, const CameraModel& model) {
    if (!std::holds_alternative<SpeckleFreeCamera>(model)) return {indices_below(cameras.size())};
    std::vector<std::vector<std::size_t>> jobs;
    const std::vector<camera::SharedViewpoint> viewpoints = camera::group_by_viewpoint(cameras);
    for (std::size_t i = 0; i < viewpoints.size(); ++i) {
        if (i % viewpoints_per_job == 0) jobs.emplace_back();
        jobs.back().insert(jobs.back().end(), viewpoints[i].members.begin(), viewpoints[i].members.end());
    }
    return jobs;
}

}  // namespace

bool is_made_in_jobs(const Fields& holograms, const CameraModel& model) {
    const auto* const band = std::get_if<BandCamera>(&model);
    const bool from_hogels = band != nullptr ? band->source != BandSource::samples && !band->vertical_diffuser
                                             : std::holds_alternative<SpeckleFreeCamera>(model);
    return from_hogels && std::ranges::all_of(holograms, [](const std::shared_ptr<const FieldSource>& hologram) {
               return hologram->stereogram() != nullptr;
           });
}

std::vector<PictureJob> picture_jobs(const Fields& holograms, std::span<const std::size_t> order,
                                     std::span<const Camera> cameras, std::span<const CameraModel> models) {
    std::vector<PictureJob> jobs;
    for (std::size_t model_index = 0; model_index < models.size(); ++model_index) {
        if (!is_made_in_jobs(holograms, models[model_index])) continue;
        if (!work::is_shared_or_kept()) {
            jobs.push_back({model_index, {order.begin(), order.end()}, indices_below(cameras.size())});
            continue;
        }
        for (const std::size_t colour : order)
            for (const std::vector<std::size_t>& selected : cameras_of_jobs(cameras, models[model_index]))
                jobs.push_back({model_index, {colour}, selected});
    }
    return jobs;
}

std::vector<Image> photograph(const PictureJob& job, const Fields& holograms, std::span<const Camera> cameras,
                              std::span<const CameraModel> models, const Progress& progress) {
    const CameraModel& model = models[job.model_index];
    std::vector<Camera> selected;
    for (const std::size_t camera : job.cameras) selected.push_back(cameras[camera]);
    const auto* const band = std::get_if<BandCamera>(&model);
    auto all_colours = band != nullptr && job.colours.size() == holograms.size()
                           ? camera::photograph_together(holograms, selected, *band, progress)
                           : std::nullopt;
    std::vector<Image> job_pictures;
    for (std::size_t k = 0; k < job.colours.size(); ++k) {
        const std::size_t colour = job.colours[k];
        const Progress part = progress.part(k, job.colours.size());
        std::ranges::move(all_colours ? std::move((*all_colours)[colour])
                                      : hogel::photograph(*holograms[colour], selected, model, part),
                          std::back_inserter(job_pictures));
    }
    return job_pictures;
}

void put(const PictureJob& job, std::span<const Image> job_pictures, std::span<Image> pictures) {
    for (std::size_t i = 0; i < job_pictures.size(); ++i) {
        const std::size_t colour = job.colours[i / job.cameras.size()];
        Image& picture = pictures[job.cameras[i % job.cameras.size()]];
        const std::size_t colours = picture.pixels.extent(2);
        for (std::size_t pixel = 0; pixel < job_pictures[i].pixels.size(); ++pixel)
            picture.pixels.data()[pixel * colours + colour] = job_pictures[i].pixels.data()[pixel];
    }
}

}  // namespace hogel::pipeline
