#include "hogel/scene/builtin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "hogel/core/error.h"
#include "hogel/scene/analytic.h"
#include "hogel/shading/shaded_scene.h"
#include "hogel/trace/ray_caster.h"

namespace hogel {
namespace {

constexpr double size = 0.02;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Eye {
    explicit Eye(const Scene& scene) : shaded(shade_vertices(scene)), caster(shaded.positions, triangles(shaded)) {}
    static std::vector<std::array<std::uint32_t, 3>> triangles(const ShadedScene& scene) {
        std::vector<std::array<std::uint32_t, 3>> list;
        for (const auto& triangle : scene.triangles) list.push_back(triangle.vertices);
        return list;
    }
    AnalyticSample see(double s, double t, double U, double V) const {
        const RayHit hit = caster.closest({s - U * size, t - V * size, size}, {U, V, -1}, infinity);
        if (hit.triangle == RayHit::miss) return {shaded.background, infinity, 0};
        return {radiance_at(shaded, hit.triangle, 1 - hit.b1 - hit.b2, hit.b1, hit.b2), hit.distance - size, 0};
    }
    ShadedScene shaded;
    RayCaster caster;
};

TEST(Analytic, closed_forms_agree_with_traced_meshes) {
    for (const BuiltinScene& builtin : builtin_scenes()) {
        if (!has_analytic_radiance(builtin.name)) continue;
        const Eye eye(make_builtin_scene(builtin.name, size));
        std::mt19937 engine(5);
        std::uniform_real_distribution<double> place(-0.5 * size, 0.5 * size), direction(-0.36, 0.36);
        int hits = 0, misses = 0;
        for (int i = 0; i < 40000; ++i) {
            double U = direction(engine), V = direction(engine);
            double s = place(engine), t = place(engine);
            if (builtin.name == "point" && i % 2 == 0) {  // or hardly any ray would hit it
                s = 0.1 * size - U * 0.15 * size + 0.01 * s;
                t = 0.05 * size - V * 0.15 * size + 0.01 * t;
            }
            const AnalyticSample exact = analytic_radiance(builtin.name, size, s, t, U, V);
            if (exact.clearance < (builtin.name == "point" ? 1e-5 : 1e-3) * size) continue;
            const AnalyticSample seen = eye.see(s, t, U, V);
            ASSERT_EQ(std::isfinite(seen.depth), std::isfinite(exact.depth)) << builtin.name;
            (std::isfinite(exact.depth) ? hits : misses)++;
            ASSERT_NEAR(seen.radiance.r, exact.radiance.r, 1e-3) << builtin.name;
            ASSERT_NEAR(seen.radiance.g, exact.radiance.g, 1e-3) << builtin.name;
            ASSERT_NEAR(seen.radiance.b, exact.radiance.b, 1e-3) << builtin.name;
            if (!std::isfinite(exact.depth)) continue;
            ASSERT_NEAR(seen.depth, exact.depth, (builtin.name == "sphere" ? 1e-3 : 1e-9) * size) << builtin.name;
        }
        EXPECT_GT(hits, 5000) << builtin.name;
        EXPECT_GT(misses, 1000) << builtin.name;
    }
}

TEST(Analytic, names_what_it_knows) {
    EXPECT_FALSE(has_analytic_radiance("pumpkin"));
    EXPECT_THROW(analytic_radiance("pumpkin", size, 0, 0, 0, 0), Error);
}

TEST(Builtin, scenes_fill_the_hologram_and_straddle_it) {
    for (const char* name : {"pumpkin", "tower"}) {
        const Scene scene = make_builtin_scene(name, size);
        EXPECT_NO_THROW(validate(scene));
        const auto [low, high] = bounds(scene);
        EXPECT_NEAR(std::max(high.x - low.x, high.y - low.y), 0.88 * size, 0.03 * size) << name;
        EXPECT_LT(low.z, -0.2 * size) << name;
        EXPECT_GT(low.z, -0.35 * size) << name;
        EXPECT_NEAR(high.z, -low.z, 0.05 * size) << name;
    }
}

TEST(Builtin, the_pumpkin_has_the_triangles_of_the_one_in_the_thesis) {
    EXPECT_NEAR(static_cast<double>(triangle_count(make_builtin_scene("pumpkin", size))), 16318, 163);
}

// Every edge of skin and flesh together has two triangles, in opposite directions: nothing leaks at the carved rims.
TEST(Builtin, the_pumpkin_is_watertight) {
    const Scene scene = make_builtin_scene("pumpkin", size);
    using Point = std::array<double, 3>;
    std::map<std::array<Point, 2>, int> edges;
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.name != "skin" && mesh.name != "flesh") continue;
        for (const auto& t : mesh.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 p = mesh.positions[t[k]], q = mesh.positions[t[(k + 1) % 3]];
                ++edges[{Point{p.x, p.y, p.z}, Point{q.x, q.y, q.z}}];
            }
    }
    EXPECT_GT(edges.size(), 30000u);
    for (const auto& [edge, count] : edges) {
        const auto twin = edges.find({edge[1], edge[0]});
        ASSERT_NE(twin, edges.end());
        ASSERT_EQ(twin->second, count);
    }
}

TEST(Builtin, radiances_are_those_of_a_picture) {
    for (const BuiltinScene& builtin : builtin_scenes()) {
        const ShadedScene shaded = shade_vertices(make_builtin_scene(builtin.name, size));
        float brightest = 0;
        for (const Rgb& c : shaded.radiance) brightest = std::max({brightest, c.r, c.g, c.b});
        EXPECT_GT(brightest, 0.5f) << builtin.name;
        EXPECT_LT(brightest, 20.0f) << builtin.name;
    }
}

TEST(Builtin, the_size_of_the_hologram_changes_nothing_but_the_size) {
    for (const BuiltinScene& builtin : builtin_scenes()) {
        const Scene small = make_builtin_scene(builtin.name, size), large = make_builtin_scene(builtin.name, 2 * size);
        const ShadedScene a = shade_vertices(small), b = shade_vertices(large);
        ASSERT_EQ(a.positions.size(), b.positions.size());
        std::size_t different = 0;  // a shadow ray that grazes an edge may go either way
        for (std::size_t i = 0; i < a.positions.size(); ++i) {
            ASSERT_NEAR(length(2 * a.positions[i] - b.positions[i]), 0, 1e-12 * size);
            different += std::abs(a.radiance[i].r - b.radiance[i].r) > 1e-4f;
        }
        EXPECT_LT(different, 5 + a.positions.size() / 1000) << builtin.name;
    }
}

TEST(Builtin, unknown_names_and_sizes_are_usage_errors_that_list_the_scenes) {
    try {
        make_builtin_scene("teapot", size);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        for (const BuiltinScene& builtin : builtin_scenes())
            EXPECT_NE(std::string(error.what()).find(builtin.name), std::string::npos);
    }
    EXPECT_THROW(make_builtin_scene("plane", 0), Error);
    EXPECT_THROW(make_builtin_scene("plane", infinity), Error);
}

}  // namespace
}  // namespace hogel
