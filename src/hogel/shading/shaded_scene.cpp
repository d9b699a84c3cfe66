#include "hogel/shading/shaded_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "hogel/core/error.h"
#include "hogel/core/parallel.h"
#include "hogel/trace/ray_caster.h"

namespace hogel {
namespace {

constexpr std::size_t vertices_per_task = 1024;
// Shadow rays start this far above the surface, as a part of the scene's diagonal, so that a vertex does not stand in
// its own light.
constexpr double shadow_offset = 1e-4;

struct Illumination {
    Vec3 to_light;  ///< unit length
    double distance = std::numeric_limits<double>::infinity();
    double falloff = 1;  ///< irradiance at normal incidence per intensity
};

Illumination illuminate(const Light& light, Vec3 point) {
    if (light.kind == Light::Kind::directional) return {-normalize(light.direction)};
    const Vec3 way = light.position - point;
    const double distance = length(way);
    if (distance == 0) return {{}, 0, 0};
    return {way / distance, distance, 1 / (distance * distance)};
}

Rgb irradiance(const Scene& scene, const RayCaster& caster, double offset, Vec3 point, Vec3 normal) {
    Rgb sum{0, 0, 0};
    for (const Light& light : scene.lights) {
        const Illumination from = illuminate(light, point);
        const double cosine = dot(normal, from.to_light);
        if (!(cosine > 0)) continue;
        if (light.casts_shadows && caster.occluded(point + offset * normal, from.to_light, 0, from.distance)) continue;
        sum += static_cast<float>(from.falloff * cosine) * light.intensity;
    }
    return sum;
}

std::array<float, 3> texel(const Image& image, std::size_t row, std::size_t column) {
    if (image.channels() == 1) {
        const float grey = image.pixels(row, column, 0);
        return {grey, grey, grey};
    }
    return {image.pixels(row, column, 0), image.pixels(row, column, 1), image.pixels(row, column, 2)};
}

/// The two neighbours of a position in 0..1 (wrapped around) among n samples, and the weight of the second.
struct Neighbours {
    std::size_t first, second;
    float weight;
};

Neighbours neighbours(double position, std::size_t n) {
    const double at = (position - std::floor(position)) * static_cast<double>(n) - 0.5;
    const double low = std::floor(at);
    const auto first = static_cast<std::size_t>(low < 0 ? low + static_cast<double>(n) : low);
    return {std::min(first, n - 1), first + 1 < n ? first + 1 : 0, static_cast<float>(at - low)};
}

Rgb sample_texture(const Image& image, TextureCoordinate at) {
    const Neighbours column = neighbours(at.u, image.width()), row = neighbours(1.0 - at.v, image.height());
    const auto a = texel(image, row.first, column.first), b = texel(image, row.first, column.second);
    const auto c = texel(image, row.second, column.first), d = texel(image, row.second, column.second);
    std::array<float, 3> mixed;
    for (std::size_t i = 0; i < 3; ++i) {
        const float top = a[i] + column.weight * (b[i] - a[i]), bottom = c[i] + column.weight * (d[i] - c[i]);
        mixed[i] = top + row.weight * (bottom - top);
    }
    return {mixed[0], mixed[1], mixed[2]};
}

void append_geometry(const Scene& scene, ShadedScene& shaded) {
    std::map<const Image*, std::uint32_t> texture_index;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const auto base = static_cast<std::uint32_t>(shaded.positions.size());
        shaded.positions.insert(shaded.positions.end(), mesh.positions.begin(), mesh.positions.end());
        if (mesh.texture_coordinates.empty())
            shaded.texture_coordinates.resize(shaded.positions.size());
        else
            shaded.texture_coordinates.insert(shaded.texture_coordinates.end(), mesh.texture_coordinates.begin(),
                                              mesh.texture_coordinates.end());
        std::uint32_t texture = ShadedScene::no_texture;
        if (const auto& image = mesh.material.base_color_texture; image && image->pixels.size() > 0) {
            const auto [known, is_new] =
                texture_index.emplace(image.get(), static_cast<std::uint32_t>(shaded.textures.size()));
            if (is_new) shaded.textures.push_back(image);
            texture = known->second;
        }
        for (const auto& [a, b, c] : mesh.triangles)
            shaded.triangles.push_back({{base + a, base + b, base + c}, texture, static_cast<std::uint32_t>(m)});
    }
}

}  // namespace

ShadedScene shade_vertices(const Scene& scene) {
    validate(scene);
    ShadedScene shaded;
    shaded.background = scene.background;
    append_geometry(scene, shaded);
    shaded.radiance.resize(shaded.positions.size());

    std::vector<std::array<std::uint32_t, 3>> blockers;
    if (std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) { return l.casts_shadows; }))
        for (const auto& triangle : shaded.triangles) blockers.push_back(triangle.vertices);
    const RayCaster caster(shaded.positions, blockers);
    const Bounds box = bounds(scene);
    const double offset = shadow_offset * length(box.high - box.low);
    constexpr auto reflected = static_cast<float>(std::numbers::inv_pi);

    std::size_t base = 0;
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t n = mesh.positions.size();
        if (mesh.normals.empty() && !scene.lights.empty() && !mesh.triangles.empty())
            throw Error(ErrorCode::bad_input,
                        "mesh '" + mesh.name + "': no normals; expected one a vertex (see add_missing_normals)");
        parallel_for((n + vertices_per_task - 1) / vertices_per_task, [&](std::size_t task) {
            const std::size_t first = task * vertices_per_task;
            for (std::size_t i = first; i < std::min(n, first + vertices_per_task); ++i) {
                Rgb light = scene.ambient;
                if (!mesh.normals.empty())
                    light += reflected * irradiance(scene, caster, offset, mesh.positions[i], mesh.normals[i]);
                const Rgb color =
                    mesh.colors.empty() ? mesh.material.base_color : mesh.material.base_color * mesh.colors[i];
                shaded.radiance[base + i] = color * light + mesh.material.emission;
            }
        });
        base += n;
    }
    return shaded;
}

Rgb radiance_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2) {
    const ShadedScene::Triangle& triangle = scene.triangles[index];
    const auto [a, b, c] = triangle.vertices;
    const Rgb radiance = b0 * scene.radiance[a] + b1 * scene.radiance[b] + b2 * scene.radiance[c];
    if (triangle.texture == ShadedScene::no_texture) return radiance;
    const auto &ta = scene.texture_coordinates[a], &tb = scene.texture_coordinates[b],
               &tc = scene.texture_coordinates[c];
    return radiance * sample_texture(*scene.textures[triangle.texture],
                                     {b0 * ta.u + b1 * tb.u + b2 * tc.u, b0 * ta.v + b1 * tb.v + b2 * tc.v});
}

}  // namespace hogel
