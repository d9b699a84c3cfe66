// SPDX-License-Identifier: Apache-2.0
// Estimates of memory, disk space and time: sums of the costs of renderers, syntheses and cameras.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "hogel/camera/hogel_spectra/band_cost.h"
#include "hogel/camera/models.h"
#include "hogel/camera/photograph_plan.h"
#include "hogel/camera/speckle_free/speckle_free.h"
#include "hogel/core/available_memory.h"
#include "hogel/core/rates.h"
#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/stereogram/hogel_synthesis.h"
#include "hogel/units.h"

namespace hogel {
namespace {

namespace rates = core::rates;

// Returns the cost of a region of a face: its values, the renderer's cost and, with several samples per ray, a block of
// the finer light field.
RenderCost cost_of_region(const LightFieldSource& face, const LightFieldRequest& request, std::size_t values,
                          std::size_t triangles) {
    const auto tile_bytes = [&](const LightFieldGrid& grid, const HogelRange& region) {
        return static_cast<double>(values * grid.directions()) * static_cast<double>(region.hogels()) * sizeof(float);
    };
    const HogelRange region = face.preferred_tile();
    const bool finely = request.samples.count() > 1;
    const LightFieldGrid grid = finely ? finer(face.grid(), request.samples) : face.grid();
    const HogelRange part =
        finely ? HogelRange{0, 0, request.samples.hogel * region.ns, request.samples.hogel * region.nt} : region;
    const RendererInfo& renderer = renderers().find(request.renderer);
    RenderCost cost = renderer.cost ? renderer.cost(grid, part, triangles) : RenderCost();
    if (request.interpolate > 0) cost.bytes *= 2;  // colours in addition to depths
    cost.bytes += tile_bytes(face.grid(), region) + (finely ? tile_bytes(grid, part) : 0);
    return cost;
}

std::vector<FieldGrid> grids_of(std::span<const LightFieldGrid> faces, const HologramRequest& request) {
    std::vector<FieldGrid> grids;
    for (const Channel& channel : request.channels)
        grids.push_back(hologram_grid(faces, request.options(channel, faces)));
    return grids;
}

// Returns the seconds of the synthesis of one look of all colours.
double seconds_of_synthesis(std::span<const FieldGrid> holograms) {
    double seconds = 0;
    for (const FieldGrid& hologram : holograms)
        seconds += static_cast<double>(hologram.plane.samples()) * rates::hologram_sample;
    return rates::on_all_threads(seconds);
}

// Returns the resources of speckle-free photographs, which need no synthesis.
Plan plan_speckle_free(std::span<const FieldGrid> holograms, const LightFieldGrid& light_field,
                       std::span<const Camera> cameras, const SpeckleFreeCamera& model) {
    Plan sum;
    for (const FieldGrid& hologram : holograms) {
        const std::size_t samples = hologram.plane.width / light_field.hogels_s;
        const Plan plan =
            camera::speckle_free::plan(hologram, {light_field.hogels_s, light_field.hogels_t, samples}, cameras, model);
        sum.memory = std::max(sum.memory, plan.memory);
        sum.seconds += plan.seconds;
    }
    return sum;
}

}  // namespace

Plan plan_light_field(const LightField& rendered, const LightFieldRequest& request, std::size_t triangles,
                      const LightFieldFileOptions& file) {
    Plan plan;
    for (const LightField::Source& face : rendered.faces()) {
        const LightFieldGrid& grid = face->grid();
        const std::size_t values = grid.channels + (file.with_depth ? 1 : 0);
        const HogelRange region = face->preferred_tile();
        const std::size_t regions =
            ((grid.hogels_s + region.ns - 1) / region.ns) * ((grid.hogels_t + region.nt - 1) / region.nt);
        const auto in_parallel = static_cast<double>(std::min(thread_count(), regions)),
                   count = static_cast<double>(triangles);
        const RenderCost cost = cost_of_region(*face, request, values, triangles);
        plan.memory = std::max(plan.memory, in_parallel * cost.bytes + count * cost.bytes_a_triangle);
        const double rays = static_cast<double>(grid.directions()) * static_cast<double>(grid.hogels());
        const std::size_t sample = file.type == SampleType::half ? 2 : 4;
        plan.disk += rays * static_cast<double>(grid.channels * sample + (file.with_depth ? sizeof(float) : 0));
        const double seconds_per_ray = rates::ray + rates::ray_and_million_triangles * 1e-6 * count;
        plan.seconds += rates::on_all_threads(rays * static_cast<double>(request.samples.count()) * seconds_per_ray *
                                              renderers().find(request.renderer).time_of_a_ray) +
                        cost.rays * static_cast<double>(regions) * rates::ray / in_parallel;
    }
    // Models with shadow maps compute light at the hit points. Its time depends on lamps, textures and the number of
    // cached points; no measurement holds for other scenes.
    if (shading_models().find(request.shading.model).shadow_map_bytes) plan.seconds = 0;
    return plan;
}

Plan plan_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                    const HologramFileOptions& file) {
    const std::vector<FieldGrid> holograms = grids_of(faces, request);
    double samples = 0;
    for (const FieldGrid& hologram : holograms) samples += static_cast<double>(hologram.plane.samples());
    return {stereogram::synthesis_bytes(holograms.front(), faces.front().hogels()),
            samples * (file.type == SampleType::half ? 4 : 8), seconds_of_synthesis(holograms)};
}

