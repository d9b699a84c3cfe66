// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "bench/measure.h"
#include "bench/session.h"
#include "bench/studies/studies.h"
#include "hogel/core/parallel.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"

namespace hogel::bench {
namespace {
using namespace hogel::literals;

// An eye on a loop over the cone of directions: from side to side and up and down.
Camera on_the_loop(Camera camera, double turn) {
    camera.eye = {20_mm * std::sin(2 * std::numbers::pi * turn), 10_mm * std::sin(4 * std::numbers::pi * turn), 300_mm};
    camera.focus_depth = 4_mm * std::cos(2 * std::numbers::pi * turn);
    return camera;
}

using Take = std::function<void(const Camera& eye, const RayPhotographOptions& options, Image& picture)>;

void take_pictures(const RaysStudy& study, const Camera& camera, const char* name, std::size_t samples,
                   const Take& take) {
    std::vector<double> wall, processor;
    double all = 0;
    Image picture;
    for (std::size_t i = 0; i < study.pictures; ++i) {
        stop_if_interrupted();
        const Camera eye = on_the_loop(camera, static_cast<double>(i) / static_cast<double>(study.pictures));
        const Times times = time_of([&] { take(eye, {.pupil_samples = samples}, picture); });
        wall.push_back(times.wall);
        processor.push_back(times.processor);
        all += times.wall;
    }
    std::printf("| %s | %zu | %.1f | %.1f ms | %.1f ms | %.1f ms |\n", name, samples,
                static_cast<double>(wall.size()) / all, 1e3 * median(wall), 1e3 * std::ranges::max(wall),
                1e3 * median(processor));
    std::fflush(stdout);
}

}  // namespace

void study_rays(const RaysStudy& study) {
    LightFieldRequest request;
    request.grid.hogels_s = request.grid.hogels_t = study.hogels;
    request.grid.directions_u = request.grid.directions_v = study.directions;
    request.grid.pitch = defaults.size / static_cast<double>(study.hogels);
    const LightField rendered = render_light_field(load_scene(study.scene, request), request);
    const auto buffer = std::make_shared<LightFieldBuffer>(rendered.grid());
    copy(rendered.front(), *buffer);
    const LightField light_field(buffer);
    Camera camera = camera_for(defaults.size, defaults.size);
    camera.pupil = 4_mm;
    const double pitch = defaults.size / static_cast<double>(study.pixels);
    camera.picture = {study.pixels, study.pixels, pitch, pitch, 0, 0};
    std::printf("%zux%zu pixels of %zux%zu hogels with %zux%zu directions, %.2f GB, %zu threads\n", study.pixels,
                study.pixels, study.hogels, study.hogels, study.directions, study.directions,
                1e-9 * light_field.samples() * sizeof(float), thread_count());
    std::printf(
        "| samples | points of the pupil | pictures a second | median | longest | processor time |\n"
        "|---|---|---|---|---|---|\n");
    const auto measure = [&](const char* name, const Take& take) {
        for (const std::size_t samples : study.pupil_samples) take_pictures(study, camera, name, samples, take);
    };
    const std::size_t bytes = buffer->radiance.size() * sizeof(float);
    measure("photograph()", [&](const Camera& eye, const RayPhotographOptions& options, Image& picture) {
        photograph_into(light_field, std::span(&eye, 1), options, std::span(&picture, 1));
    });
    for (const auto& [name, memory] : {std::pair{"floats", bytes}, {"halves", bytes / 2}}) {
        RayPhotographer photographer(light_field, {.memory = memory});
        measure(name, [&](const Camera& eye, const RayPhotographOptions& options, Image& picture) {
            photographer.photograph_into(eye, options, picture);
        });
    }
}

}  // namespace hogel::bench
