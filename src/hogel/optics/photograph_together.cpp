// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/photograph_together.h"

#include <algorithm>
#include <complex>

#include "hogel/core/parallel.h"
#include "hogel/image/film.h"
#include "hogel/optics/eye_light.h"
#include "hogel/optics/film/film.h"
#include "hogel/optics/photograph_plan.h"

namespace hogel::optics {
namespace {

// The light towards the eyes of cameras, the bands of all eyes of a colour after each other.
struct Light {
    std::vector<SharedEye> eyes;
    std::unique_ptr<EyeDrawing> drawing;
    Rectangle shown;
    std::size_t looks_at_once = 1;
};

// None where colours cannot share rays, or where their bands do not fit into memory together or take more time than
// rays.
std::optional<Light> light_of_colours(std::span<const std::shared_ptr<const FieldSource>> colours,
                                      std::span<const Camera> cameras, const PhotographOptions& options) {
    if (colours.size() < 2 || cameras.empty() || options.expected || options.vertical_diffuser ||
        options.from == LightFrom::samples)
        return {};
    std::vector<const EyeLight*> lights;
    PhotographPlan plan;
    const auto memory = static_cast<double>(options.memory);
    for (const auto& colour : colours) {
        lights.push_back(dynamic_cast<const EyeLight*>(colour.get()));
        if (lights.back() == nullptr || colour->looks() != colours.front()->looks()) return {};
        PhotographPlan own = plan_photographs(colour->grid(), cameras, memory);
        if (own.passes.size() != 1 || own.windows.size() != 1) return {};
        if (own.bytes > plan.bytes) plan = std::move(own);
    }
    Light light{{}, {}, plan.windows.front().shown, 1};
    light.eyes = group_by_eye(cameras, plan.passes.front());
    std::vector<Eye> looking;
    for (const SharedEye& eye : light.eyes)
        looking.push_back({cameras[eye.members.front()].eye, eye.pupil, options.preview});
    const Grid& plane = colours.front()->grid().plane;
    light.drawing = lights.front()->eye_drawing_of_colours(lights, {0, 0, plane.width, plane.height}, looking);
    if (!light.drawing) return {};
    double a_look = 0;
    for (std::size_t band = 0; band < colours.size() * light.eyes.size(); ++band)
        a_look += light.drawing->look_bytes(band);
    const std::size_t looks = colours.front()->looks();
    const double a_colour = a_look * static_cast<double>(looks) / static_cast<double>(colours.size());
    if (!colours_together(a_colour, plane) || plan.bytes + a_look > memory) return {};
    light.looks_at_once = std::min(looks, static_cast<std::size_t>((memory - plan.bytes) / a_look));
    return light;
}

}  // namespace

std::optional<std::vector<std::vector<Image>>> photograph_together(
    std::span<const std::shared_ptr<const FieldSource>> colours, std::span<const Camera> cameras,
    const PhotographOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    const std::optional<Light> light = light_of_colours(colours, cameras, options);
    if (!light) return {};
    const std::vector<SharedEye>& eyes = light->eyes;
    std::vector<std::vector<Image>> pictures(colours.size(), std::vector<Image>(cameras.size()));
    for (std::size_t c = 0; c < colours.size(); ++c)
        image::load_film(cameras, 1, colours[c]->provenance(), pictures[c]);
    const auto film_of = [&](std::size_t c, std::size_t e) {
        const FieldGrid& hologram = colours[c]->grid();
        return film::Film(light->drawing->band(c * eyes.size() + e), hologram,
                          film_area(hologram.plane, eyes[e].pictures, light->shown), eyes[e].pupil, eyes[e].blur,
                          film::film_samples(options.preview));
    };
    std::vector<std::vector<Array<float, 2>>> intensities(colours.size(), std::vector<Array<float, 2>>(cameras.size()));
    const std::size_t looks = colours.front()->looks();
    for (std::size_t first = 0; first < looks; first += light->looks_at_once) {
        const std::size_t count = std::min(light->looks_at_once, looks - first);
        const auto report = [&](double done) {
            progress.report((static_cast<double>(first) + done * static_cast<double>(count)) /
                            static_cast<double>(looks));
        };
        PackedBands drawn = light->drawing->draw(first, count, [&](double fraction) {
            report(0.9 * fraction);
            return true;
        });
        // One film at a time, whose memory the next one uses.
        for (std::size_t c = 0; c < colours.size(); ++c)
            for (std::size_t e = 0; e < eyes.size(); ++e) {
                const film::Film film = film_of(c, e);
                std::vector<film::PupilWave> waves;
                for (PackedBand& band : drawn[c * eyes.size() + e]) {
                    waves.push_back(film.pupil_wave(band));
                    band = {};
                }
                for (const std::size_t camera : eyes[e].members) {
                    Array<float, 2>& intensity = intensities[c][camera];
                    if (intensity.size() == 0) intensity = film.unexposed();
                    film.expose(waves, cameras[camera], intensity);
                    if (first + count == looks)
                        film.develop(intensity, cameras[camera], light->shown, 1 / static_cast<double>(looks),
                                     pictures[c][camera]);
                }
            }
        report(1);
    }
    return pictures;
}

}  // namespace hogel::optics
