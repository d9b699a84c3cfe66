// SPDX-License-Identifier: Apache-2.0
// From what photographs of holograms are computed, and what that takes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "hogel/hologram/eye/eye_band.h"
#include "hogel/hologram/windows/overlap_add.h"
#include "hogel/optics/expected/expected.h"
#include "hogel/optics/film/film.h"
#include "hogel/optics/line_diffuser.h"
#include "hogel/optics/narrow_band/narrow_band.h"
#include "hogel/optics/photograph_plan.h"
#include "hogel/pipeline.h"
#include "hogel/pipeline/plan_rates.h"

namespace hogel {
namespace {

// Processor seconds, measured on two threads of one core of an AMD EPYC (Zen 5) with g++ 12, 2026-11-23 and, from
// hogels, 2026-11-28 and -29, other programs beside it. Per sample of a hologram: for the narrow band of one eye.
constexpr double seconds_a_sample_and_eye = 1.8e-9;
// Per wave of a hogel: for its amplitude, once; for its phase, for each look; and for its light, for each look and eye.
constexpr double seconds_an_amplitude = 1e-9, seconds_a_wave = 0.25e-9, seconds_a_wave_and_eye = 0.15e-9;
// Per sample of a band, for each look; per sample of a film, for each look and photograph; and for each product of a
// number of a hogel with a spot, of the mean of infinitely many looks.
constexpr double seconds_a_band_sample = 15e-9, seconds_a_film_sample = 10e-9, seconds_a_product = 0.04e-9;

// Per sample of the sines and of the film of a set of lines behind a vertical diffuser, most of which are dark
// (decision 0088).
constexpr double seconds_a_sine_of_lines = 1.3e-9, seconds_a_film_sample_of_lines = 0.9e-9;

std::vector<optics::SharedEye> eyes_of(std::span<const Camera> cameras) {
    std::vector<std::size_t> all(cameras.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return optics::group_by_eye(cameras, all);
}

// The samples of a side of a hogel.
std::size_t samples_a_side(const LightFieldGrid& light_field, const FieldGrid& hologram) {
    return hologram.plane.width / std::max<std::size_t>(light_field.hogels_s, 1);
}

// The hogels of a method of which waves are known; none of any other.
std::optional<hologram::eye::HogelLayout> layout_of(const HologramMethod& method, const LightFieldGrid& light_field,
                                                    const FieldGrid& hologram) {
    const auto* const added = std::get_if<PhaseAdded>(&method);
    if ((added != nullptr && added->exact) || std::holds_alternative<OwnMethod>(method)) return {};
    if (std::holds_alternative<OverlapAdd>(method)) return hologram::windows::window_layout(light_field, hologram);
    const std::size_t rows = hologram.plane.height / std::max<std::size_t>(light_field.hogels_t, 1);
    return hologram::eye::HogelLayout{hologram, samples_a_side(light_field, hologram), rows};
}

// Samples of a look in the bands of all eyes, from hogels.
double band_samples(std::size_t hogels, const hologram::eye::HogelLayout& layout, std::span<const Camera> cameras) {
    double samples = 0;
    for (const optics::SharedEye& eye : eyes_of(cameras)) {
        const auto per_hogel = static_cast<double>(
            hologram::eye::band_samples_per_hogel(layout, {cameras[eye.members.front()].eye, eye.pupil}));
        samples += static_cast<double>(hogels) * per_hogel * per_hogel;
    }
    return samples;
}

// Seconds for one colour of photographs from hogels.
double seconds_from_hogels(std::size_t hogels, const hologram::eye::HogelLayout& layout,
                           std::span<const Camera> cameras, std::size_t looks) {
    const FieldGrid& hologram = layout.grid;
    const double waves = static_cast<double>(hogels) * static_cast<double>(layout.columns * layout.rows),
                 count = static_cast<double>(looks);
    const auto eyes = static_cast<double>(eyes_of(cameras).size());
    double seconds = waves * (seconds_an_amplitude + count * (seconds_a_wave + eyes * seconds_a_wave_and_eye));
    seconds += count * band_samples(hogels, layout, cameras) * seconds_a_band_sample;
    for (const Camera& camera : cameras) {
        const double cell = resolution_cell(camera, hologram.wavelength) / optics::film::samples_a_cell;
        const Rectangle lit = optics::lit_area(hologram, camera.eye, camera.pupil, optics::defocus_blur(camera));
        const Grid film = optics::as_grid(optics::film_area(hologram.plane, Rectangle(camera.picture), lit));
        seconds += count * film.size_x() * film.size_y() / (cell * cell) * seconds_a_film_sample;
    }
    return seconds;
}

// Bytes of the camera, which computes as many looks together as there is memory for.
// @param share  of the memory of narrow bands that bands take
double camera_bytes_of(const FieldGrid& hologram, std::span<const Camera> cameras, const PhotographOptions& options,
                       std::size_t looks, double share = 1) {
    const auto memory = static_cast<double>(options.memory);
    const optics::PhotographPlan camera = optics::plan_photographs(hologram, cameras, memory);
    const auto more = static_cast<double>(camera.looks_at_once(memory, looks, share) - 1);
    return camera.bytes + std::min(more * share * camera.bytes_a_look, memory);
}

// Seconds of the films of one set of lines behind a vertical diffuser.
double seconds_of_films(const FieldGrid& hologram, std::span<const Camera> cameras) {
    double seconds = 0;
    for (const optics::SharedEye& eye : eyes_of(cameras)) {
        const optics::narrow_band::NarrowBand band(hologram, cameras[eye.members.front()].eye, eye.pupil);
        const Rectangle lit = optics::lit_area(hologram, cameras[eye.members.front()].eye, eye.pupil, eye.blur);
        const optics::film::FilmSize film(band, hologram, optics::film_area(hologram.plane, eye.pictures, lit),
                                          eye.pupil, eye.blur);
        seconds +=
            static_cast<double>(film.sines.size_x) * static_cast<double>(film.sines.size_y) * seconds_a_sine_of_lines +
            static_cast<double>(eye.members.size() * film.x.size * film.y.size) * seconds_a_film_sample_of_lines;
    }
    return seconds;
}

}  // namespace

LightChoice choose_light(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                         std::span<const Camera> cameras, const PhotographOptions& options) {
    if (options.expected) return {LightFrom::hogels, "the mean of infinitely many looks is a sum over hogels"};
    if (options.from == LightFrom::samples) return {LightFrom::samples, "that was requested"};
    std::size_t per_hogel = 0;
    std::optional<hologram::eye::HogelLayout> layout;
    for (const Channel& channel : request.channels) {
        layout = layout_of(request.method, faces.front(), hologram_grid(faces, request.options(channel, faces)));
        if (!layout)
            return {LightFrom::samples,
                    "this method has no hogels that are sums of as many waves as they have samples"};
        for (const optics::SharedEye& eye : eyes_of(cameras))
            per_hogel = std::max(per_hogel, hologram::eye::band_samples_per_hogel(
                                                *layout, {cameras[eye.members.front()].eye, eye.pupil}));
    }
    const bool cheaper = layout && hologram::eye::band_is_cheaper(per_hogel, *layout);
    return {cheaper ? LightFrom::hogels : LightFrom::samples,
            fmt::format("an eye takes in {0}x{0} of {1}x{2} samples of a hogel, {3} than a quarter", per_hogel,
                        layout ? layout->across() : 0, layout ? layout->down() : 0, cheaper ? "no more" : "more")};
}

Plan plan_photographs(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                      std::span<const Camera> cameras, const PhotographOptions& options) {
    Plan plan = plan_holograms(faces, request);
    plan.disk = 0;
    const bool from_hogels = choose_light(faces, request, cameras, options).from == LightFrom::hogels;
    const auto eyes = static_cast<double>(eyes_of(cameras).size());
    const auto memory = static_cast<double>(options.memory);
    double seconds = 0, camera_bytes = 0, film_bytes = 0, look_bytes = 0;
    Grid plane;
    for (const Channel& channel : request.channels) {
        const FieldGrid hologram = hologram_grid(faces, request.options(channel, faces));
        plane = hologram.plane;
        if (options.expected) {
            const optics::expected::Work work = optics::expected::work(
                hologram, {faces.front().hogels_s, faces.front().hogels_t, samples_a_side(faces.front(), hologram)},
                cameras, options);
            seconds += work.products * seconds_a_product;
            camera_bytes = std::max(camera_bytes, work.bytes);
            continue;
        }
        double share = 1;
        if (from_hogels) {
            const hologram::eye::HogelLayout layout = *layout_of(request.method, faces.front(), hologram);
            seconds += seconds_from_hogels(faces.front().hogels(), layout, cameras, request.looks);
            const double bytes = band_samples(faces.front().hogels(), layout, cameras) * sizeof(math::PackedComplex);
            double narrow = 0;
            for (const optics::SharedEye& eye : eyes_of(cameras))
                narrow += optics::narrow_band_bytes(hologram, cameras[eye.members.front()].eye, eye.pupil);
            share = bytes / narrow;
            look_bytes += bytes;
            film_bytes = std::max(film_bytes, optics::plan_photographs(hologram, cameras, memory).bytes);
        } else {
            seconds += static_cast<double>(hologram.plane.samples()) * static_cast<double>(request.looks) *
                       (seconds_a_sample + eyes * seconds_a_sample_and_eye);
        }
        camera_bytes = std::max(camera_bytes, camera_bytes_of(hologram, cameras, options, request.looks, share));
    }
    const double band_bytes = static_cast<double>(request.looks) * look_bytes;
    if (from_hogels && request.channels.size() > 1 &&
        optics::colours_together(band_bytes / static_cast<double>(request.channels.size()), plane))
        camera_bytes = std::max(camera_bytes, std::min(memory, film_bytes + band_bytes));
    plan.seconds = on_all_threads(seconds);
    plan.memory += camera_bytes;
    return plan;
}

Plan plan_photographs(std::span<const FieldGrid> holograms, std::size_t looks, std::span<const Camera> cameras,
                      const PhotographOptions& options) {
    Plan plan;
    double seconds = 0;
    for (const FieldGrid& hologram : holograms) {
        const auto eyes = static_cast<double>(eyes_of(cameras).size());
        const auto seconds_of = [&](const FieldGrid& field, std::size_t count) {
            return static_cast<double>(field.plane.samples()) * static_cast<double>(count) * eyes *
                   seconds_a_sample_and_eye;
        };
        if (!options.vertical_diffuser) {
            seconds += seconds_of(hologram, looks);
            plan.memory = std::max(plan.memory, camera_bytes_of(hologram, cameras, options, looks));
            continue;
        }
        const optics::LinesWork lines = optics::work_of_lines(hologram, cameras, options);
        const std::size_t photographs = looks * lines.sets;
        seconds += seconds_of(lines.rows, photographs) +
                   static_cast<double>(photographs) * seconds_of_films(lines.rows, lines.cameras);
        plan.memory = std::max(plan.memory,
                               camera_bytes_of(lines.rows, lines.cameras, options, photographs) + lines.picture_bytes);
    }
    plan.seconds = on_all_threads(seconds);
    return plan;
}

}  // namespace hogel
