// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/core/part.h"
#include "hogel/core/random.h"
#include "hogel/core/rates.h"
#include "hogel/core/stop_scope.h"
#include "hogel/scene/shapes.h"
#include "hogel/scene/tessellate.h"
#include "hogel/shading/lighting.h"
#include "hogel/shading/triangles.h"
#include "hogel/work/parallel.h"
#include "hogel/work/steps.h"

namespace hogel {

using namespace shading;

namespace {

using std::numbers::pi;
constexpr std::size_t baked_vertices_per_task = 256;
constexpr std::size_t ray_divisor = 8;  // divisor of the number of rays in all rounds but the last
// Rays start at this fraction from a vertex to the middle of its triangles, away from edges of other surfaces.
constexpr double inside = 0.08;

Rgb emission_at(const Mesh& mesh, std::size_t vertex) {
    const Material& material = mesh.material;
    const auto& coordinates = mesh.emission_coordinates.empty() ? mesh.texture_coordinates : mesh.emission_coordinates;
    if (!material.emission_texture || coordinates.empty()) return material.emission;
    return material.emission *
           Texture(material.emission_texture, false, material.emission_sampling).sample(coordinates[vertex], 0);
}

/// All vertices of a scene in one list, with the points at which they gather light.
struct Surfaces {
    explicit Surfaces(const Scene& scene, ShadedScene without_light)
        : shaded(std::move(without_light)), caster(all_triangles(shaded)), offset(ray_offset(scene)) {
        std::vector<Vec3> middles(shaded.positions.size());
        std::vector<std::uint32_t> uses(shaded.positions.size());
        for (const auto& triangle : shaded.triangles)
            for (const std::uint32_t vertex : triangle.vertices) {
                const auto [a, b, c] = triangle.vertices;
                middles[vertex] += (shaded.positions[a] + shaded.positions[b] + shaded.positions[c]) / 3;
                ++uses[vertex];
            }
        for (std::size_t i = 0; i < uses.size(); ++i)
            ray_origins.push_back(uses[i] == 0 ? shaded.positions[i]
                                               : (1 - inside) * shaded.positions[i] + inside / uses[i] * middles[i]);
        for (const Mesh& mesh : scene.meshes)
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                normals.push_back(mesh.normals.empty() ? Vec3{0, 0, 0} : mesh.normals[i]);
                colors.push_back(vertex_color(mesh, i));
                emissions.push_back(emission_at(mesh, i));
                given.push_back(mesh.radiance.empty() ? 0 : 1);
            }
    }

