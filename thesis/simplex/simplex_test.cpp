// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "hogel/units.h"
#include "thesis/simplex/scan.h"
#include "thesis/simplex/slice.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

using namespace render;

namespace {

using namespace literals;

// Returns the determinant of the edges from the first corner, over the first N coordinates except `skip`: N! times the
// signed volume.
template <std::size_t N>
double determinant(const std::array<ProjectedPoint, N + 1>& corners, std::size_t skip = 5) {
    std::array<std::array<double, N>, N> m;
    for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = 0, from = 0; j < N; ++j, ++from) {
            if (from == skip) ++from;
            m[i][j] = corners[i + 1][from] - corners[0][from];
        }
    double product = 1;
    for (std::size_t i = 0; i < N; ++i) {
        std::size_t pivot = i;
        for (std::size_t k = i + 1; k < N; ++k)
            if (std::abs(m[k][i]) > std::abs(m[pivot][i])) pivot = k;
        if (m[pivot][i] == 0) return 0;
        if (pivot != i) {
            std::swap(m[pivot], m[i]);
            product = -product;
        }
        product *= m[i][i];
        for (std::size_t k = i + 1; k < N; ++k) {
            const double f = m[k][i] / m[i][i];
            for (std::size_t j = i; j < N; ++j) m[k][j] -= f * m[i][j];
        }
    }
    return product;
}

// N! times the volume.
template <std::size_t N>
double size(const std::array<ProjectedPoint, N + 1>& corners, std::size_t skip = 5) {
    return std::abs(determinant<N>(corners, skip));
}

// Returns whether a simplex contains a point, by Cramer's rule: replacing a corner by the point gives the corner's
// weight.
template <std::size_t N>
bool contains(const std::array<ProjectedPoint, N + 1>& corners, const ProjectedPoint& p, std::size_t skip = 5) {
    const double whole = determinant<N>(corners, skip);
    for (std::size_t i = 0; i <= N; ++i) {
        std::array<ProjectedPoint, N + 1> replaced = corners;
        replaced[i] = p;
        if (determinant<N>(replaced, skip) / whole <= 0) return false;
    }
    return true;
}

// Weights of a point of a simplex, uniformly distributed.
std::vector<double> random_weights(std::mt19937& random, std::size_t n) {
    std::exponential_distribution<double> draw;
    std::vector<double> weights(n);
    double sum = 0;
    for (double& w : weights) sum += w = draw(random);
    for (double& w : weights) w /= sum;
    return weights;
}

Simplex<4> random_simplex(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(0, 10);
    Simplex<4> simplex;
    for (ProjectedPoint& p : simplex) {
        for (double& x : p) x = coordinate(random);
        p[axis::q] = 1 + 0.1 * p[axis::u];
    }
    return simplex;
}

ProjectedPoint random_point(std::mt19937& random, const Simplex<4>& simplex) {
    const std::vector<double> weights = random_weights(random, 5);
    ProjectedPoint p{};
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 5; ++j) p[j] += weights[i] * simplex[i][j];
    return p;
}

TEST(ProductPaths, have_the_numbers_of_the_tables_in_the_thesis) {
    EXPECT_EQ(product_paths<5>(2).size(), 6u);  // a (2,2)-simploid
    EXPECT_EQ(product_paths<4>(2).size(), 3u);  // a (2,1)-simploid
    EXPECT_EQ(product_paths<3>(1).size(), 2u);  // a quadrilateral
    EXPECT_EQ(product_paths<5>(0).size(), 1u);  // a simplex
    EXPECT_EQ(product_paths<5>(1).size(), 4u);
}

