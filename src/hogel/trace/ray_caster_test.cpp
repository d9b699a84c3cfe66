// SPDX-License-Identifier: Apache-2.0
#include "hogel/trace/ray_caster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stop_token>

#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"
#include "hogel/error.h"

namespace hogel::trace {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Soup {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

class Numbers {
  public:
    explicit Numbers(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
    }
    Vec3 point(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }

  private:
    std::mt19937 engine_;
};

Soup random_soup(std::size_t n, Vec3 center, double size) {
    Numbers number(7);
    Soup soup;
    for (std::uint32_t i = 0; i < n; ++i) {
        const Vec3 middle = center + number.point(size);
        for (int k = 0; k < 3; ++k) soup.positions.push_back(middle + number.point(0.3 * size));
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return soup;
}

struct Exact {
    double distance = infinity;
    std::uint32_t triangle = RayHit::miss;
    double b1 = 0, b2 = 0;
    double margin = infinity;  ///< smallest distance from an edge (in weights) or from the next hit (relative)
};

// Solves a + b1 (b − a) + b2 (c − a) = o + distance d for every triangle by Cramer's rule.
Exact brute_force(const Soup& soup, Vec3 o, Vec3 d, Sides sides = Sides::both) {
    Exact best;
    double margin = infinity;
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
        const auto& t = soup.triangles[i];
        const Vec3 a = soup.positions[t[0]], e1 = soup.positions[t[1]] - a, e2 = soup.positions[t[2]] - a;
        const Vec3 r = o - a;
        const double det = dot(cross(e1, e2), -d);
        if (sides == Sides::fronts && det < 0) continue;
        const double b1 = dot(cross(r, e2), -d) / det, b2 = dot(cross(e1, r), -d) / det;
        const double distance = dot(cross(e1, e2), r) / det;
        const double inside = std::min({b1, b2, 1 - b1 - b2});
        margin = std::min(margin, std::abs(inside));
        if (inside < 0 || distance < 0) continue;
        margin = std::min(margin, std::abs(distance - best.distance) / distance);
        if (distance < best.distance) best = {distance, i, b1, b2, 0};
    }
    best.margin = margin;
    return best;
}

void compare_with_brute_force(const Soup& soup, Vec3 center, double size) {
    const RayCaster caster(soup.positions, soup.triangles);
    Numbers number(11);
    std::vector<Vec3> origins, directions;
    for (int i = 0; i < 3001; ++i) {
        origins.push_back(center + number.point(i % 3 == 0 ? size : 30 * size));
        directions.push_back(number(0.1, 10) * (center + number.point(size) - origins.back()));
    }
    std::vector<RayHit> hits(origins.size());
    caster.closest(origins, directions, infinity, hits);
    int hit = 0, compared = 0;
    for (std::size_t i = 0; i < origins.size(); ++i) {
        const Exact exact = brute_force(soup, origins[i], directions[i]);
        if (exact.margin < 1e-5) continue;  // single precision cannot decide so close to an edge
        ++compared;
        for (const RayHit& found : {hits[i], caster.closest(origins[i], directions[i], infinity)}) {
            ASSERT_EQ(found.triangle, exact.triangle);
            if (exact.triangle == RayHit::miss) continue;
            ++hit;
            EXPECT_NEAR(found.distance, exact.distance, 1e-12 * exact.distance * (1 + 1e-2 / exact.margin));
            EXPECT_NEAR(found.b1, exact.b1, 1e-6);
            EXPECT_NEAR(found.b2, exact.b2, 1e-6);
        }
        EXPECT_EQ(caster.occluded(origins[i], directions[i], 0, infinity), exact.triangle != RayHit::miss);
    }
    EXPECT_GT(compared, 2500);
    EXPECT_GT(hit, 1000);
}

TEST(RayCaster, finds_what_brute_force_finds) { compare_with_brute_force(random_soup(200, {}, 1), {}, 1); }

TEST(RayCaster, ends_inside_the_building_of_its_hierarchy_when_a_stop_is_requested) {
    const Soup soup = random_soup(20000, {}, 1);
    std::stop_source stop;
    const core::StopScope scope{Progress(stop.get_token())};
    EXPECT_FALSE(core::is_cancelled([&] { const RayCaster caster(soup.positions, soup.triangles); }));
    stop.request_stop();
    EXPECT_TRUE(core::is_cancelled([&] { const RayCaster caster(soup.positions, soup.triangles); }));
}

TEST(RayCaster, passes_through_backs_where_only_fronts_are_hit) {
    const Soup soup = random_soup(200, {}, 1);
    const RayCaster caster(soup.positions, soup.triangles, Sides::fronts), both(soup.positions, soup.triangles);
    Numbers number(12);
    std::vector<Vec3> origins, directions;
    for (int i = 0; i < 1001; ++i) {
        origins.push_back(number.point(5));
        directions.push_back(number.point(1) - origins.back());
    }
    std::vector<RayHit> hits(origins.size());
    caster.closest(origins, directions, infinity, hits);
    int hit = 0, passed = 0;
    for (std::size_t i = 0; i < origins.size(); ++i) {
        const Exact exact = brute_force(soup, origins[i], directions[i], Sides::fronts);
        if (exact.margin < 1e-5) continue;
        ASSERT_EQ(hits[i].triangle, exact.triangle);
        ASSERT_EQ(caster.closest(origins[i], directions[i], infinity).triangle, exact.triangle);
        const RayHit first = both.closest(origins[i], directions[i], infinity);
        EXPECT_EQ(caster.occluded(origins[i], directions[i], 0, infinity), first.triangle != RayHit::miss);
        hit += exact.triangle != RayHit::miss ? 1 : 0;
        passed += first.triangle != exact.triangle ? 1 : 0;
    }
    EXPECT_GT(hit, 200);
    EXPECT_GT(passed, 200);
}

TEST(RayCaster, keeps_its_accuracy_for_centimetre_scenes_far_from_the_origin) {
    const Vec3 center{0.3, -0.2, 5};
    compare_with_brute_force(random_soup(200, center, 5e-3), center, 5e-3);
}

TEST(RayCaster, gives_the_same_answers_for_many_rays_from_one_origin_and_for_each) {
    const Soup soup = random_soup(200, {}, 1);
    const RayCaster caster(soup.positions, soup.triangles);
    Numbers numbers(5);
    std::vector<Vec3> directions(101);
    for (Vec3& direction : directions) direction = normalize(Vec3{numbers(-1, 1), numbers(-1, 1), numbers(-1, 1)});
    const auto hidden = std::make_unique<bool[]>(directions.size());
    std::size_t hits = 0;
    for (const Vec3 origin : {Vec3{0, 0, 0}, Vec3{0.5, 2, 3}}) {
        caster.occluded(origin, directions, 0.1, 2, {hidden.get(), directions.size()});
        for (std::size_t i = 0; i < directions.size(); ++i) {
            EXPECT_EQ(hidden[i], caster.occluded(origin, directions[i], 0.1, 2)) << i;
            hits += hidden[i];
        }
    }
    EXPECT_GT(hits, 20u);
    EXPECT_LT(hits, 2 * directions.size() - 20);
}

TEST(RayCaster, hits_both_sides_within_the_range) {
    const std::vector<Vec3> positions{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}};
    const std::vector<Triangle> triangles{{0, 1, 2}};
    const RayCaster caster(positions, triangles);
    EXPECT_DOUBLE_EQ(caster.closest({0, 0, 5}, {0, 0, -2}, 10).distance, 1.5);
    EXPECT_DOUBLE_EQ(caster.closest({0, 0, 0}, {0, 0, 2}, 10).distance, 1);
    EXPECT_EQ(caster.closest({0, 0, 5}, {0, 0, -2}, 1.4).triangle, RayHit::miss);
    EXPECT_EQ(caster.closest({0, 0, 1.9}, {0, 0, -1}, infinity).triangle, RayHit::miss);
    EXPECT_TRUE(caster.occluded({0, 0, 5}, {0, 0, -1}, 2.9, 3.1));
    EXPECT_FALSE(caster.occluded({0, 0, 5}, {0, 0, -1}, 3.1, infinity));
    EXPECT_FALSE(caster.occluded({0, 0, 5}, {0, 0, -1}, 0, 2.9));
}

TEST(RayCaster, hits_one_of_coincident_triangles_at_the_right_distance) {
    const std::vector<Vec3> positions{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {2, 1, 0}, {1, 2, 0}};
    const RayCaster caster(positions, triangles);
    const RayHit hit = caster.closest({0.1, 0.1, 3}, {0, 0, -1}, infinity);
    EXPECT_LT(hit.triangle, triangles.size());
    EXPECT_DOUBLE_EQ(hit.distance, 3);
}

// A ray through a shared edge or vertex may hit either triangle but never neither.
TEST(RayCaster, a_closed_fan_has_no_gaps) {
    std::vector<Vec3> positions{{0.01, 0.02, 0}};
    std::vector<Triangle> triangles;
    constexpr std::uint32_t n = 37;
    for (std::uint32_t i = 0; i < n; ++i) {
        positions.push_back({std::cos(6.28318530718 * i / n), std::sin(6.28318530718 * i / n), 0.1 * (i % 3)});
        triangles.push_back({0, i + 1, (i + 1) % n + 1});
    }
    const RayCaster caster(positions, triangles);
    const Vec3 eye{0.3, -0.2, 7};
    for (std::uint32_t i = 1; i <= n; ++i)
        for (int k = 0; k < 200; ++k) {
            const Vec3 target = positions[0] + k / 200.0 * (positions[i] - positions[0]);
            const RayHit hit = caster.closest(eye, target - eye, infinity);
            ASSERT_NE(hit.triangle, RayHit::miss);
            EXPECT_NEAR(hit.distance, 1, 1e-6);
            EXPECT_TRUE(hit.b1 >= 0 && hit.b2 >= 0 && hit.b1 + hit.b2 <= 1.000001f);
        }
}

TEST(RayCaster, without_triangles_hits_nothing) {
    const RayCaster caster({}, {});
    EXPECT_EQ(caster.closest({0, 0, 0}, {0, 0, 1}, infinity).triangle, RayHit::miss);
    EXPECT_FALSE(caster.occluded({0, 0, 0}, {0, 0, 1}, 0, infinity));
    const std::vector<Vec3> rays(20, Vec3{0, 0, 1});
    std::vector<RayHit> hits(20, RayHit{1, 1, 0, 0});
    caster.closest(rays, rays, infinity, hits);
    for (const RayHit& hit : hits) EXPECT_EQ(hit.triangle, RayHit::miss);
}

TEST(RayCaster, takes_other_triangles_in_place) {
    const Soup first = random_soup(200, {}, 1), second = random_soup(60, {1, 2, 3}, 5);
    RayCaster caster(first.positions, first.triangles);
    const auto expect_as_new = [&](const Soup& soup, Sides sides) {
        const RayCaster fresh(soup.positions, soup.triangles, sides);
        Numbers number(3);
        for (int i = 0; i < 500; ++i) {
            const Vec3 origin = number.point(12), direction = number.point(1) - origin;
            const RayHit a = caster.closest(origin, direction, infinity),
                         b = fresh.closest(origin, direction, infinity);
            ASSERT_EQ(a.triangle, b.triangle);
            ASSERT_EQ(a.distance, b.distance);
            ASSERT_EQ(a.b1, b.b1);
        }
    };
    TriangleMesh mesh = caster.release();
    EXPECT_EQ(mesh.triangles, first.triangles);
    EXPECT_EQ(caster.closest({0, 0, 9}, {0, 0, -1}, infinity).triangle, RayHit::miss);
    mesh.positions = second.positions;
    mesh.triangles = second.triangles;
    caster.set(mesh, Sides::fronts);
    expect_as_new(second, Sides::fronts);
    EXPECT_THROW(caster.set({second.positions, {{0, 1, 999}}}), Error);
    EXPECT_FALSE(caster.occluded({0, 0, 9}, {0, 0, -1}, 0, infinity));
    caster.set({});
    EXPECT_FALSE(caster.occluded({0, 0, 9}, {0, 0, -1}, 0, infinity));
    caster.set({first.positions, first.triangles});
    expect_as_new(first, Sides::both);
}

TEST(RayCaster, refuses_an_index_without_a_vertex) {
    const std::vector<Vec3> positions(3);
    const std::vector<Triangle> triangles{{0, 1, 3}};
    EXPECT_THROW(RayCaster(positions, triangles), Error);
}

}  // namespace
}  // namespace hogel::trace
