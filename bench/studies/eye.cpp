// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/session.h"
#include "bench/studies/studies.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"

namespace hogel::bench {
namespace {
using namespace hogel::literals;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

struct View {
    const char* name;
    Vec3 eye;
    double pupil, focus;
};

// Processor seconds of works, done in turns.
std::vector<double> in_turns(const std::vector<std::function<void()>>& works, std::size_t rounds) {
    std::vector<std::vector<double>> seconds(works.size());
    for (std::size_t round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < works.size(); ++i) {
            stop_if_interrupted();
            seconds[i].push_back(best_time_of(works[i], 1).processor);
        }
    std::vector<double> medians;
    for (const auto& some : seconds) medians.push_back(median(some));
    return medians;
}

}  // namespace

void study_eye(const EyeStudy& study) {
    LightFieldRequest request;
    request.grid.hogels_s = request.grid.hogels_t = study.hogels;
    request.grid.pitch = defaults.size / static_cast<double>(study.hogels);
    HologramRequest options;
    options.channels = mono(defaults.green);
    options.pitch = request.grid.pitch / 32;
    options.looks = study.looks;
    const LightField light_field =
        prepare_for_reading(render_light_field(load_scene(study.scene, request), request), 9, false);
    const auto hologram = make_holograms(light_field, options).front();
    EyePhotographer photographer({hologram}, {.memory = std::size_t{3} << 30});

    std::printf(
        "| eye, pupil, focus | PSNR | maximum error | narrow | eye | ratio | infinitely many looks | new eye | new "
        "focus |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    const View views[] = {{"in front, 6 mm, on the hologram", {0, 0, 300_mm}, 6_mm, 0},
                          {"left, 6 mm, 4 mm in front", {-20_mm, 0, 300_mm}, 6_mm, -4_mm},
                          {"high and right, 6 mm, 10 mm behind", {14_mm, 14_mm, 300_mm}, 6_mm, 10_mm},
                          {"in front, 2 mm, 20 mm behind", {0, 0, 300_mm}, 2_mm, 20_mm},
                          {"low, 10 mm, 20 mm in front", {0, -18_mm, 300_mm}, 10_mm, -20_mm}};
    for (const View& view : views) {
        Camera camera = camera_for(defaults.size, defaults.size);
        camera.eye = view.eye;
        camera.pupil = view.pupil;
        camera.focus_depth = view.focus;
        const auto take = [&](const PhotographOptions& how) {
            return photograph(*hologram, {&camera, 1}, how).front();
        };
        Image narrow, eye;
        Camera other = camera, focused = camera;
        other.eye.x += 1_mm;
        focused.focus_depth *= 0.9;
        const std::vector<double> seconds =
            in_turns({[&] { narrow = take({.from = LightFrom::samples}); },
                      [&] { eye = take({.from = LightFrom::hogels}); }, [&] { take({.expected = true}); },
                      [&] {
                          photographer.photograph(other);
                          photographer.photograph(camera);
                      },
                      [&] { photographer.photograph(focused); }},
                     study.rounds);
        const ImageComparison difference = compare(narrow, eye, automatic_exposure(narrow));
        std::printf("| %s | %.1f dB | %.1e | %.2f s | %.2f s | %.1f | %.2f s | %.2f s | %.3f s |\n", view.name,
                    difference.psnr, difference.max_error, seconds[0], seconds[1], seconds[0] / seconds[1], seconds[2],
                    0.5 * seconds[3], seconds[4]);
        std::fflush(stdout);
    }
}

}  // namespace hogel::bench