// The product of two triangles of area 1/2 has the volume 1/4 = 6/4!: six simplices of determinant one.
TEST(ProductPaths, fill_the_product_of_two_triangles_without_overlap) {
    const std::array<std::array<double, 2>, 3> corner{{{0, 0}, {1, 0}, {0, 1}}};
    std::vector<Simplex<4>> simplices;
    for (const auto& path : product_paths<5>(2)) {
        Simplex<4>& simplex = simplices.emplace_back();
        for (std::size_t k = 0; k < 5; ++k)
            simplex[k] = {corner[path[k].first][0], corner[path[k].first][1], corner[path[k].second][0],
                          corner[path[k].second][1], 1};
    }
    double sum = 0;
    for (const Simplex<4>& simplex : simplices) sum += size<4>(simplex);
    EXPECT_NEAR(sum, 6, 1e-12);
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        const std::vector<double> a = random_weights(random, 3), b = random_weights(random, 3);
        int within = 0;
        for (const Simplex<4>& simplex : simplices) within += contains<4>(simplex, {a[1], a[2], b[1], b[2], 1}) ? 1 : 0;
        ASSERT_EQ(within, 1);
    }
}

// [K] 5.7.1: a triangle seen from a triangle, a quadrilateral, a pentagon of camera points.
TEST(ProjectedVolume, is_filled_by_6_12_or_18_simplices_without_overlap) {
    const LightFieldGrid grid{8, 6, 1_mm, 32, 24, Perspective{0.5, 0.4}, 1};
    const HogelRange range{2, 1, 4, 3};
    const DeepTriangle triangle{{{-2e-3, 1e-3, 5e-3}, {3e-3, 0, 9e-3}, {0, 4e-3, 6e-3}}};
    const std::vector<CameraPoint> pentagon{{0, 0}, {2, -0.3}, {3, 1}, {2.2, 2}, {0.1, 1.4}};
    std::mt19937 random(2);
    for (std::size_t corners : {3u, 4u, 5u}) {
        const std::vector<CameraPoint> region(pentagon.begin(), pentagon.begin() + std::ptrdiff_t(corners));
        std::vector<Simplex<4>> simplices;
        append_projected_volume(triangle, region, grid, range, simplices);
        ASSERT_EQ(simplices.size(), 6 * (corners - 2));
        for (int i = 0; i < 300; ++i) {
            // A camera point inside the region, and a point of the triangle.
            const std::vector<double> a = random_weights(random, corners), b = random_weights(random, 3);
            CameraPoint from;
            for (std::size_t k = 0; k < corners; ++k) {
                from.s += a[k] * region[k].s;
                from.t += a[k] * region[k].t;
            }
            DeepTriangle point{};
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t j = 0; j < 3; ++j) point[0][j] += b[k] * triangle[k][j];
            point[1] = point[2] = point[0];
            const ProjectedPoint seen = project(point, from, grid, range)[0];
            int within = 0;
            for (const Simplex<4>& simplex : simplices)
                if (contains<4>(simplex, seen)) {
                    ++within;
                    // Q at the point, interpolated between the corners, is 1/ζ: [K] 5.5.
                    const double whole = determinant<4>(simplex);
                    double q = 0;
                    for (std::size_t k = 0; k < 5; ++k) {
                        Simplex<4> replaced = simplex;
                        replaced[k] = seen;
                        q += determinant<4>(replaced) / whole * simplex[k][axis::q];
                    }
                    ASSERT_NEAR(q * point[0][2], 1, 1e-9);
                }
            ASSERT_EQ(within, 1) << corners;
        }
    }
}

double area(const std::vector<CameraPoint>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const CameraPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        twice += p.s * q.t - q.s * p.t;
    }
    return 0.5 * twice;
}

