// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_jobs.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "hogel/core/shared_order.h"
#include "hogel/optics/eye_light.h"
#include "hogel/optics/photograph_plan.h"
#include "hogel/optics/photograph_together.h"

namespace hogel::pipeline {
namespace {

std::vector<std::size_t> numbers_below(std::size_t count) {
    std::vector<std::size_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
}

// Pictures without speckle by one eye do not depend on those by others. Those of looks do, where memory is short or
// pictures show the hologram's surroundings.
std::vector<std::vector<std::size_t>> cameras_of_jobs(std::span<const Camera> cameras,
                                                      const PhotographOptions& options) {
    if (!options.expected) return {numbers_below(cameras.size())};
    std::vector<std::vector<std::size_t>> groups;
    for (const optics::SharedEye& eye : optics::group_by_eye(cameras)) groups.push_back(eye.members);
    return groups;
}

}  // namespace

bool is_made_in_jobs(const Fields& holograms, const WaveCamera& with) {
    const auto* const options = std::get_if<PhotographOptions>(&with);
    return options != nullptr && options->from != LightFrom::samples && !options->vertical_diffuser &&
           std::ranges::all_of(holograms, [](const std::shared_ptr<const FieldSource>& hologram) {
               return dynamic_cast<const optics::EyeLight*>(hologram.get()) != nullptr;
           });
}

std::vector<PictureJob> picture_jobs(const Fields& holograms, std::span<const std::size_t> order,
                                     std::span<const Camera> cameras, std::span<const WaveCamera> ways) {
    std::vector<PictureJob> jobs;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        if (!is_made_in_jobs(holograms, ways[way])) continue;
        const auto& options = std::get<PhotographOptions>(ways[way]);
        if (!core::is_shared_or_kept()) {
            jobs.push_back({way, {order.begin(), order.end()}, numbers_below(cameras.size())});
            continue;
        }
        for (const std::size_t colour : order)
            for (const std::vector<std::size_t>& some : cameras_of_jobs(cameras, options))
                jobs.push_back({way, {colour}, some});
    }
    return jobs;
}

std::vector<Image> photograph(const PictureJob& job, const Fields& holograms, std::span<const Camera> cameras,
                              std::span<const WaveCamera> ways, const Progress& progress) {
    const auto& options = std::get<PhotographOptions>(ways[job.way]);
    std::vector<Camera> some;
    for (const std::size_t camera : job.cameras) some.push_back(cameras[camera]);
    auto together = job.colours.size() == holograms.size()
                        ? optics::photograph_together(holograms, some, options, progress)
                        : std::nullopt;
    std::vector<Image> made;
    for (std::size_t k = 0; k < job.colours.size(); ++k) {
        const std::size_t colour = job.colours[k];
        const Progress part = progress.part(k, job.colours.size());
        std::ranges::move(
            together ? std::move((*together)[colour]) : hogel::photograph(*holograms[colour], some, options, part),
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