    ShadedScene shaded;  // `radiance` of the previous round
    trace::RayCaster caster;
    double offset;
    std::vector<Vec3> ray_origins, normals;  // ray_origins: of the rays of each vertex
    std::vector<Rgb> colors, emissions;
    std::vector<char> given;  // whether the radiance of a vertex is given
};

ShadedScene unlit(const Scene& scene) {
    Scene dark = scene;
    dark.lights.clear();
    ShadedScene shaded;
    shaded.fronts_only = true;  // light arrives on both faces of a sheet, so both are kept
    shade_scene_into(dark, {.model = "vertex"}, shaded);
    return shaded;
}

/// Calls body(vertex) for all vertices, and reports progress between `from` and `to`.
void for_vertices(std::size_t n, const Progress& progress, double from, double to,
                  const std::function<void(std::size_t)>& body) {
    const std::size_t tasks = (n + baked_vertices_per_task - 1) / baked_vertices_per_task;
    const Progress range = progress.part(from, to);
    work::Steps steps(range, tasks);
    work::parallel_for(tasks, [&](std::size_t task) {
        for (std::size_t i = task * baked_vertices_per_task; i < std::min(n, (task + 1) * baked_vertices_per_task);
             ++i) {
            core::throw_if_stopped();
            body(i);
        }
        steps.report_one();
    });
}

std::vector<Rgb> direct_light(const Scene& scene, const Surfaces& surfaces, const Progress& progress, double from,
                              double to) {
    std::vector<Rgb> radiance(surfaces.normals.size());
    for_vertices(radiance.size(), progress, from, to, [&](std::size_t i) {
        const Rgb arriving =
            irradiance(scene, surfaces.caster, surfaces.offset, surfaces.ray_origins[i], surfaces.normals[i]);
        radiance[i] = static_cast<float>(std::numbers::inv_pi) * (surfaces.colors[i] * arriving);
    });
    return radiance;
}

/// Returns the mean radiance that arrives at a vertex, weighted by the cosine.
Rgb gather(const Scene& scene, const Surfaces& surfaces, std::size_t vertex, std::size_t rays, std::uint64_t seed) {
    const Vec3 normal = surfaces.normals[vertex];
    if (normal == Vec3{}) return scene.ambient;
    const scene::Across frame = scene::across(normal);
    const Vec3 origin = surfaces.ray_origins[vertex] + surfaces.offset * normal;
    const auto random = core::philox({static_cast<std::uint32_t>(vertex), static_cast<std::uint32_t>(rays), 0, 0},
                                     {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
    const double shift_a = random[0] / 4294967296.0, shift_b = random[1] / 4294967296.0;
    // Multiples of the inverse powers of the plastic number fill the square evenly; each vertex adds a random shift.
    constexpr double plastic = 1.32471795724474602596;
    Rgb sum{0, 0, 0};
    for (std::size_t k = 0; k < rays; ++k) {
        if (k % 65536 == 0) core::throw_if_stopped();
        const double a = shift_a + static_cast<double>(k + 1) / plastic;
        const double b = shift_b + static_cast<double>(k + 1) / (plastic * plastic);
        const double sine2 = a - std::floor(a), sine = std::sqrt(sine2), angle = 2 * pi * (b - std::floor(b));
        const Vec3 direction = sine * std::cos(angle) * frame.first + sine * std::sin(angle) * frame.second +
                               std::sqrt(1 - sine2) * normal;
        const trace::RayHit hit = surfaces.caster.closest(origin, direction, std::numeric_limits<double>::infinity());
        if (hit.triangle == trace::RayHit::miss) {
            sum += scene.ambient;
            continue;
        }
        const std::array<float, 3> weights{1 - hit.b1 - hit.b2, hit.b1, hit.b2};
        const Vec3 facing = interpolate(surfaces.normals, surfaces.shaded.triangles[hit.triangle].vertices, weights);
        if (dot(facing, direction) > 0) continue;
        sum += radiance_at(surfaces.shaded, hit.triangle, weights[0], weights[1], weights[2]);
    }
    return 1 / static_cast<float>(rays) * sum;
}

/// Sets the radiance of each vertex of meshes without given radiance.
void set_radiance(Scene& scene, const Surfaces& surfaces, const std::vector<Rgb>& values) {
    std::size_t base = 0;
    for (Mesh& mesh : scene.meshes) {
        const std::size_t n = mesh.positions.size();
        if (n > 0 && !surfaces.given[base])
            mesh.radiance.assign(values.begin() + static_cast<std::ptrdiff_t>(base),
                                 values.begin() + static_cast<std::ptrdiff_t>(base + n));
        base += n;
    }
}

/// Returns the light that arrives at each vertex from other surfaces.
std::vector<Rgb> indirect_light(const Scene& scene, Surfaces& surfaces, const BakeOptions& options,
                                const Progress& progress) {
    const std::size_t vertices = surfaces.normals.size();
    const std::vector<Rgb> direct = direct_light(scene, surfaces, progress, 0, 0.1);
    std::vector<Rgb> indirect(vertices);
    for (std::size_t round = 0; round < options.bounces; ++round) {
        for (std::size_t i = 0; i < vertices; ++i)
            if (!surfaces.given[i])
                surfaces.shaded.radiance[i] = surfaces.emissions[i] + direct[i] + surfaces.colors[i] * indirect[i];
        const bool last = round + 1 == options.bounces;
        const std::size_t rays = last ? options.rays : (options.rays + ray_divisor - 1) / ray_divisor;
        const double from = last ? 0.4 : 0.1 + 0.3 * static_cast<double>(round) / static_cast<double>(options.bounces);
        for_vertices(vertices, progress, from, last ? 0.7 : from, [&](std::size_t i) {
            if (!surfaces.given[i]) indirect[i] = gather(scene, surfaces, i, rays, options.seed + round);
        });
    }
    return indirect;
}

void require_normals_to_bake(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        if (mesh.normals.empty() && !mesh.triangles.empty() && mesh.radiance.empty())
            throw Error(ErrorCode::bad_input, "mesh '" + mesh.name + "': no normals; expected one a vertex");
}

}  // namespace

Scene bake_scene(const Scene& scene, const BakeOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    core::require_part("Embree", "baking");
    if (options.rays == 0) throw Error(ErrorCode::usage, "rays", "baking with 0 rays a vertex; expected 1 or more");
    validate(scene);
    require_normals_to_bake(scene);
    if (unlit(scene).layers)
        throw Error(
            ErrorCode::bad_input,
            fmt::format("scene '{}': has masks or surfaces that blend; expected opaque ones to bake", scene.name));
    Scene baked = scene;
    {
        // Here `radiance` holds the arriving indirect light, which the tessellation interpolates.
        Surfaces coarse(scene, unlit(scene));
        set_radiance(baked, coarse, indirect_light(scene, coarse, options, progress));
    }
    baked = scene::tessellate(baked, options.tessellation);
    Scene bare = baked;
    for (std::size_t i = 0; i < bare.meshes.size(); ++i)
        if (scene.meshes[i].radiance.empty()) bare.meshes[i].radiance.clear();
    const Surfaces fine(bare, unlit(bare));
    const std::vector<Rgb> direct = direct_light(bare, fine, progress, 0.7, 1);
    std::size_t base = 0;
    for (std::size_t m = 0; m < baked.meshes.size(); ++m) {
        Mesh& mesh = baked.meshes[m];
        for (std::size_t i = 0; i < mesh.radiance.size() && scene.meshes[m].radiance.empty(); ++i)
            mesh.radiance[i] = fine.emissions[base + i] + direct[base + i] + fine.colors[base + i] * mesh.radiance[i];
        base += mesh.positions.size();
    }
    return baked;
}

Plan plan_bake(const Scene& scene, const BakeOptions& options) {
    // Bytes per triangle of the result, in memory during computation and in a file.
    constexpr double triangle = 310, file_triangle = 31;
    const double triangles = static_cast<double>(triangle_count(scene)) * static_cast<double>(options.tessellation) *
                             static_cast<double>(options.tessellation);
    double vertices = 0;
    for (const Mesh& mesh : scene.meshes) vertices += static_cast<double>(mesh.positions.size());
    const double rays = vertices * static_cast<double>(options.rays) *
                        (1 + static_cast<double>(options.bounces) / static_cast<double>(ray_divisor));
    return {triangles * triangle, triangles * file_triangle,
            core::rates::on_all_threads(rays * core::rates::gathered_ray)};
}

}  // namespace hogel
