// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/measure.h"
#include "bench/session.h"
#include "bench/studies/studies.h"
#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/image.h"
#include "hogel/photograph.h"
#include "hogel/renderer.h"
#include "hogel/scene_hologram.h"
#include "hogel/table.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::bench {
namespace {

constexpr double wavelength = 633e-9, pitch = 3e-6;
constexpr std::size_t hogel_side = 16;  // samples

// Adds a square of 24 × 24 cells with a wavy pattern.
void add_plane(ShadedScene& scene, double half, double left, double right, double depth, double slope, float level) {
    constexpr std::uint32_t cells = 24;
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    const std::uint32_t mesh = scene.triangles.empty() ? 0 : scene.triangles.back().mesh + 1;
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i) {
            const double x = left + (right - left) * i / cells, y = half * (2.0 * j / cells - 1);
            const auto radiance =
                static_cast<float>(level * (0.55 + 0.45 * std::sin(5 * x / half) * std::sin(6 * y / half)));
            scene.positions.push_back({x, y, -(depth + slope * x)});
            scene.radiance.push_back({radiance, radiance, radiance});
        }
    scene.texture_coordinates.resize(scene.positions.size());
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = first + j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            scene.triangles.push_back({{a, b, d}, ShadedScene::no_texture, mesh});
            scene.triangles.push_back({{a, d, c}, ShadedScene::no_texture, mesh});
        }
}

// The photograph by rays alone.
Image by_rays(const ShadedScene& scene, const Camera& camera) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& triangle : scene.triangles) triangles.push_back(triangle.vertices);
    const trace::RayCaster caster(scene.positions, triangles);
    const Grid& picture = camera.picture;
    Image image(picture.width, picture.height, 1);
    constexpr int pupil = 6, fine = 4;
    for (std::size_t row = 0; row < picture.height; ++row)
        for (std::size_t column = 0; column < picture.width; ++column) {
            double sum = 0, count = 0;
            for (int k = 0; k < pupil * pupil * fine * fine; ++k) {
                const double qx = 2 * (k % pupil + 0.5) / pupil - 1, qy = 2 * (k / pupil % pupil + 0.5) / pupil - 1;
                if (qx * qx + qy * qy > 1) continue;
                const int at = k / (pupil * pupil);
                const Vec3 place{picture.x(double(column) + (at % fine + 0.5) / fine - 0.5),
                                 picture.y(double(row) + (at / fine + 0.5) / fine - 0.5), 0};
                const double stretch = (camera.eye.z + camera.focus_depth) / camera.eye.z;
                const Vec3 focus = camera.eye + stretch * (place - camera.eye);
                const Vec3 from = camera.eye + Vec3{0.5 * camera.pupil * qx, 0.5 * camera.pupil * qy, 0};
                const trace::RayHit hit = caster.closest(from, focus - from, 100);
                count += 1;
                if (hit.triangle != trace::RayHit::miss)
                    sum += radiance_at(scene, hit.triangle, 1 - hit.b1 - hit.b2, hit.b1, hit.b2).r;
            }
            image.pixels(row, column, 0) = static_cast<float>(sum / count);
        }
    return image;
}

// A scene, and the depth of the camera's focus.
struct Test {
    std::shared_ptr<const ShadedScene> scene;
    double focus;
};

// A textured plane.
Test tilted(double depth, double half) {
    auto scene = std::make_shared<ShadedScene>();
    add_plane(*scene, half, -half, half, depth, std::tan(15 * std::numbers::pi / 180), 1);
    return {scene, depth};
}

// A patch of a few resolution cells.
Test point(double depth, double half) {
    auto scene = std::make_shared<ShadedScene>();
    const double little = 0.12 * half;
    add_plane(*scene, little, -little, little, depth, 0, 1);
    return {scene, depth};
}

// A surface of uniform radiance wider than the hologram.
Test uniform(double depth, double half) {
    auto scene = std::make_shared<ShadedScene>();
    add_plane(*scene, 3 * half, -3 * half, 3 * half, depth, 0, 0);
    for (auto& radiance : scene->radiance) radiance = {0.5f, 0.5f, 0.5f};
    return {scene, depth};
}

// A near plane that hides half of a far one.
Test occluding(double depth, double half) {
    auto scene = std::make_shared<ShadedScene>();
    add_plane(*scene, half, -half, half, depth + 1e-3, 0, 1);
    add_plane(*scene, half, -half, 0, depth - 1e-3, 0, 0.5f);
    return {scene, depth - 1e-3};
}

// A method with its options, from the scene to a hologram, either directly or through a light field.
struct MeasuredMethod {
    std::string name;
    std::string scene_method;  // empty: through a light field
    HologramOptions stereogram;
};

