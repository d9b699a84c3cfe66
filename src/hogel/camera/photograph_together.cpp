// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/photograph_together.h"

#include <algorithm>

#include "hogel/camera/exposed_bands.h"
#include "hogel/camera/hogel_spectra/hogel_band_source.h"
#include "hogel/camera/photograph_plan.h"
#include "hogel/core/stop_scope.h"
#include "hogel/image/film.h"

namespace hogel::camera {
namespace {

// Returns nothing if colours cannot share rays, or their bands do not fit into memory or cost more time than rays.
std::optional<ColourBands> bands_of_colours(std::span<const std::shared_ptr<const FieldSource>> colours,
                                            std::span<const Camera> cameras, const BandCamera& model) {
    if (colours.size() < 2 || cameras.empty() || model.vertical_diffuser || model.source == BandSource::samples)
        return {};
    std::vector<const stereogram::Stereogram*> stereograms;
    PhotographPlan plan;
    const auto memory = static_cast<double>(model.memory);
    for (const auto& colour : colours) {
        stereograms.push_back(colour->stereogram());
        if (stereograms.back() == nullptr || colour->looks() != colours.front()->looks()) return {};
        PhotographPlan colour_plan = plan_photographs(colour->grid(), cameras, memory);
        if (colour_plan.passes.size() != 1 || colour_plan.windows.size() != 1) return {};
        if (colour_plan.bytes > plan.bytes) plan = std::move(colour_plan);
    }
    ColourBands bands{{},
                      {},
                      group_by_viewpoint(cameras, plan.passes.front()),
                      plan.windows.front().shown,
                      colours.front()->looks(),
                      1,
                      model.preview};
    for (const auto& colour : colours) bands.colours.push_back(colour->grid());
    const Grid& plane = bands.colours.front().plane;
    bands.source = hogel_spectra::make_hogel_band_source_of_colours(
        stereograms, {0, 0, plane.width, plane.height}, viewpoints_of(bands.viewpoints, cameras, model.preview));
    if (!bands.source) return {};
    double bytes_per_look = 0;
    for (std::size_t band = 0; band < colours.size() * bands.viewpoints.size(); ++band)
        bytes_per_look += bands.source->bytes_per_look(band);
    const double bytes_per_colour =
        bytes_per_look * static_cast<double>(bands.looks) / static_cast<double>(colours.size());
    if (!renders_colours_together(bytes_per_colour, plane) || plan.bytes + bytes_per_look > memory) return {};
    bands.looks_at_once = std::min(bands.looks, static_cast<std::size_t>((memory - plan.bytes) / bytes_per_look));
    return bands;
}

}  // namespace

std::optional<std::vector<std::vector<Image>>> photograph_together(
    std::span<const std::shared_ptr<const FieldSource>> colours, std::span<const Camera> cameras,
    const BandCamera& model, const Progress& progress) {
    const core::StopScope scope(progress);
    const std::optional<ColourBands> bands = bands_of_colours(colours, cameras, model);
    if (!bands) return {};
    std::vector<std::vector<Image>> pictures(colours.size(), std::vector<Image>(cameras.size()));
    std::vector<std::span<Image>> films;
    for (std::size_t c = 0; c < colours.size(); ++c) {
        image::load_film(cameras, 1, colours[c]->provenance(), pictures[c]);
        films.emplace_back(pictures[c]);
    }
    expose(*bands, cameras, films, progress);
    return pictures;
}

}  // namespace hogel::camera
