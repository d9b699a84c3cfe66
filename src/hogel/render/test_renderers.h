// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/renderer.h"

namespace hogel::render {

/// Returns the names of the renderers to test, except the reference `without`.
inline std::vector<std::string> renderer_names(std::string_view without = "") {
    std::vector<std::string> names = renderers().names();
    std::erase(names, without);
    return names;
}

inline bool crosses_plane(std::string_view name) { return renderers().find(name).crosses_plane; }

/// Returns whether a renderer cuts simplices for every sample; it is slow if triangles are large.
inline bool cuts_simplices(std::string_view name) { return name == "simplex" || name == "simplex-strips"; }

inline std::string test_name(std::string name) {
    std::ranges::replace(name, '-', '_');
    return name;
}

inline LightFieldBuffer render(std::string_view name, const std::shared_ptr<const ShadedScene>& scene,
                               const LightFieldGrid& grid, const SamplesPerRay& samples = {}) {
    LightFieldBuffer light_field(grid, true);
    copy(*make_renderer(name, scene, grid, samples), light_field);
    return light_field;
}

inline LightFieldBuffer render(std::string_view name, const ShadedScene& scene, const LightFieldGrid& grid,
                               const SamplesPerRay& samples = {}) {
    return render(name, std::make_shared<const ShadedScene>(scene), grid, samples);
}

inline bool same_bytes(const LightFieldBuffer& a, const LightFieldBuffer& b) {
    return std::ranges::equal(a.radiance.elements(), b.radiance.elements()) &&
           std::ranges::equal(a.depth.elements(), b.depth.elements());
}

inline std::uint32_t add_vertex(ShadedScene& scene, Vec3 position, Rgb radiance = {}) {
    scene.positions.push_back(position);
    scene.radiance.push_back(radiance);
    scene.texture_coordinates.push_back({});
    return static_cast<std::uint32_t>(scene.positions.size() - 1);
}

inline void add_triangle(ShadedScene& scene, Vec3 a, Vec3 b, Vec3 c, const std::function<Rgb(Vec3)>& radiance) {
    const std::uint32_t first = add_vertex(scene, a, radiance(a));
    add_vertex(scene, b, radiance(b));
    add_vertex(scene, c, radiance(c));
    scene.triangles.push_back({{first, first + 1, first + 2}, ShadedScene::no_texture, 0});
}

inline Rgb white(Vec3) { return {1, 1, 1}; }

/// Returns random triangles within 4 mm of the hologram plane, or 1 to 9 mm behind it. Some have no area, some are
/// extremely thin, and some show their front to some hogels and their back to others. Behind the plane some come as
/// close to it as any renderer supports.
inline ShadedScene random_scene(std::mt19937& random, std::size_t count, bool behind) {
    std::uniform_real_distribution<double> coordinate(-4e-3, 4e-3);
    std::uniform_real_distribution<float> colour(0, 1);
    ShadedScene scene;
    scene.background = {0.5f, 0.5f, 0.5f};
    const auto point = [&] {
        return Vec3{coordinate(random), coordinate(random), coordinate(random) - (behind ? 5e-3 : 0)};
    };
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 a = point(), b = point(), c = point();
        if (i % 8 == 0) c = a;
        if (i % 8 == 1) c = 0.5 * (a + b) + 1e-9 * c;
        if (i % 8 == 2 || i % 8 == 3) {
            // In a plane through a point among the hogels.
            const Vec3 seen_edge_on{0.4 * coordinate(random), 0.4 * coordinate(random), 0};
            b = a + 0.1 * b;
            c = seen_edge_on + 0.6 * (a - seen_edge_on) + 0.3 * (b - seen_edge_on);
        }
        if (i % 8 == 4 && behind) c.z = -1e-9;
        const Rgb flat{colour(random), colour(random), colour(random)};
        add_triangle(scene, a, b, c, [&](Vec3) { return flat; });
    }
    return scene;
}

}  // namespace hogel::render
