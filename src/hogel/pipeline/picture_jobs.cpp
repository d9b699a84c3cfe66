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

std::vector<std::size_t> numbers_below(std::size_t count) {
    std::vector<std::size_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
}

// Reading the hogels of a colour takes as long as the pictures of about two eyes.
constexpr std::size_t eyes_per_job = 4;

// The cameras of each job of one colour. Pictures of looks depend on the other cameras where memory is short or where
// they show the surroundings of the hologram; pictures without speckle depend on those of the same eye only.
std::vector<std::vector<std::size_t>> cameras_of_jobs(std::span<const Camera> cameras, const CameraModel& model) {
    if (!std::holds_alternative<SpeckleFreeCamera>(model)) return {numbers_below(cameras.size())};
    std::vector<std::vector<std::size_t>> jobs;
    const std::vector<camera::SharedViewpoint> eyes = camera::group_by_viewpoint(cameras);
    for (std::size_t e = 0; e < eyes.size(); ++e) {
        if (e % eyes_per_job == 0) jobs.emplace_back();
        jobs.back().insert(jobs.back().end(), eyes[e].members.begin(), eyes[e].members.end());
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
                                     std::span<const Camera> cameras, std::span<const CameraModel> ways) {
    std::vector<PictureJob> jobs;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        if (!is_made_in_jobs(holograms, ways[way])) continue;
        if (!work::is_shared_or_kept()) {
            jobs.push_back({way, {order.begin(), order.end()}, numbers_below(cameras.size())});
            continue;
        }
        for (const std::size_t colour : order)
            for (const std::vector<std::size_t>& some : cameras_of_jobs(cameras, ways[way]))
                jobs.push_back({way, {colour}, some});
    }
    return jobs;
}

std::vector<Image> photograph(const PictureJob& job, const Fields& holograms, std::span<const Camera> cameras,
                              std::span<const CameraModel> ways, const Progress& progress) {
    const CameraModel& model = ways[job.way];
    std::vector<Camera> some;
    for (const std::size_t camera : job.cameras) some.push_back(cameras[camera]);
    const auto* const band = std::get_if<BandCamera>(&model);
    auto together = band != nullptr && job.colours.size() == holograms.size()
                        ? camera::photograph_together(holograms, some, *band, progress)
                        : std::nullopt;
    std::vector<Image> made;
    for (std::size_t k = 0; k < job.colours.size(); ++k) {
        const std::size_t colour = job.colours[k];
        const Progress part = progress.part(k, job.colours.size());
        std::ranges::move(
            together ? std::move((*together)[colour]) : hogel::photograph(*holograms[colour], some, model, part),
            std::back_inserter(made));
    }
    return made;
}

void put(const PictureJob& job, std::span<const Image> made, std::span<Image> pictures) {
    for (std::size_t i = 0; i < made.size(); ++i) {
        const std::size_t colour = job.colours[i / job.cameras.size()];
        Image& picture = pictures[job.cameras[i % job.cameras.size()]];
        const std::size_t colours = picture.pixels.extent(2);
        for (std::size_t pixel = 0; pixel < made[i].pixels.size(); ++pixel)
            picture.pixels.data()[pixel * colours + colour] = made[i].pixels.data()[pixel];
    }
}

}  // namespace hogel::pipeline
