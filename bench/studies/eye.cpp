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

struct View {
    const char* name;
    Vec3 eye;
    double pupil, focus;
};

// The least times of works, done in turns.
std::vector<Times> in_turns(const std::vector<std::function<void()>>& works, std::size_t rounds) {
    std::vector<Times> best(works.size(), {1e9, 1e9});
    for (std::size_t round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < works.size(); ++i) {
            stop_if_interrupted();
            const Times one = time_of(works[i]);
            best[i] = {std::min(best[i].wall, one.wall), std::min(best[i].processor, one.processor)};
        }
    return best;
}

std::string milliseconds(const Times& times) {
    char text[64];
    std::snprintf(text, sizeof text, "%.0f (%.0f)", 1e3 * times.wall, 1e3 * times.processor);
    return text;
}

Camera camera_of(const View& view) {
    Camera camera = camera_for(defaults.size, defaults.size);
    camera.eye = view.eye;
    camera.pupil = view.pupil;
    camera.focus_depth = view.focus;
    return camera;
}

// The eye camera beside the narrow-band camera, from the same phases: a row of a table.
void beside_samples(const std::string& name, const FieldSource& hologram, const Camera& camera, std::size_t rounds) {
    Image narrow, eye;
    const auto take = [&](LightFrom from) { return photograph(hologram, {&camera, 1}, {.from = from}).front(); };
    const std::vector<Times> times =
        in_turns({[&] { narrow = take(LightFrom::samples); }, [&] { eye = take(LightFrom::hogels); }}, rounds);
    const ImageComparison difference = compare(narrow, eye, automatic_exposure(narrow));
    std::printf("| %s | %.1f dB | %.1e | %s | %s | %.1f |\n", name.c_str(), difference.psnr, difference.max_error,
                milliseconds(times[0]).c_str(), milliseconds(times[1]).c_str(), times[0].wall / times[1].wall);
    std::fflush(stdout);
}

// A camera whose eye is 1 mm to the right.
Camera aside(Camera camera) {
    camera.eye.x += 1_mm;
    return camera;
}

void one_eye_after_the_other(const std::vector<std::shared_ptr<const FieldSource>>& colours,
                             std::span<const View> views, std::size_t rounds) {
    EyePhotographer whole({colours[1]}), quick({colours[1]}, {.preview = true});
    EyePhotographer expected(colours, {.expected = true});
    std::printf(
        "\nMilliseconds (of processor time), one colour; infinitely many looks in three\n\n"
        "| eye, pupil, focus | new eye | as a preview | new focus | infinitely many looks |\n|---|---|---|---|---|\n");
    for (const View& view : views) {
        const Camera camera = camera_of(view), other = aside(camera);
        Camera focused = camera;
        focused.focus_depth *= 0.9;
        const std::vector<Times> times = in_turns(
            {[&] { whole.photograph(other); }, [&] { whole.photograph(camera); }, [&] { whole.photograph(focused); },
             [&] { quick.photograph(other); }, [&] { quick.photograph(camera); }, [&] { expected.photograph(camera); }},
            rounds);
        std::printf("| %s | %s | %s | %s | %s |\n", view.name, milliseconds(times[1]).c_str(),
                    milliseconds(times[4]).c_str(), milliseconds(times[2]).c_str(), milliseconds(times[5]).c_str());
        std::fflush(stdout);
    }
}

}  // namespace

void study_eye(const EyeStudy& study) {
    LightFieldRequest request;
    request.grid.hogels_s = request.grid.hogels_t = study.hogels;
    request.grid.pitch = defaults.size / static_cast<double>(study.hogels);
    const auto prepared = [&](bool with_depth) {
        return prepare_for_reading(render_light_field(load_scene(study.scene, request), request), 9, with_depth);
    };
    HologramRequest options;
    options.channels = rgb(defaults.red, defaults.green, defaults.blue);
    options.pitch = request.grid.pitch / 32;
    options.looks = study.looks;
    const View views[] = {{"in front, 6 mm, on the hologram", {0, 0, 300_mm}, 6_mm, 0},
                          {"left 20 mm, 6 mm, 4 mm in front", {-20_mm, 0, 300_mm}, 6_mm, -4_mm},
                          {"high and right 14 mm, 6 mm, 10 mm behind", {14_mm, 14_mm, 300_mm}, 6_mm, 10_mm},
                          {"in front, 2 mm, 20 mm behind", {0, 0, 300_mm}, 2_mm, 20_mm},
                          {"low 18 mm, 10 mm, 20 mm in front", {0, -18_mm, 300_mm}, 10_mm, -20_mm}};
    const char* heading =
        "| %s | PSNR | maximum error | narrow, ms (of processor time) | eye | ratio |\n|---|---|---|---|---|---|\n";
    const LightField square = prepared(false);
    {
        const auto colours = make_holograms(square, options);
        std::printf(heading, "eye, pupil, focus");
        for (const View& view : views) beside_samples(view.name, *colours[1], camera_of(view), study.rounds);
        one_eye_after_the_other(colours, views, study.rounds);
    }
    std::printf("\n");
    std::printf(heading, "method");
    const auto row = [&](const std::string& name, const LightField& light_field, const HologramMethod& method) {
        options.method = method;
        options.channels = mono(defaults.green);
        beside_samples(name, *make_holograms(light_field, options).front(), camera_of(views[1]), study.rounds);
    };
    row("fourier", square, Fourier{});
    row("fourier, fixed phases", square, Fourier{Phases::fixed});
    row("basis", square, Basis{});
    const LightField deep = prepared(true);
    row("phase-added", deep, PhaseAdded{});
    row("olas", deep, OverlapAdd{});
    request.grid.directions_v = 1;
    const LightField lines = prepared(false);
    row("lines", lines, Lines{});
    row("lines 10 um apart", lines, Lines{10_um});
}

}  // namespace hogel::bench
