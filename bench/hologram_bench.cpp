// SPDX-License-Identifier: Apache-2.0
// Every method on the same scenes: quality of the photograph and time, as a Markdown table.
//   hologram_bench [samples=256] [looks=2] [methods...]
// A small patch, a wide surface of one radiance, a textured plane tilted by 15 degrees, and a near plane that hides
// half of a far one, at depths from −20 to 20 mm. A hologram of samples × samples at 3 µm, 633 nm; a lens of 3 mm, 100
// mm away, focused on the middle of the scene or on the near plane; photographs of `looks` independent sets of phases
// averaged. The reference is the same camera by rays. PSNR and SSIM are limited by speckle, alike for all. Seconds: of
// one hologram, on all threads.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/image.h"
#include "hogel/photograph.h"
#include "hogel/renderer.h"
#include "hogel/scene_hologram.h"
#include "hogel/trace/ray_caster.h"

namespace {

using namespace hogel;

constexpr double wavelength = 633e-9, pitch = 3e-6;
constexpr std::size_t hogel_side = 16;  // samples

// A square of 24 × 24 cells with a wavy pattern.
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

struct Test {
    std::shared_ptr<const ShadedScene> scene;
    double focus;
};

Test tilted(double depth, double half) {
    auto scene = std::make_shared<ShadedScene>();
    add_plane(*scene, half, -half, half, depth, std::tan(15 * std::numbers::pi / 180), 1);
    return {scene, depth};
}

// A patch of a few resolution cells: where it lies, and how bright.
Test point(double depth, double half) {
    auto scene = std::make_shared<ShadedScene>();
    const double little = 0.12 * half;
    add_plane(*scene, little, -little, little, depth, 0, 1);
    return {scene, depth};
}

// A surface of one radiance wider than the hologram: parallel light in all directions alike.
Test uniform(double depth, double half) {
    auto scene = std::make_shared<ShadedScene>();
    add_plane(*scene, 3 * half, -3 * half, 3 * half, depth, 0, 0);
    for (auto& radiance : scene->radiance) radiance = {0.5f, 0.5f, 0.5f};
    return {scene, depth};
}

Test occluding(double depth, double half) {
    auto scene = std::make_shared<ShadedScene>();
    add_plane(*scene, half, -half, half, depth + 1e-3, 0, 1);
    add_plane(*scene, half, -half, 0, depth - 1e-3, 0, 0.5f);
    return {scene, depth - 1e-3};
}

// From the scene to one hologram of the seed, or to a light field and then that.
struct PropagationOptions {
    std::string name;
    std::string scene_method;
    HologramOptions stereogram;
};

std::vector<PropagationOptions> ways() {
    std::vector<PropagationOptions> all;
    const auto add = [&](const char* name, Method method, Phases phases) {
        HologramOptions options;
        options.wavelength = wavelength;
        options.pitch = pitch;
        options.method = method;
        options.phases = phases;
        all.push_back({name, "", options});
    };
    add("fourier", Method::fourier, Phases::random);
    add("fourier, designed", Method::fourier, Phases::designed);
    add("basis", Method::basis, Phases::fixed);
    add("phase-added", Method::fourier, Phases::phase_added);
    add("phase-added-exact", Method::fourier, Phases::phase_added_exact);
    add("olas", Method::overlap_add, Phases::random);
    for (const char* name : {"points", "points-visible", "points-tiled", "points-hpo", "edges", "lines", "fraunhofer",
                             "fresnel", "planes", "polygons", "polygons-visible"})
        all.push_back({name, name, {}});
    return all;
}

Field make(const PropagationOptions& way, const ShadedScene& scene, const LightFieldBuffer* light_field,
           std::size_t samples, std::uint64_t seed) {
    if (!light_field) {
        SceneHologramOptions options;
        options.seed = seed;
        options.spacing = 20e-6;
        return find_scene_method(way.scene_method)
            ->make(scene, {{samples, samples, pitch, pitch, 0, 0}, wavelength}, options, {});
    }
    HologramOptions options = way.stereogram;
    options.seed = seed;
    const auto source = make_hologram(*light_field, options);
    Field field(source->grid());
    copy(*source, field);
    return field;
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t samples = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 256;
    const std::size_t looks = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 2;
    const double size = double(samples) * pitch, half = 0.35 * size;
    const std::vector<double> depths{-20e-3, -5e-3, 5e-3, 20e-3};
    std::printf("| method |");
    for (const char* name : {"point", "uniform", "tilted plane", "two planes"})
        std::printf(" %s at -20 mm | -5 | 5 | 20 |", name);
    std::printf(" seconds |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const PropagationOptions& way : ways()) {
        if (argc > 3 && std::find(argv + 3, argv + argc, way.name) == argv + argc) continue;
        std::printf("| `%s` |", way.name.c_str());
        double seconds = 0;
        int made = 0;
        for (const auto test : {point, uniform, tilted, occluding})
            for (const double depth : depths) {
                const auto [scene, focus] = test(depth, half);
                Camera camera;
                camera.eye = {0, 0, 100e-3};
                camera.pupil = 3e-3;
                camera.focus_depth = focus;
                camera.picture = {20, 20, 0.85 * size / 20, 0.85 * size / 20, 0, 0};
                std::unique_ptr<LightFieldBuffer> light_field;
                if (way.scene_method.empty()) {
                    // As many directions as a hogel shows, within what the pitch diffracts to.
                    const bool windows = way.stereogram.method == Method::overlap_add;
                    const double tangent = 0.98 * std::tan(std::asin(wavelength / (2 * pitch)));
                    const std::size_t n = windows ? samples / 2 : samples / hogel_side, d = windows ? 9 : hogel_side;
                    const LightFieldGrid grid{n, n, size / double(n), d, d, Perspective{tangent, tangent}, 3};
                    light_field = std::make_unique<LightFieldBuffer>(grid, true);
                    copy(*make_renderer("raytrace", scene, grid), *light_field);
                }
                try {
                    Image mean(20, 20, 1);
                    for (std::size_t look = 0; look < looks; ++look) {
                        const std::clock_t start = std::clock();
                        const Field field = make(way, *scene, light_field.get(), samples, look + 1);
                        seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
                        ++made;
                        const Image seen = photograph(field, std::span(&camera, 1))[0];
                        for (std::size_t i = 0; i < 400; ++i)
                            mean.pixels.data()[i] += seen.pixels.data()[i] / float(looks);
                    }
                    const Image truth = by_rays(*scene, camera);
                    const ImageComparison result = compare(truth, mean);
                    std::printf(" %.1f/%.2f |", result.psnr, result.ssim);
                } catch (const Error&) {
                    std::printf(" refused |");
                }
                std::fflush(stdout);
            }
        if (made > 0)
            std::printf(" %.3f |\n", seconds / made);
        else
            std::printf(" |\n");
    }
}
