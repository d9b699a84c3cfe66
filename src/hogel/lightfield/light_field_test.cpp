// SPDX-License-Identifier: Apache-2.0
#include "hogel/light_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::lightfield {
namespace {

using namespace literals;

LightFieldGrid small_grid() {
    LightFieldGrid grid;
    grid.hogels_s = 7;
    grid.hogels_t = 5;
    grid.pitch = 0.5_mm;
    grid.directions_u = 4;
    grid.directions_v = 3;
    grid.range().half_u = 0.4;
    grid.range().half_v = 0.3;
    return grid;
}

// A value that identifies the sample.
float value_at(const LightFieldGrid& g, std::size_t c, std::size_t t, std::size_t s, std::size_t v, std::size_t u) {
    return static_cast<float>((((c * g.hogels_t + t) * g.hogels_s + s) * g.directions_v + v) * g.directions_u + u) + 1;
}

LightFieldBuffer numbered(const LightFieldGrid& g, bool with_depth) {
    LightFieldBuffer field(g, with_depth);
    for (std::size_t c = 0; c < g.channels; ++c)
        for (std::size_t t = 0; t < g.hogels_t; ++t)
            for (std::size_t s = 0; s < g.hogels_s; ++s)
                for (std::size_t v = 0; v < g.directions_v; ++v)
                    for (std::size_t u = 0; u < g.directions_u; ++u) {
                        field.radiance(c, t, s, v, u) = value_at(g, c, t, s, v, u);
                        if (with_depth) field.depth(t, s, v, u) = -value_at(g, 0, t, s, v, u);
                    }
    return field;
}

TEST(LightFieldGrid, coordinates_are_those_of_the_notation) {
    LightFieldGrid g = small_grid();
    g.hogels_s = 4;
    // s_i = (i + 1/2 - S/2) d: -1.5 d, -0.5 d, 0.5 d, 1.5 d; t runs from the top down.
    EXPECT_DOUBLE_EQ(g.s(0), -0.75_mm);
    EXPECT_DOUBLE_EQ(g.s(3), 0.75_mm);
    EXPECT_DOUBLE_EQ(g.t(0), 1_mm);
    EXPECT_DOUBLE_EQ(g.t(2), 0);
    EXPECT_DOUBLE_EQ(g.t(4), -1_mm);
    // Delta U = 2 tan / n_U = 0.2: centres at -0.3, -0.1, 0.1, 0.3; V from the top down: 0.2, 0, -0.2.
    EXPECT_DOUBLE_EQ(g.step_u(), 0.2);
    EXPECT_DOUBLE_EQ(g.u(0), -0.3);
    EXPECT_DOUBLE_EQ(g.u(3), 0.3);
    EXPECT_DOUBLE_EQ(g.v(0), 0.2);
    EXPECT_NEAR(g.v(1), 0, 1e-17);
    EXPECT_DOUBLE_EQ(g.v(2), -0.2);
}

TEST(LightFieldBuffer, every_range_reads_the_slice) {
    const LightFieldGrid g = small_grid();
    const LightFieldBuffer field = numbered(g, true);
    for (std::size_t t0 = 0; t0 < g.hogels_t; ++t0)
        for (std::size_t s0 = 0; s0 < g.hogels_s; ++s0)
            for (std::size_t nt = 1; nt <= g.hogels_t - t0; ++nt)
                for (std::size_t ns = 1; ns <= g.hogels_s - s0; ++ns) {
                    LightFieldTile tile(g, {s0, t0, ns, nt}, true);
                    field.read(tile);
                    for (std::size_t c = 0; c < g.channels; ++c)
                        for (std::size_t t = 0; t < nt; ++t)
                            for (std::size_t s = 0; s < ns; ++s)
                                for (std::size_t v = 0; v < g.directions_v; ++v)
                                    for (std::size_t u = 0; u < g.directions_u; ++u) {
                                        ASSERT_EQ(tile.radiance(c, t, s, v, u), value_at(g, c, t0 + t, s0 + s, v, u));
                                        ASSERT_EQ(tile.depth(t, s, v, u), -value_at(g, 0, t0 + t, s0 + s, v, u));
                                    }
                }
}

TEST(LightFieldBuffer, writing_through_any_tiling_gives_the_same_light_field) {
    const LightFieldGrid g = small_grid();
    const LightFieldBuffer from = numbered(g, true);
    for (std::size_t nt = 1; nt <= g.hogels_t; ++nt)
        for (std::size_t ns = 1; ns <= g.hogels_s; ++ns) {
            LightFieldBuffer to(g, true);
            for (std::size_t t0 = 0; t0 < g.hogels_t; t0 += nt)
                for (std::size_t s0 = 0; s0 < g.hogels_s; s0 += ns) {
                    LightFieldTile tile(g, {s0, t0, std::min(ns, g.hogels_s - s0), std::min(nt, g.hogels_t - t0)},
                                        true);
                    from.read(tile);
                    to.write(tile);
                }
            ASSERT_TRUE(std::ranges::equal(to.radiance.elements(), from.radiance.elements()));
            ASSERT_TRUE(std::ranges::equal(to.depth.elements(), from.depth.elements()));
        }
}

TEST(LightFieldBuffer, copy_carries_everything_over_many_tiles) {
    LightFieldGrid g = small_grid();
    g.hogels_s = 19;
    g.hogels_t = 11;
    g.directions_u = g.directions_v = 96;
    ASSERT_LT(default_tile(g).hogels(), g.hogels()) << "should need several tiles";
    const LightFieldBuffer from = numbered(g, true);
    LightFieldBuffer to(g, true);
    double last = -1;
    copy(from, to, [&](double fraction) {
        EXPECT_GT(fraction, last);
        last = fraction;
        return true;
    });
    EXPECT_EQ(last, 1);
    EXPECT_TRUE(std::ranges::equal(to.radiance.elements(), from.radiance.elements()));
    EXPECT_TRUE(std::ranges::equal(to.depth.elements(), from.depth.elements()));
}

TEST(LightFieldBuffer, copy_asks_for_the_tiles_that_the_source_prefers) {
    struct Rows final : LightFieldSource {
        LightFieldBuffer whole = numbered(small_grid(), false);
        const LightFieldGrid& grid() const override { return whole.grid(); }
        HogelRange preferred_tile() const override { return {0, 0, 3, 2}; }
        void read(LightFieldTile& tile) const override {
            EXPECT_EQ(tile.range.s0 % 3, 0u);
            EXPECT_EQ(tile.range.t0 % 2, 0u);
            EXPECT_EQ(tile.range.ns, std::min<std::size_t>(3, grid().hogels_s - tile.range.s0));
            EXPECT_EQ(tile.range.nt, std::min<std::size_t>(2, grid().hogels_t - tile.range.t0));
            whole.read(tile);
        }
    } from;
    ASSERT_GT(from.grid().hogels_s, 3u);
    LightFieldBuffer to(from.grid());
    copy(from, to);
    EXPECT_TRUE(std::ranges::equal(to.radiance.elements(), from.whole.radiance.elements()));
}

TEST(LightFieldBuffer, copy_stops_when_asked_to) {
    const LightFieldBuffer from = numbered(small_grid(), false);
    LightFieldBuffer to(small_grid());
    try {
        copy(from, to, [](double) { return false; });
        FAIL() << "was not stopped";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

TEST(LightFieldBuffer, depth_is_left_alone_where_a_tile_has_no_room_for_it) {
    const LightFieldBuffer field = numbered(small_grid(), true);
    LightFieldTile tile(small_grid(), {1, 1, 2, 2}, false);
    field.read(tile);
    EXPECT_EQ(tile.depth.size(), 0u);
    LightFieldBuffer to(small_grid(), true);
    EXPECT_THROW(to.write(tile), Error);
}

TEST(LightFieldBuffer, rejects_ranges_outside_and_arrays_of_another_shape) {
    LightFieldBuffer field(small_grid());
    constexpr std::size_t huge = std::numeric_limits<std::size_t>::max();
    for (const HogelRange range :
         {HogelRange{0, 0, 0, 1}, HogelRange{0, 0, 1, 0}, HogelRange{7, 0, 1, 1}, HogelRange{6, 0, 2, 1},
          HogelRange{0, 5, 1, 1}, HogelRange{0, 4, 1, 2}, HogelRange{huge, 0, 2, 1}, HogelRange{1, 0, huge, 1}}) {
        LightFieldTile tile;
        tile.range = range;
        EXPECT_THROW(field.read(tile), Error);
        EXPECT_THROW(field.write(tile), Error);
    }
    LightFieldTile tile(small_grid(), {0, 0, 2, 1}, false);
    tile.range = {0, 0, 1, 2};
    EXPECT_THROW(field.read(tile), Error);
}

// A request for 20 m meant millimetres and is rejected. Files may have any size.
TEST(LightFieldGrid, validate_refuses_to_make_large_holograms) {
    const auto message = [](double width, ErrorCode code) -> std::string {
        LightFieldGrid g = small_grid();
        g.pitch = width / static_cast<double>(g.hogels_s);
        try {
            validate(g, code, "light field");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code);
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message(7.1, ErrorCode::usage), "");
    EXPECT_NE(message(20, ErrorCode::usage).find("20*mm"), std::string::npos);
    EXPECT_EQ(message(20, ErrorCode::bad_input), "");
}

TEST(LightFieldGrid, validate_names_what_is_wrong) {
    const auto message = [](auto change) -> std::string {
        LightFieldGrid g = small_grid();
        change(g);
        try {
            validate(g, ErrorCode::bad_input, "x.h5");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            return error.what();
        }
        return "";
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    using G = LightFieldGrid;
    EXPECT_EQ(message([](G&) {}), "");
    EXPECT_NE(message([](G& g) { g.hogels_s = 0; }).find("x.h5: 0x5 hogels"), std::string::npos);
    EXPECT_NE(message([](G& g) { g.directions_v = 0; }).find("4x0 directions"), std::string::npos);
    EXPECT_NE(message([](G& g) { g.channels = 2; }).find("2 channels"), std::string::npos);
    for (double bad : {nan, infinite, -infinite, 0.0, -1.0}) {
        EXPECT_NE(message([=](G& g) { g.pitch = bad; }).find("pitch"), std::string::npos);
        EXPECT_NE(message([=](G& g) { g.range().half_u = bad; }).find("tan_half_u"), std::string::npos);
        EXPECT_NE(message([=](G& g) { g.range().half_v = bad; }).find("tan_half_v"), std::string::npos);
    }
    EXPECT_NE(message([](G& g) { g.pitch = 1e308; }).find("width"), std::string::npos);
    const std::size_t big = std::size_t{1} << 31;
    EXPECT_NE(message([=](G& g) { g.hogels_s = g.hogels_t = big; }).find("addressed"), std::string::npos);
    // 2^64 hogels: the product is zero in 64 bits.
    EXPECT_NE(message([=](G& g) { g.hogels_s = g.hogels_t = 2 * big; }).find("addressed"), std::string::npos);
}

TEST(LightFieldGrid, default_tiles_fit_in_their_budget) {
    for (std::size_t s : {1, 3, 64, 256, 100000})
        for (std::size_t t : {1, 5, 256})
            for (std::size_t n : {1, 2, 127, 256, 5000}) {
                LightFieldGrid g = small_grid();
                g.hogels_s = s;
                g.hogels_t = t;
                g.directions_u = g.directions_v = n;
                const HogelRange tile = default_tile(g);
                ASSERT_GE(tile.hogels(), 1u);
                ASSERT_LE(tile.ns, s);
                ASSERT_LE(tile.nt, t);
                const std::size_t bytes = tile.hogels() * g.directions() * g.channels * sizeof(float);
                const bool fits = bytes <= std::size_t{16} << 20;
                EXPECT_TRUE(fits || tile.hogels() == 1);
                const bool all = tile.hogels() == g.hogels();
                const bool full = 4 * bytes > std::size_t{16} << 20;
                EXPECT_TRUE(all || full) << s << "x" << t << " hogels, " << n << " directions";
            }
}

TEST(LightFieldGrid, off_centre_directions_are_around_their_middle_and_column_and_row_lead_back) {
    LightFieldGrid g = small_grid();
    g.range().center_u = 0.5;
    g.range().center_v = -0.25;
    EXPECT_DOUBLE_EQ(g.u(0), 0.5 - 0.3);
    EXPECT_DOUBLE_EQ(g.u(3), 0.5 + 0.3);
    EXPECT_DOUBLE_EQ(g.v(0), -0.25 + 0.2);
    for (double k : {-0.5, 0.0, 1.0, 2.7}) {
        EXPECT_NEAR(g.column(g.u(k)), k, 1e-12);
        EXPECT_NEAR(g.row(g.v(k)), k, 1e-12);
    }
}

// The rays of all hogels go through the same points of the plane.
TEST(FocalPlane, rays_of_all_hogels_meet_at_its_points) {
    for (const double depth : {-0.4, -3e-3, 5e-3, 70.0}) {
        LightFieldGrid g = small_grid();
        g.view = FocalPlane{{0.4, 0.3, 0.05, -0.02}, depth};
        validate(g, ErrorCode::usage, "light field");
        for (std::size_t j = 0; j < g.hogels_t; ++j)
            for (std::size_t i = 0; i < g.hogels_s; ++i) {
                const LightFieldGrid hogel = g.of_hogel(double(i), double(j));
                EXPECT_TRUE(hogel.is_perspective());
                EXPECT_EQ(hogel.step_u(), g.step_u());
                for (std::size_t k = 0; k < g.directions_u; ++k) {
                    const Vec3 ray = hogel.direction_of(hogel.u(double(k)), hogel.v(2));
                    EXPECT_NEAR(g.s(double(i)) + ray.x * depth, g.u(double(k)) * depth,
                                1e-15 * std::abs(depth) + 1e-17);
                    EXPECT_NEAR(g.t(double(j)) + ray.y * depth, g.v(2) * depth, 1e-15 * std::abs(depth) + 1e-17);
                    EXPECT_NEAR(hogel.column(ray.x), double(k), 1e-9);
                    EXPECT_NEAR(hogel.row(ray.y), 2, 1e-9);
                    EXPECT_TRUE(hogel.covers(ray));
                }
            }
    }
}

// Cameras in front of the hologram: a viewpoint at the left end sees the rightmost sample.
TEST(FocalPlane, in_front_of_the_hologram_is_a_plane_of_cameras) {
    LightFieldGrid g = small_grid();
    const double distance = 0.5, camera_x = -60_mm;
    g.view = FocalPlane{{0.2, 0.2}, -distance};
    const double u = -camera_x / distance;
    for (const double i : {0.0, 3.0, 6.0}) {
        const LightFieldGrid hogel = g.of_hogel(i, 2);
        const double U = hogel.u(g.column(u));
        EXPECT_NEAR(U, (g.s(i) - camera_x) / distance, 1e-15);
        EXPECT_NEAR(g.s(i) + U * -distance, camera_x, 1e-16);
    }
}

TEST(FocalPlane, far_away_is_a_perspective_and_without_one_hogels_have_the_grid_itself) {
    LightFieldGrid g = small_grid(), far = g, sines = g;
    far.view = FocalPlane{g.range(), 1e30};
    EXPECT_EQ(far.of_hogel(3, 2), g);
    EXPECT_NEAR(far.of_hogel(0, 0).center_u(), 0, 1e-30);
    sines.view = Frequencies{g.range()};
    for (const LightFieldGrid& grid : {g, sines, hemicube({4, 4, 1e-3, 4, 4, {}, 1})[3]})
        EXPECT_EQ(grid.of_hogel(2, 1), grid);
}

TEST(FocalPlane, is_refused_where_it_has_no_meaning) {
    LightFieldGrid g = small_grid();
    for (const double bad : {0.0, 1e-320, std::nan(""), std::numeric_limits<double>::infinity()}) {
        g.view = FocalPlane{g.range(), bad};
        EXPECT_THROW(validate(g, ErrorCode::usage, "light field"), Error) << bad;
    }
    g.view = FocalPlane{g.range(), -0.5};
    EXPECT_THROW(require_perspective(g, ErrorCode::usage, "this"), Error);
    EXPECT_THROW(require_common_directions(g, ErrorCode::usage, "this"), Error);
    require_common_directions(small_grid(), ErrorCode::usage, "this");
    LightFieldGrid side = small_grid();
    side.view = Perspective{{0.5, 1, 0.5, 0}, Face::left};
    EXPECT_THROW(require_faces(std::vector{g, side}), Error);
    require_faces(std::vector{g});
}

TEST(Face, rotates_there_and_back_and_looks_where_its_name_says) {
    const Vec3 p{0.3, -0.7, 1.1};
    for (const Face face : all_faces) EXPECT_EQ(from_face(face, to_face(face, p)), p);
    EXPECT_EQ(from_face(Face::front, {0, 0, 1}), (Vec3{0, 0, 1}));
    EXPECT_EQ(from_face(Face::left, {0, 0, 1}), (Vec3{-1, 0, 0}));
    EXPECT_EQ(from_face(Face::right, {0, 0, 1}), (Vec3{1, 0, 0}));
    EXPECT_EQ(from_face(Face::top, {0, 0, 1}), (Vec3{0, 1, 0}));
    EXPECT_EQ(from_face(Face::bottom, {0, 0, 1}), (Vec3{0, -1, 0}));
    // A rotation, not a reflection: right × up of the picture is its backward direction in (x, y, −ζ).
    for (const Face face : all_faces) {
        const auto world = [&](Vec3 q) {
            const Vec3 w = from_face(face, q);
            return Vec3{w.x, w.y, -w.z};
        };
        EXPECT_EQ(cross(world({1, 0, 0}), world({0, 1, 0})), -world({0, 0, 1})) << face_name(face);
    }
}

TEST(Hemicube, has_every_direction_behind_the_hologram_in_one_face) {
    LightFieldGrid grid = small_grid();
    grid.directions_u = 8;
    grid.directions_v = 6;
    const std::vector<LightFieldGrid> faces = hemicube(grid);
    ASSERT_EQ(faces.size(), 5u);
    std::vector<std::size_t> rays(5);
    for (double x = -1; x < 1; x += 0.0173)
        for (double y = -1; y < 1; y += 0.0191) {
            if (x * x + y * y >= 1) continue;
            const Vec3 direction{x, y, std::sqrt(1 - x * x - y * y)};
            std::size_t count = 0;
            for (std::size_t i = 0; i < 5; ++i) {
                rays[i] += faces[i].covers(direction) ? 1 : 0;
                count += faces[i].covers(direction) ? 1 : 0;
            }
            ASSERT_EQ(count, 1u) << x << " " << y;
            for (const LightFieldGrid& face : faces) ASSERT_FALSE(face.covers({x, y, -direction.z}));
        }
    for (std::size_t count : rays) EXPECT_GT(count, 500u);
    // direction_of() leads to the sample itself.
    for (const LightFieldGrid& face : faces)
        for (std::size_t l = 0; l < face.directions_v; ++l)
            for (std::size_t k = 0; k < face.directions_u; ++k) {
                const Vec3 direction = face.direction_of(face.u(double(k)), face.v(double(l)));
                EXPECT_GT(direction.z, 0);
                EXPECT_TRUE(face.covers(direction));
            }
}

// The number of a side's directions covers the angle, exceeding it by less than one direction.
TEST(Hemicube, of_less_than_180_degrees_has_shorter_sides) {
    LightFieldGrid grid = small_grid();
    grid.directions_u = 9;  // odd numbers are no hindrance here
    grid.directions_v = 6;
    const double across = 2.2, down = 1.8;
    const std::vector<LightFieldGrid> faces = hemicube(grid, across, down);
    ASSERT_EQ(faces.size(), 5u);
    EXPECT_EQ(faces[1].directions_u, 3u);
    EXPECT_EQ(faces[3].directions_v, 1u);
    const double end_x = 3, end_y = 1.5;  // |x|/ζ and |y|/ζ: 1/(1 − 2·3/9) and 1/(1 − 2·1/6)
    EXPECT_GE(end_x, std::tan(across / 2));
    EXPECT_LT(1 / (1 - 2. * 2 / 9), std::tan(across / 2));
    EXPECT_GE(end_y, std::tan(down / 2));
    for (double x = -1; x < 1; x += 0.0173)
        for (double y = -1; y < 1; y += 0.0191) {
            if (x * x + y * y >= 1) continue;
            const double z = std::sqrt(1 - x * x - y * y), away_x = std::abs(x) / z, away_y = std::abs(y) / z;
            const bool inside = std::max(away_x, away_y) <= 1 || (away_x >= away_y ? away_x <= end_x : away_y <= end_y);
            const auto count = std::ranges::count_if(faces, [&](const LightFieldGrid& face) {
                return face.covers({x, y, z});
            });
            ASSERT_EQ(count, inside ? 1 : 0) << x << " " << y;
        }
    EXPECT_EQ(hemicube(grid, across, 3.1).at(3).directions_v, 3u);
    for (const double angle : {std::numbers::pi / 2, 1.0, 3.2, -2.0, std::nan("")})
        EXPECT_THROW(hemicube(grid, across, angle), Error) << angle;
    EXPECT_THROW(hemicube(grid), Error);  // nine directions cannot be halved
}

TEST(Hemicube, pictures_continue_each_other) {
    LightFieldGrid grid = small_grid();
    grid.directions_u = 8;
    grid.directions_v = 6;
    const std::vector<LightFieldGrid> faces = hemicube(grid);
    const auto direction = [&](std::size_t i, double k, double l) {
        return normalize(faces[i].direction_of(faces[i].u(k), faces[i].v(l)));
    };
    for (double along : {-0.5, 1.0, 3.3, 5.5}) {
        EXPECT_NEAR(length(direction(0, 7.5, along) - direction(2, -0.5, along)), 0, 1e-12);  // front and right
        EXPECT_NEAR(length(direction(0, -0.5, along) - direction(1, 3.5, along)), 0, 1e-12);  // front and left
        EXPECT_NEAR(length(direction(0, along, -0.5) - direction(3, along, 2.5)), 0, 1e-12);  // front and top
        EXPECT_NEAR(length(direction(0, along, 5.5) - direction(4, along, -0.5)), 0, 1e-12);  // front and bottom
    }
}

TEST(Hemicube, refuses_what_cannot_be_halved_or_reaches_beyond_the_plane) {
    LightFieldGrid grid = small_grid();
    EXPECT_THROW(hemicube(grid), Error);  // three rows of directions
    std::get<Perspective>(grid.view).face = Face::left;
    EXPECT_THROW(validate(grid, ErrorCode::usage, "light field"), Error);
    grid.range().center_u = grid.half_u();
    validate(grid, ErrorCode::usage, "light field");
    std::get<Perspective>(grid.view).face = Face::right;
    EXPECT_THROW(validate(grid, ErrorCode::usage, "light field"), Error);
}

// A lamp in front of a picture: the radiance depends on where the ray meets a plane behind the hologram, so that rays
// of different hogels through a point of it agree, with and without a fixed focal plane.
TEST(LightFieldFrom, a_function_sees_the_ray_of_each_sample) {
    const double depth = 3_mm;
    const auto picture = [&](double s, double t, double u, double v) {
        const double x = s + u * depth, y = t + v * depth;
        return Rgb{static_cast<float>(x), static_cast<float>(y), static_cast<float>(u)};
    };
    for (const bool has_focal_plane : {false, true}) {
        LightFieldGrid g = small_grid();
        if (has_focal_plane) g.view = FocalPlane{g.range(), depth};
        const LightField light_field = light_field_from(g, picture);
        LightFieldTile tile(g, {2, 1, 3, 4}, false);
        light_field.front().read(tile);
        for (std::size_t t = 0; t < 4; ++t)
            for (std::size_t s = 0; s < 3; ++s)
                for (std::size_t v = 0; v < g.directions_v; ++v)
                    for (std::size_t u = 0; u < g.directions_u; ++u) {
                        const double hogel_s = g.s(static_cast<double>(2 + s)), U = g.u(static_cast<double>(u));
                        // Through a fixed focal plane all hogels see the same points of it.
                        const double x = has_focal_plane ? U * depth : hogel_s + U * depth;
                        EXPECT_NEAR(tile.radiance(0, t, s, v, u), x, 1e-9);
                        EXPECT_NEAR(tile.radiance(2, t, s, v, u), (x - hogel_s) / depth, 1e-6);
                    }
        EXPECT_NEAR(tile.radiance(1, 0, 0, 0, 0), has_focal_plane ? g.v(0) * depth : g.t(1) + g.v(0) * depth, 1e-9);
    }
}

TEST(LightFieldFrom, a_number_is_the_radiance_of_all_channels) {
    LightFieldGrid g = small_grid();
    for (const std::size_t channels : {1u, 3u}) {
        g.channels = channels;
        const LightField light_field = light_field_from(g, [](double s, double, double, double) { return s; });
        LightFieldTile tile(g, {3, 2, 2, 1}, false);
        light_field.front().read(tile);
        for (std::size_t c = 0; c < channels; ++c) EXPECT_EQ(tile.radiance(c, 0, 1, 2, 3), static_cast<float>(g.s(4)));
    }
    g.pitch = 0;
    EXPECT_THROW(light_field_from(g, [](double, double, double, double) { return 1; }), Error);
    g = small_grid();
    g.view = Perspective{g.range(), Face::left};
    EXPECT_THROW(light_field_from(g, [](double, double, double, double) { return 1; }), Error);
}

}  // namespace
}  // namespace hogel::lightfield