// [K] fig. 5.22: the part of the region that sees the front is nothing, a triangle, a quadrilateral, a pentagon or
// everything.
TEST(BackFace, divides_the_region_in_one_of_five_ways) {
    const LightFieldGrid grid{8, 8, 1_mm, 32, 32, Perspective{0.5, 0.5}, 1};
    const HogelRange range{2, 2, 4, 4};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> coordinate(-3e-3, 3e-3), deep(1e-3, 9e-3);
    std::set<std::size_t> cases;
    for (int i = 0; i < 500; ++i) {
        DeepTriangle triangle;
        for (auto& p : triangle) p = {coordinate(random), coordinate(random), deep(random)};
        const RegionSides sides = split_at_back_face(triangle, grid, range);
        EXPECT_NEAR(area(sides.front) + area(sides.back), 3.002 * 3.002, 1e-9);
        cases.insert(sides.front.size());
        // The triangle's orientation in the picture is the same from all points of one side, and opposite on the other.
        double orientations[2] = {0, 0};
        for (int side = 0; side < 2; ++side) {
            const std::vector<CameraPoint>& region = side == 0 ? sides.front : sides.back;
            if (region.size() < 3 || std::abs(area(region)) < 1e-6) continue;
            for (int k = 0; k < 5; ++k) {
                const std::vector<double> weights = random_weights(random, region.size());
                CameraPoint p;
                for (std::size_t j = 0; j < region.size(); ++j) {
                    p.s += weights[j] * region[j].s;
                    p.t += weights[j] * region[j].t;
                }
                const auto [a, b, c] = project(triangle, p, grid, range);
                const double orientation = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                if (orientations[side] != 0) {
                    ASSERT_GT(orientation * orientations[side], 0);
                }
                orientations[side] = orientation;
            }
        }
        EXPECT_LE(orientations[0] * orientations[1], 0);
    }
    EXPECT_EQ(cases, (std::set<std::size_t>{0, 3, 4, 5}));  // 4: a quadrilateral, or everything
}

// If both faces are visible the volume folds through itself; the parts of the two sides still fill it without overlap.
TEST(ProjectedVolume, is_filled_without_overlap_where_it_folds) {
    const LightFieldGrid grid{8, 8, 1_mm, 32, 32, Perspective{0.5, 0.5}, 1};
    const HogelRange range{2, 2, 4, 4};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-3e-3, 3e-3), deep(1e-3, 9e-3), column(0, 3);
    int folded = 0, folded_rows = 0;
    for (int round = 0; round < 300; ++round) {
        DeepTriangle triangle;
        for (auto& p : triangle) p = {coordinate(random), coordinate(random), deep(random)};
        std::vector<Simplex<4>> simplices;
        const RegionSides sides = split_at_back_face(triangle, grid, range);
        append_projected_volume(triangle, sides.front, grid, range, simplices);
        append_projected_volume(triangle, sides.back, grid, range, simplices);
        folded += sides.front.size() >= 3 && sides.back.size() >= 3 ? 1 : 0;
        std::vector<Simplex<3>> of_row;
        const std::vector<CameraLine> lines = split_row_at_back_face(triangle, 1, grid, range);
        for (const CameraLine& line : lines) append_projected_volume(triangle, line, grid, range, of_row);
        folded_rows += lines.size() == 2 ? 1 : 0;
        ASSERT_EQ(of_row.size(), 3 * lines.size());
        for (int i = 0; i < 20; ++i) {
            const std::vector<double> weights = random_weights(random, 3);
            DeepTriangle point{};
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t j = 0; j < 3; ++j) point[0][j] += weights[k] * triangle[k][j];
            point[1] = point[2] = point[0];
            const double s = column(random), t = column(random);
            const ProjectedPoint seen = project(point, {s, t}, grid, range)[0];
            const ProjectedPoint from_row = project(point, {s, 1}, grid, range)[0];
            int within = 0, within_row = 0;
            for (const Simplex<4>& simplex : simplices) within += contains<4>(simplex, seen) ? 1 : 0;
            for (const Simplex<3>& simplex : of_row) within_row += contains<3>(simplex, from_row) ? 1 : 0;
            ASSERT_EQ(within, 1) << round;
            ASSERT_EQ(within_row, 1) << round;
        }
    }
    EXPECT_GT(folded, 50);
    EXPECT_GT(folded_rows, 50);
}

