// SPDX-License-Identifier: Apache-2.0
// Holograms of a light field at several wavelengths, and photographs of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/image/film.h"
#include "hogel/pipeline.h"
#include "hogel/pipeline/picture_jobs.h"
#include "hogel/stereogram/parallax.h"
#include "hogel/work/chunks.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel {

void require_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                       std::span<const Camera> cameras) {
    if (request.channels.empty()) throw Error(ErrorCode::usage, "a hologram needs a wavelength; there is none");
    // The shortest wavelength is critical: it has the smallest diffraction angle, and the finest detail in the light
    // that enters a lens.
    const Channel& shortest = *std::ranges::min_element(request.channels, {}, &Channel::wavelength);
    const FieldGrid hologram = hologram_grid(faces, request.options(shortest, faces));
    // The longest has the smallest number of directions and the coarsest detail.
    const Channel& longest = *std::ranges::max_element(request.channels, {}, &Channel::wavelength);
    if (&longest != &shortest) require_photographs(hologram_grid(faces, request.options(longest, faces)), cameras);
    require_photographs(hologram, cameras);
    for (const Camera& camera : cameras) require_light_towards(hologram, camera);
}

LightField open_for_holograms(const std::filesystem::path& path, HologramRequest& request, bool any_transform) {
    auto* const basis = std::get_if<Basis>(&request.method);
    if (basis == nullptr || is_view_set(path) || !is_stream(path))
        return with_common_directions(open_light_field_or_views(path));
    const StreamInfo info = read_stream_info(path);
    const bool fits = !info.grid.focal_plane() && info.method.coder == "fringes" &&
                      info.layout == StreamLayout::faces && !info.tone && info.chrominance == 1 &&
                      (any_transform || basis->transform == info.method.transform);
    if (!fits) return with_common_directions(open_light_field(path));
    basis->transform = info.method.transform;
    request.of_coefficients = true;
    return open_coefficients(path);
}

std::string warning_about(const LightField& light_field, const HologramRequest& request) {
    const auto* overlap_add = std::get_if<OverlapAdd>(&request.method);
    if (overlap_add == nullptr) return {};
    const bool smooth = overlap_add->phases == PointPhases::fixed;
    if (smooth && stereogram::has_picture_at_infinity(light_field.front()))
        return "rays that meet nothing show a picture at infinity, and smooth surfaces keep only its mean; random "
               "phases "
               "would show it";
    const LightFieldGrid& grid = light_field.grid();
    const double samples = std::round(grid.pitch / request.pitch);
    if (smooth && samples > stereogram::max_smooth_hogel)
        return fmt::format(
            "hogels are {:.0f} samples wide, and smooth surfaces show them as a grid with colours of its own; hogels "
            "of up to {:.0f} samples, or random phases, would do",
            samples, stereogram::max_smooth_hogel);
    const double parallax = stereogram::neighbouring_parallax(light_field.front(), request.pitch);
    if (parallax <= stereogram::max_parallax) return {};
    const auto enough = [&](std::size_t count) {
        return std::ceil(static_cast<double>(count) * parallax / stereogram::max_parallax);
    };
    return fmt::format(
        "neighbouring directions see the deepest things {:.1f} samples apart, and windows overlap well up "
        "to {:.0f}{}; {}x{} directions would do",
        parallax, stereogram::max_parallax, smooth ? ", beyond which smooth surfaces lose brightness and colour" : "",
        enough(grid.directions_u), enough(grid.directions_v));
}

Fields make_holograms(const LightField& light_field, const HologramRequest& request) {
    Fields holograms;
    for (const Channel& channel : request.channels) {
        const HologramOptions options = request.options(channel, light_field.grids());
        holograms.push_back(request.of_coefficients ? make_hologram_of_coefficients(light_field, options)
                                                    : make_hologram(light_field, options));
    }
    return holograms;
}

namespace {

// Returns the colours in the order of their photographs: short wavelengths first, because their bands have the most
// samples, and the other colours reuse their memory.
std::vector<std::size_t> in_order(const Fields& holograms) {
    std::vector<std::size_t> order(holograms.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t c) { return holograms[c]->grid().wavelength; });
    return order;
}

std::vector<Image> unexposed(const Fields& holograms, std::span<const Camera> cameras) {
    std::vector<Image> pictures(cameras.size());
    image::load_film(cameras, holograms.size(), holograms.front()->provenance(), pictures);
    return pictures;
}