std::vector<MeasuredMethod> methods() {
    std::vector<MeasuredMethod> all;
    const auto add = [&](const std::string& name, const HologramMethod& method) {
        HologramOptions options;
        options.channel.wavelength = wavelength;
        options.pitch = pitch;
        options.method = method;
        all.push_back({name, "", options});
    };
    for (const HologramMethodInfo& info : hologram_methods().rows()) {
        if (line_pitch(info.method)) continue;  // horizontal parallax only: another light field
        add(info.name, info.method);
        if (std::holds_alternative<Fourier>(info.method))
            add(info.name + ", designed", Fourier{.phases = Phases::designed});
    }
    for (const std::string& name : scene_hologram_methods().names()) all.push_back({name, name, {}});
    return all;
}

Field make(const MeasuredMethod& method, const ShadedScene& scene, const LightFieldBuffer* light_field,
           std::size_t samples, std::uint64_t seed) {
    if (!light_field) {
        SceneHologramOptions options;
        options.seed = seed;
        options.spacing = 20e-6;
        return scene_hologram_methods()
            .find(method.scene_method)
            .make(scene, {{samples, samples, pitch, pitch, 0, 0}, wavelength}, options, {});
    }
    HologramOptions options = method.stereogram;
    options.seed = seed;
    const auto source = make_hologram(borrow(*light_field), options);
    Field field(source->grid());
    copy(*source, field);
    return field;
}

// The light field for a method: as many directions as a hogel shows, limited to those to which the pitch diffracts.
LightFieldBuffer light_field_for(const MeasuredMethod& method, const std::shared_ptr<const ShadedScene>& scene,
                                 std::size_t samples) {
    const bool windows = std::holds_alternative<OverlapAdd>(method.stereogram.method);
    const double tangent = 0.98 * std::tan(std::asin(wavelength / (2 * pitch)));
    const std::size_t n = windows ? samples / 2 : samples / hogel_side, d = windows ? 9 : hogel_side;
    const LightFieldGrid grid{n, n, double(samples) * pitch / double(n), d, d, Perspective{tangent, tangent}, 3};
    LightFieldBuffer light_field(grid, true);
    copy(*make_renderer("raytrace", scene, grid), light_field);
    return light_field;
}

Camera camera_focused_on(double depth, double size) {
    Camera camera;
    camera.eye = {0, 0, 100e-3};
    camera.pupil = 3e-3;
    camera.focus_depth = depth;
    camera.picture = {20, 20, 0.85 * size / 20, 0.85 * size / 20, 0, 0};
    return camera;
}

// The processor time of the holograms.
struct Cost {
    double seconds = 0;
    int holograms = 0;
};

// Prints one cell of the table: the similarity of the mean photograph to that by rays.
void measure(const MeasuredMethod& method, const Test& test, const HologramStudy& study, Cost& cost) {
    const Camera camera = camera_focused_on(test.focus, double(study.samples) * pitch);
    std::optional<LightFieldBuffer> light_field;
    if (method.scene_method.empty()) light_field.emplace(light_field_for(method, test.scene, study.samples));
    try {
        Image mean(camera.picture.width, camera.picture.height, 1);
        for (std::size_t look = 0; look < study.looks; ++look) {
            stop_if_interrupted();
            const double start = processor_seconds();
            const Field field =
                make(method, *test.scene, light_field ? &*light_field : nullptr, study.samples, look + 1);
            cost.seconds += processor_seconds() - start;
            ++cost.holograms;
            const Image seen = photograph(field, std::span(&camera, 1))[0];
            for (std::size_t i = 0; i < mean.pixels.size(); ++i)
                mean.pixels.data()[i] += seen.pixels.data()[i] / float(study.looks);
        }
        const ImageComparison result = compare(by_rays(*test.scene, camera), mean);
        std::printf(" %.1f/%.2f |", result.psnr, result.ssim);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) throw;
        std::printf(" refused |");
    }
    std::fflush(stdout);
}

}  // namespace

void study_hologram(const HologramStudy& study) {
    std::vector<std::string> known;
    for (const MeasuredMethod& method : methods()) known.push_back(method.name);
    for (const std::string& name : study.methods)
        if (std::ranges::count(known, name) == 0) throw_unknown("method", name, known);
    constexpr std::array depths{-20e-3, -5e-3, 5e-3, 20e-3};
    const double half = 0.35 * double(study.samples) * pitch;
    std::printf("| method |");
    for (const char* name : {"point", "uniform", "tilted plane", "two planes"})
        std::printf(" %s at -20 mm | -5 | 5 | 20 |", name);
    std::printf(" seconds |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const MeasuredMethod& method : methods()) {
        if (!study.methods.empty() && std::ranges::count(study.methods, method.name) == 0) continue;
        std::printf("| `%s` |", method.name.c_str());
        Cost cost;
        for (const auto test : {point, uniform, tilted, occluding})
            for (const double depth : depths) measure(method, test(depth, half), study, cost);
        if (cost.holograms > 0)
            std::printf(" %.3f |\n", cost.seconds / cost.holograms);
        else
            std::printf(" |\n");
    }
}

}  // namespace hogel::bench
