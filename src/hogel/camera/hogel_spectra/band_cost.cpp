// SPDX-License-Identifier: Apache-2.0
// Resources of photographs from hogel spectra.
#include "hogel/camera/hogel_spectra/band_cost.h"

#include <algorithm>
#include <variant>

#include "hogel/camera/film/film.h"
#include "hogel/camera/photograph_plan.h"
#include "hogel/core/rates.h"
#include "hogel/math/packed_complex.h"
#include "hogel/stereogram/windows/overlap_add.h"

namespace hogel::camera::hogel_spectra {
namespace {

namespace rates = core::rates;

double hogels_of(const HogelLayout& layout) {
    const Grid& plane = layout.grid.plane;
    return static_cast<double>((plane.width / layout.across()) * (plane.height / layout.down()));
}

double samples_of_bands(const HogelLayout& layout, std::span<const SharedViewpoint> viewpoints,
                        std::span<const Camera> cameras) {
    double samples = 0;
    for (const SharedViewpoint& viewpoint : viewpoints) {
        const auto per_hogel = static_cast<double>(
            band_samples_per_hogel(layout, {cameras[viewpoint.members.front()].eye, viewpoint.pupil}));
        samples += hogels_of(layout) * per_hogel * per_hogel;
    }
    return samples;
}

// Processor seconds of a look: waves, bands and films.
double seconds_of_look(const HogelLayout& layout, double viewpoints, double band_samples,
                       std::span<const Camera> cameras) {
    const FieldGrid& hologram = layout.grid;
    const double waves = hogels_of(layout) * static_cast<double>(layout.columns * layout.rows);
    double seconds = waves * (rates::wave + viewpoints * rates::wave_and_eye) + band_samples * rates::band_sample;
    for (const Camera& camera : cameras) {
        const double cell = resolution_cell(camera, hologram.wavelength) / film::samples_a_cell;
        const Rectangle active = illuminated_area(hologram, camera.eye, camera.pupil, defocus_blur(camera));
        const Grid film = as_grid(film_area(hologram.plane, Rectangle(camera.picture), active));
        seconds += film.size_x() * film.size_y() / (cell * cell) * rates::film_sample;
    }
    return seconds;
}

}  // namespace

std::vector<HogelLayout> layouts_of(const HologramMethod& method, const LightFieldGrid& light_field,
                                    std::span<const FieldGrid> colours) {
    const auto* const added = std::get_if<PhaseAdded>(&method);
    if ((added != nullptr && added->exact) || std::holds_alternative<OwnMethod>(method)) return {};
    std::vector<HogelLayout> layouts;
    for (const FieldGrid& colour : colours)
        layouts.push_back(std::holds_alternative<OverlapAdd>(method)
                              ? stereogram::windows::window_layout(light_field, colour)
                              : HogelLayout{colour, colour.plane.width / light_field.hogels_s,
                                            colour.plane.height / light_field.hogels_t});
    return layouts;
}

Plan plan_from_hogels(std::span<const HogelLayout> colours, std::size_t looks, std::span<const Camera> cameras,
                      const BandCamera& model) {
    const std::vector<SharedViewpoint> viewpoints = group_by_viewpoint(cameras);
    const auto memory = static_cast<double>(model.memory), count = static_cast<double>(looks);
    double seconds = 0, bytes = 0, film_bytes = 0, band_bytes = 0;
    for (const HogelLayout& layout : colours) {
        const FieldGrid& hologram = layout.grid;
        const double samples = samples_of_bands(layout, viewpoints, cameras);
        seconds += hogels_of(layout) * static_cast<double>(layout.columns * layout.rows) * rates::amplitude +
                   count * seconds_of_look(layout, static_cast<double>(viewpoints.size()), samples, cameras);
        double narrow_band_total = 0;
        for (const SharedViewpoint& viewpoint : viewpoints)
            narrow_band_total += narrow_band_bytes(hologram, cameras[viewpoint.members.front()].eye, viewpoint.pupil);
        const double band = samples * sizeof(math::PackedComplex);
        band_bytes += count * band;
        film_bytes = std::max(film_bytes, plan_photographs(hologram, cameras, memory).bytes);
        bytes = std::max(bytes, photograph_bytes(hologram, cameras, memory, looks, band / narrow_band_total));
    }
    if (colours.size() > 1 &&
        renders_colours_together(band_bytes / static_cast<double>(colours.size()), colours.back().grid.plane))
        bytes = std::max(bytes, std::min(memory, film_bytes + band_bytes));
    return {bytes, 0, rates::on_all_threads(seconds)};
}

}  // namespace hogel::camera::hogel_spectra