// Photographs all colours by some cameras, one colour after the other; all ranks compute each picture together. The
// narrow-band camera checkpoints the light of each tile, except behind a diffuser, where it takes gigabytes.
void photograph_one_by_one(const Fields& holograms, std::span<const Camera> cameras, const CameraModel& model,
                           std::span<Image> pictures, const Progress& progress) {
    const auto* const band = std::get_if<BandCamera>(&model);
    const std::vector<std::size_t> order = in_order(holograms);
    pipeline::PictureJob job{0, {}, std::vector<std::size_t>(cameras.size())};
    std::iota(job.cameras.begin(), job.cameras.end(), std::size_t{0});
    const auto photograph = [&](std::size_t k) {
        return hogel::photograph(*holograms[order[k]], cameras, model, progress.part(k, order.size()));
    };
    const auto put = [&](std::size_t k, std::vector<Image>& colour_pictures) {
        job.colours = {order[k]};
        pipeline::put(job, colour_pictures, pictures);
    };
    if (band == nullptr || band->vertical_diffuser)
        return work::shared_jobs<std::vector<Image>>(order.size(), image::sent_pictures(), photograph, put,
                                                     work::DoneBy::all_ranks);
    for (std::size_t k = 0; k < order.size(); ++k) {
        std::vector<Image> colour_pictures = photograph(k);
        put(k, colour_pictures);
    }
}

}  // namespace

std::vector<std::vector<Image>> photograph_colours(const Fields& holograms, std::span<const Camera> cameras,
                                                   std::span<const CameraModel> models, const Progress& progress) {
    const core::StopScope scope(progress);
    if (holograms.empty()) throw Error(ErrorCode::usage, "a photograph needs a hologram; there is none");
    std::vector<std::vector<Image>> pictures;
    for (std::size_t model_index = 0; model_index < models.size(); ++model_index)
        pictures.push_back(unexposed(holograms, cameras));
    const std::vector<pipeline::PictureJob> jobs =
        pipeline::picture_jobs(holograms, in_order(holograms), cameras, models);
    std::size_t shared_pictures = 0, done = 0;
    for (const CameraModel& model : models) shared_pictures += pipeline::is_made_in_jobs(holograms, model) ? 0 : 1;
    const std::size_t parts = jobs.size() + shared_pictures;
    work::shared_jobs<std::vector<Image>>(
        jobs.size(), image::sent_pictures(),
        [&](std::size_t i) {
            return pipeline::photograph(jobs[i], holograms, cameras, models, progress.part(i, parts));
        },
        [&](std::size_t i, std::vector<Image>& colour_pictures) {
            pipeline::put(jobs[i], colour_pictures, pictures[jobs[i].model_index]);
        });
    for (std::size_t model_index = 0; model_index < models.size(); ++model_index)
        if (!pipeline::is_made_in_jobs(holograms, models[model_index]))
            photograph_one_by_one(holograms, cameras, models[model_index], pictures[model_index],
                                  progress.part(jobs.size() + done++, parts));
    if (Communicator* const all = work::communicator_of_several())
        for (std::vector<Image>& model_pictures : pictures)
            for (Image& picture : model_pictures) work::broadcast_in_chunks<float>(*all, picture.pixels.elements());
    return pictures;
}

std::vector<Image> photograph_colours(const Fields& holograms, std::span<const Camera> cameras,
                                      const CameraModel& model, const Progress& progress) {
    return std::move(photograph_colours(holograms, cameras, std::span(&model, 1), progress).front());
}

Image photograph_colours(const Fields& holograms, const Camera& camera, const CameraModel& model,
                         const Progress& progress) {
    return std::move(photograph_colours(holograms, std::span(&camera, 1), model, progress).front());
}

void write_holograms(const std::filesystem::path& path, const Fields& holograms, const HologramFileOptions& options,
                     const Progress& progress) {
    const core::StopScope scope(progress);
    std::vector<FieldGrid> grids;
    for (const auto& hologram : holograms) grids.push_back(hologram->grid());
    HologramFileOptions file = options;
    file.metadata = with_history(file.metadata, to_metadata(holograms.front()->provenance()));
    const auto sinks = create_hologram(path, grids, file);
    for (std::size_t i = 0; i < sinks.size(); ++i) copy(*holograms[i], *sinks[i], 0, progress.part(i, sinks.size()));
}

Camera camera_for(double width, double height, std::size_t resolution) {
    const double pixel = width / static_cast<double>(resolution);
    const auto rows = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(height / pixel)));
    Camera camera;
    camera.eye = {0, 0, defaults.eye_distance};
    camera.pupil = defaults.pupil;
    camera.picture = {resolution, rows, pixel, pixel, 0, 0};
    return camera;
}

std::size_t enough_looks(const Camera& camera) {
    const auto cells_in_pixel = [](const Camera& one) {
        const double cell = resolution_cell(one, defaults.green);
        return std::max(1.0, one.picture.pitch_x * one.picture.pitch_y / (cell * cell));
    };
    const double usual_cells = cells_in_pixel(camera_for(defaults.size, defaults.size, defaults.resolution));
    const double looks = static_cast<double>(defaults.looks) * usual_cells / cells_in_pixel(camera);
    return static_cast<std::size_t>(std::clamp(std::ceil(looks), 1.0, static_cast<double>(defaults.looks)));
}

}  // namespace hogel