TEST(NearPlane, keeps_what_lies_behind_it) {
    const DeepTriangle triangle{{{0, 0, 1}, {4, 0, 1}, {0, 4, 3}}};
    const auto height_along_depth = [](const DeepTriangle& t) {
        // Twice the area in the plane of x and ζ; the triangle above has 8.
        return std::abs((t[1][0] - t[0][0]) * (t[2][2] - t[0][2]) - (t[1][2] - t[0][2]) * (t[2][0] - t[0][0]));
    };
    const std::array expected{8.0, 2.0, 0.0};
    const std::array near{0.5, 2.0, 3.5};
    const std::array<std::size_t, 3> pieces{1, 1, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::vector<DeepTriangle> kept = clip_to_near_plane(triangle, near[i]);
        ASSERT_EQ(kept.size(), pieces[i]);
        double sum = 0;
        for (const DeepTriangle& t : kept) sum += height_along_depth(t);
        EXPECT_NEAR(sum, expected[i], 1e-12);
    }
    // Mirrored in depth a quadrilateral remains: 8 − 2.
    double sum = 0;
    const std::vector<DeepTriangle> kept = clip_to_near_plane({{{0, 0, 3}, {4, 0, 3}, {0, 4, 1}}}, 2);
    ASSERT_EQ(kept.size(), 2u);
    for (const DeepTriangle& t : kept) {
        sum += height_along_depth(t);
        for (const auto& corner : t) EXPECT_GE(corner[2], 2);
    }
    EXPECT_NEAR(sum, 6, 1e-12);
}

TEST(Clip, divides_a_simplex_without_gap_or_overlap) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> value(1, 9);
    std::set<std::size_t> pieces;
    for (int i = 0; i < 200; ++i) {
        const Simplex<4> whole = random_simplex(random);
        const std::size_t along = i % 2 == 0 ? axis::u : axis::v;
        const double bound = value(random);
        std::vector<Simplex<4>> above{whole}, below{whole};
        clip(above, along, bound, true);
        clip(below, along, bound, false);
        pieces.insert(above.size());
        double sum = 0;
        for (const auto* part : {&above, &below})
            for (const Simplex<4>& simplex : *part) sum += size<4>(simplex);
        EXPECT_NEAR(sum, size<4>(whole), 1e-9 * (1 + sum));
        for (int k = 0; k < 20; ++k) {
            const ProjectedPoint p = random_point(random, whole);
            int in_above = 0, in_below = 0;
            for (const Simplex<4>& simplex : above) in_above += contains<4>(simplex, p) ? 1 : 0;
            for (const Simplex<4>& simplex : below) in_below += contains<4>(simplex, p) ? 1 : 0;
            ASSERT_EQ(in_above, p[along] > bound ? 1 : 0);
            ASSERT_EQ(in_below, p[along] < bound ? 1 : 0);
        }
    }
    EXPECT_EQ(pieces, (std::set<std::size_t>{0, 1, 4, 6}));
}

// A point of the plane is in one tetrahedron of the slice exactly if it is in the simplex; likewise for triangles of a
// slice of the slice.
TEST(Slice, is_the_intersection_of_simplex_and_plane) {
    std::mt19937 random(5);
    std::set<std::size_t> tetrahedra, triangles;
    std::uniform_real_distribution<double> coordinate(0, 10);
    int inside_both = 0;
    for (int i = 0; i < 2000; ++i) {
        Simplex<4> simplex = random_simplex(random);
        const ProjectedPoint p = i % 2 == 0 ? random_point(random, simplex)
                                            : ProjectedPoint{coordinate(random), coordinate(random), coordinate(random),
                                                             coordinate(random), 0};
        const int inside = contains<4>(simplex, p) ? 1 : 0;
        int in_tetrahedra = 0, in_triangles = 0;
        std::size_t tetrahedra_here = 0;
        sort_along(axis::v, simplex);
        slice(simplex, axis::v, p[axis::v], [&](Simplex<3> at_v) {
            ++tetrahedra_here;
            in_tetrahedra += contains<3>(at_v, p, axis::v) ? 1 : 0;
            std::size_t triangles_here = 0;
            sort_along(axis::u, at_v);
            slice(at_v, axis::u, p[axis::u], [&](const Simplex<2>& at_uv) {
                ++triangles_here;
                // Only S and T.
                std::array<ProjectedPoint, 3> flat;
                for (std::size_t k = 0; k < 3; ++k) flat[k] = {at_uv[k][axis::s], at_uv[k][axis::t], 0, 0, 0};
                in_triangles += contains<2>(flat, {p[axis::s], p[axis::t], 0, 0, 0}) ? 1 : 0;
            });
            triangles.insert(triangles_here);
        });
        tetrahedra.insert(tetrahedra_here);
        ASSERT_EQ(in_tetrahedra, inside) << i;
        ASSERT_EQ(in_triangles, inside) << i;
        inside_both += inside;
    }
    EXPECT_GE(inside_both, 1000);
    EXPECT_EQ(tetrahedra, (std::set<std::size_t>{0, 1, 3}));
    EXPECT_EQ(triangles, (std::set<std::size_t>{0, 1, 2}));
}