BandSourceChoice choose_band_source(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                    std::span<const Camera> cameras, const CameraModel& model) {
    if (std::holds_alternative<SpeckleFreeCamera>(model))
        return {BandSource::hogel_spectra, "the mean of infinitely many looks is a sum over hogels"};
    const auto* const band = std::get_if<BandCamera>(&model);
    if (band == nullptr) return {BandSource::samples, "this camera model needs samples"};
    if (band->source == BandSource::samples) return {BandSource::samples, "that was requested"};
    const std::vector<stereogram::HogelLayout> colours =
        camera::hogel_spectra::layouts_of(request.method, faces.front(), grids_of(faces, request));
    if (colours.empty()) return {BandSource::samples, "hogels of this method do not have as many waves as samples"};
    std::size_t per_hogel = 0;
    for (const stereogram::HogelLayout& layout : colours)
        for (const camera::SharedViewpoint& eye : camera::group_by_viewpoint(cameras))
            per_hogel = std::max(per_hogel, camera::hogel_spectra::band_samples_per_hogel(
                                                layout, {cameras[eye.members.front()].eye, eye.pupil}));
    const bool cheaper = camera::hogel_spectra::band_is_cheaper(per_hogel, colours.back());
    return {cheaper ? BandSource::hogel_spectra : BandSource::samples,
            fmt::format("an eye takes in {0}x{0} of {1}x{2} samples of a hogel, {3} than a quarter", per_hogel,
                        colours.back().across(), colours.back().down(), cheaper ? "no more" : "more")};
}

Plan plan_photographs(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                      std::span<const Camera> cameras, const CameraModel& model) {
    const std::vector<FieldGrid> holograms = grids_of(faces, request);
    const auto* const speckle_free = std::get_if<SpeckleFreeCamera>(&model);
    const BandCamera planned = camera::planned_as(model);
    Plan plan;
    if (speckle_free != nullptr) {
        plan = plan_speckle_free(holograms, faces.front(), cameras, *speckle_free);
    } else if (choose_band_source(faces, request, cameras, planned).source == BandSource::hogel_spectra) {
        plan = camera::hogel_spectra::plan_from_hogels(
            camera::hogel_spectra::layouts_of(request.method, faces.front(), holograms), request.looks, cameras,
            planned);
    } else {
        plan = plan_photographs(holograms, request.looks, cameras, planned);
        plan.seconds += static_cast<double>(request.looks) * seconds_of_synthesis(holograms);
    }
    plan.memory += stereogram::synthesis_bytes(holograms.front(), faces.front().hogels());
    return plan;
}

void require_resources(const Plan& plan, const std::string& what, const std::filesystem::path& file) {
    if (const double available = core::available_memory(); plan.memory > available)
        throw Error(ErrorCode::usage, fmt::format("{} takes {} of memory; expected at most the {} that are free", what,
                                                  format_bytes(plan.memory), format_bytes(available)));
    if (file.empty()) return;
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    const auto space = std::filesystem::space(folder, error);
    if (!error && plan.disk > static_cast<double>(space.available))
        throw Error(ErrorCode::cannot_write,
                    fmt::format("{}: takes {} of disk, and {} are free", file.string(), format_bytes(plan.disk),
                                format_bytes(static_cast<double>(space.available))));
}

}  // namespace hogel