// A simplex is sliced at whole values, including those of corners.
TEST(Slice, two_simplices_that_share_a_corner_on_a_plane_are_sliced_there_once) {
    const auto at = [](double v) { return ProjectedPoint{0, v, 0, 0, 1}; };
    std::vector<double> values;
    const auto collect = [&](double value, const auto&) { values.push_back(value); };
    std::vector<std::uint8_t> seen(9, 1);
    slice_at_samples(std::array{at(0.5), at(2)}, axis::v, seen, collect);
    slice_at_samples(std::array{at(2), at(4)}, axis::v, seen, collect);
    EXPECT_EQ(values, (std::vector<double>{1, 2, 3, 4}));
    seen[3] = 0;
    slice_at_samples(std::array{at(2), at(4)}, axis::v, seen, collect);
    EXPECT_EQ(values, (std::vector<double>{1, 2, 3, 4, 4}));
}

// A triangle just behind the hologram moves by thousands of directions from hogel to hogel. The number of samples
// bounds the work for its simplices: three tetrahedra at each V, two triangles at each U.
TEST(Slice, work_is_bounded_by_the_field_of_view) {
    std::mt19937 random(6);
    constexpr std::size_t samples = 4;
    const std::vector<std::uint8_t> seen(samples, 1);
    std::size_t slices = 0;
    for (int i = 0; i < 200; ++i) {
        Simplex<4> simplex = random_simplex(random);
        for (ProjectedPoint& corner : simplex)
            for (const std::size_t along : {axis::u, axis::v}) corner[along] = (corner[along] - 5) * 1e4;
        std::size_t at_v = 0, at_uv = 0;
        slice_at_samples(simplex, axis::v, seen, [&](double v, const Simplex<3>& tetrahedron) {
            ASSERT_TRUE(v >= 0 && v < samples);
            ++at_v;
            slice_at_samples(tetrahedron, axis::u, seen, [&](double u, const Simplex<2>&) {
                ASSERT_TRUE(u >= 0 && u < samples);
                ++at_uv;
            });
        });
        EXPECT_LE(at_v, 3 * samples);
        EXPECT_LE(at_uv, 2 * samples * at_v);
        slices += at_uv;
    }
    EXPECT_GE(slices, 1000);
}

// (s, t) = (S, T)/Q: the spans of rows, from the crossings of [K] 5.7.4, hold all samples of a slice and no others.
TEST(Scan, finds_the_samples_between_the_edges_of_a_slice) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> coordinate(-2, 12), q(0.5, 3);
    std::size_t samples = 0;
    for (int round = 0; round < 500; ++round) {
        Simplex<2> slice{};
        std::array<std::array<double, 2>, 3> corner;
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = {coordinate(random), coordinate(random)};
            const double w = q(random);
            slice[i] = {0, 0, corner[i][0] * w, corner[i][1] * w, w};
        }
        const SliceInHogels in_hogels(slice);
        const Span rows = in_hogels.rows(10);
        for (std::size_t t = 0; t < 10; ++t) {
            const Span columns = t >= rows.first && t < rows.end ? in_hogels.columns(t, 11) : Span{};
            for (std::size_t s = 0; s < 11; ++s) {
                bool left = true, right = true;
                for (std::size_t i = 0; i < 3; ++i) {
                    const auto &a = corner[i], &b = corner[(i + 1) % 3];
                    const double side = (b[0] - a[0]) * (double(t) - a[1]) - (b[1] - a[1]) * (double(s) - a[0]);
                    left = left && side > 0;
                    right = right && side < 0;
                }
                ASSERT_EQ(left || right, s >= columns.first && s < columns.end) << round;
                samples += left || right ? 1 : 0;
            }
        }
    }
    EXPECT_GT(samples, 3000u);
}

}  // namespace
}  // namespace hogel::simplex
