// SPDX-License-Identifier: Apache-2.0
// Compares every method from a light field to fringes with theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/parallax.h"
#include "hogel/stereogram/points.h"
#include "hogel/stereogram/surface_cells.h"
#include "hogel/stereogram/windows/batch.h"
#include "hogel/units.h"

namespace hogel::stereogram {
namespace {

using namespace literals;
using Complex = std::complex<float>;

// A rectangle of uniform radiance at one depth; all rays that miss it are dark.
struct Card {
    double depth, left = -1, right = 1, bottom = -1, top = 1;
    float radiance = 1;
};

LightFieldBuffer light_field_of(const LightFieldGrid& grid, std::span<const Card> cards) {
    LightFieldBuffer light_field(grid, true);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t l = 0; l < grid.directions_v; ++l)
                for (std::size_t k = 0; k < grid.directions_u; ++k)
                    for (const Card& card : cards) {
                        const double x = grid.s(double(s)) + grid.u(double(k)) * card.depth;
                        const double y = grid.t(double(t)) + grid.v(double(l)) * card.depth;
                        if (x < card.left || x >= card.right || y < card.bottom || y >= card.top) continue;
                        if (light_field.depth(t, s, l, k) <= card.depth) continue;
                        light_field.depth(t, s, l, k) = float(card.depth);
                        light_field.radiance(0, t, s, l, k) = card.radiance;
                    }
    return light_field;
}

HologramOptions options_for(const HologramMethod& method, double pitch) {
    HologramOptions options;
    options.method = method;
    options.pitch = pitch;
    return options;
}

Array<Complex, 2> whole(const FieldSource& source, std::size_t look = 0) {
    const Grid& plane = source.grid().plane;
    Array<Complex, 2> field({plane.height, plane.width});
    source.read({0, 0, plane.width, plane.height}, look, field);
    return field;
}

// Intensity of a hologram's light along a line in x through a point, from −reach to +reach in steps of reach/80: a
// direct sum over samples, averaged over looks. The hologram is a strip with nearly equal rows.
std::vector<double> focus_of(const FieldSource& source, const Vec3& point, double reach) {
    const Grid& plane = source.grid().plane;
    const double k = 2 * std::numbers::pi / source.grid().wavelength;
    constexpr int steps = 80;
    std::vector<double> intensity(2 * steps + 1);
    for (std::size_t look = 0; look < source.looks(); ++look) {
        const Array<Complex, 2> field = whole(source, look);
        for (int i = -steps; i <= steps; ++i) {
            const double px = point.x + reach * i / steps;
            std::complex<double> sum = 0;
            for (std::size_t row = 0; row < plane.height; row += 4)
                for (std::size_t column = 0; column < plane.width; ++column) {
                    if (field(row, column) == Complex(0)) continue;
                    const double dx = plane.x(double(column)) - px, dy = plane.y(double(row)) - point.y;
                    const double r = std::sqrt(dx * dx + dy * dy + point.z * point.z);
                    sum += std::complex<double>(field(row, column)) * std::polar(1.0, (point.z < 0 ? -k : k) * r);
                }
            const int place = i + steps;
            intensity[std::size_t(place)] += std::norm(sum);
        }
    }
    return intensity;
}

// Full width at half maximum, as a fraction of the line's reach, and the position of the maximum.
struct Peak {
    double width, at;
};
Peak peak_of(const std::vector<double>& intensity) {
    const auto peak = std::max_element(intensity.begin(), intensity.end());
    const auto below = [&](double value) { return value < *peak / 2; };
    const auto after = std::find_if(peak, intensity.end(), below);
    const auto before = std::find_if(std::make_reverse_iterator(peak), intensity.rend(), below);
    return {double(after - before.base()) / 80, double(peak - intensity.begin()) / 80 - 1};
}

// Share of the line's energy in its inner half.
double inner_half(const std::vector<double>& intensity) {
    double inner = 0, all = 0;
    for (std::size_t i = 0; i < intensity.size(); ++i) {
        all += intensity[i];
        if (i > 40 && i < 120) inner += intensity[i];
    }
    return inner / all;
}

// |<F, G>|²/(<F,F><G,G>): one if F is a multiple of G.
double likeness(const FieldSource& source, const Field& exact) {
    const Array<Complex, 2> field = whole(source);
    std::complex<double> product = 0;
    double energy = 0, other = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
        const std::complex<double> a = field.data()[i], b = exact.samples.data()[i];
        if (a == 0.0) continue;  // no ray of the field of view comes from the point
        product += a * std::conj(b);
        energy += std::norm(a);
        other += std::norm(b);
    }
    return std::norm(product) / (energy * other);
}

// A small patch of a plane, which every hogel sees by one ray. The hologram is a strip in front of the point or behind
// it.
class PointFocus : public testing::TestWithParam<double> {
  protected:
    const double depth = GetParam() * 1e-6 * std::exp(79 / 8.0), tan_half = 0.1, wavelength = 633_nm;
    const LightFieldGrid grid{72, 1, 64_um, 25, 25, Perspective{tan_half, tan_half}, 1};
    // One cell of the surface, as wide as the distance of neighbouring rays there.
    const double cell = std::abs(depth) * grid.step_u();
    const SurfaceCell middle = SurfaceCells(grid.step_u(), grid.step_v(), 1, 0).find(0, 0, depth, 0);
    const Card card{depth, middle.x - cell / 2, middle.x + cell / 2, middle.y - cell / 2, middle.y + cell / 2};
    const LightFieldBuffer light_field = light_field_of(grid, {&card, 1});

    const Vec3 point{middle.x, middle.y, -depth};

    std::shared_ptr<const FieldSource> hologram(const HologramMethod& method, std::size_t looks = 1) const {
        HologramOptions options = options_for(method, 2_um);
        options.looks = looks;
        return make_hologram(borrow(light_field), options);
    }
};

// A fan of rays of sine ±s gives sinc² with a full width at half maximum of 0.886 λ/2s.
TEST_P(PointFocus, with_added_phases_is_as_narrow_as_the_whole_fan_of_rays_allows) {
    const double fan = 0.886 * wavelength / (2 * tan_half / std::hypot(1, tan_half));
    for (const bool exact : {false, true}) {
        const Peak peak = peak_of(focus_of(*hologram(PhaseAdded{exact}), point, 20_um));
        EXPECT_NEAR(peak.width * 20_um / fan, 1, 0.1);
        EXPECT_NEAR(peak.at * 20_um, 0, 0.3_um);
    }
}

// One hogel is a slit: sinc² with its first zero at λζ/d. The frequency grid also spreads the ray over lobes: by the
// hat function of ray interpolation and by the width of a lobe.
TEST_P(PointFocus, without_added_phases_is_as_wide_as_one_hogel_diffracts) {
    const double zero = wavelength * std::abs(depth) / grid.pitch;
    const double hat = grid.step_u() / (wavelength / grid.pitch);  // in lobes
    std::vector<double> expected(161);
    for (int i = -80; i <= 80; ++i)
        for (int lobe = -10; lobe <= 10; ++lobe)
            for (int ray = -10; ray <= 10; ++ray) {
                const double x = std::numbers::pi * (i / 80.0 - lobe / 21.0 - hat * ray / 10.0);
                const double sinc = std::abs(x) < 1e-9 ? 1 : std::sin(x) / x;
                const int place = i + 80;
                expected[std::size_t(place)] += sinc * sinc * (1 - std::abs(ray) / 10.0);
            }
    EXPECT_NEAR(inner_half(focus_of(*hologram(Fourier{}, 12), point, zero)), inner_half(expected), 0.05);
    EXPECT_GT(inner_half(focus_of(*hologram(PhaseAdded{true}), point, zero)), 0.97);
}

// With exact frequencies the waves are the point's, but for the sphere's curvature over one hogel. With the nearest
// frequencies they err by up to half a step along x, uniformly distributed, and in y equally in all hogels.
TEST_P(PointFocus, with_exact_added_phases_is_the_exact_sum) {
    const auto exactly = hologram(PhaseAdded{true});
    const PointSource source{point};
    const Field exact = point_hologram({&source, 1}, exactly->grid());
    EXPECT_GT(likeness(*exactly, exact), 0.985);
    const double lobes = point.y / std::hypot(point.y, depth) / (wavelength / grid.pitch);
    const double off = std::numbers::pi * (lobes - std::round(lobes)), sinc = off == 0 ? 1 : std::sin(off) / off;
    EXPECT_NEAR(likeness(*hologram(PhaseAdded{false}), exact), std::pow(0.873 * sinc, 2), 0.03);
    EXPECT_LT(likeness(*hologram(Fourier{}), exact), 0.05);
}

INSTANTIATE_TEST_SUITE_P(BehindAndInFront, PointFocus, testing::Values(1, -1));

class OverlapAddPoint : public testing::TestWithParam<double> {};

TEST_P(OverlapAddPoint, is_focused_as_narrowly_as_the_fan_of_rays_allows) {
    const double depth = GetParam(), tan_half = 8.5 * 633_nm / (19 * 4_um);
    const LightFieldGrid grid{201, 39, 4_um, 17, 17, Perspective{tan_half, tan_half}, 1};
    // The surface point nearest to the middle hogel.
    const auto beside = [](std::size_t hogels) {
        const double middle = 0.5 * double(hogels - 1);
        return (std::round(middle / windows::point_spacing) * windows::point_spacing - middle) * 4_um;
    };
    const double x = beside(grid.hogels_s), y = -beside(grid.hogels_t), half = 0.5 * windows::point_spacing * 4_um;
    const Card card{depth, x - half, x + half, y - half, y + half};
    const LightFieldBuffer light_field = light_field_of(grid, {&card, 1});
    const auto hologram = make_hologram(borrow(light_field), options_for(OverlapAdd{}, 4_um));
    const Peak peak = peak_of(focus_of(*hologram, {x, y, -depth}, 30_um));
    // Seventeen directions, 1/W apart, W = 19 samples.
    const double fan = 0.886 / (17 / (19 * 4_um));
    EXPECT_NEAR(peak.width * 30_um / fan, 1, 0.15);
    EXPECT_NEAR(peak.at * 30_um, 0, 0.4_um);
}

INSTANTIATE_TEST_SUITE_P(Depths, OverlapAddPoint, testing::Values(2e-3, 4e-3, -4e-3));

struct NamedMethod {
    const char* name;
    HologramMethod method;
};
void PrintTo(const NamedMethod& named, std::ostream* out) { *out << named.name; }

class EveryMethod : public testing::TestWithParam<NamedMethod> {
  protected:
    HologramOptions options(double pitch) const { return options_for(GetParam().method, pitch); }
};

TEST_P(EveryMethod, gives_the_same_bytes_in_any_tiling) {
    const LightFieldGrid grid{9, 7, 48_um, 20, 22, Perspective{0.12, 0.13}, 1};
    const Card cards[] = {{3e-3, 0, 1, -1, 1, 0.5f}, {-2e-3, -1, 1, 0, 0.1e-3, 2}};
    LightFieldBuffer light_field = light_field_of(grid, cards);
    light_field.radiance(0, 2, 2, 3, 3) = 7;  // a bright ray without a surface
    const auto source = make_hologram(borrow(light_field), options(2_um));
    const Array<Complex, 2> all = whole(*source);
    double energy = 0;
    for (const Complex& value : all.elements()) energy += std::norm(value);
    EXPECT_GT(energy, 0);
    for (const Region& region : {Region{0, 0, 24, 24}, Region{13, 29, 101, 77}, Region{215, 167, 1, 1}}) {
        Array<Complex, 2> part({region.height, region.width});
        source->read(region, 0, part);
        for (std::size_t y = 0; y < region.height; ++y)
            for (std::size_t x = 0; x < region.width; ++x)
                ASSERT_EQ(part(y, x), all(region.y0 + y, region.x0 + x)) << x << " " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         testing::Values(NamedMethod{"fourier random", Fourier{Phases::random}},
                                         NamedMethod{"fourier fixed", Fourier{Phases::fixed}},
                                         NamedMethod{"fourier designed", Fourier{Phases::designed}},
                                         NamedMethod{"phase-added", PhaseAdded{false}},
                                         NamedMethod{"phase-added-exact", PhaseAdded{true}},
                                         NamedMethod{"overlap-add random", OverlapAdd{PointPhases::random}},
                                         NamedMethod{"overlap-add fixed", OverlapAdd{PointPhases::fixed}},
                                         NamedMethod{"basis fixed", Basis{"cdf97", 0, SharedPhases::fixed}},
                                         NamedMethod{"basis designed", Basis{"cdf97", 0, SharedPhases::designed}}));

// Methods with light in all directions, as from a diffuse surface.
class DiffuseMethod : public EveryMethod {
  protected:
    const bool overlapping = std::holds_alternative<OverlapAdd>(GetParam().method);
    const LightFieldGrid grid = overlapping ? LightFieldGrid{120, 120, 8_um, 11, 11, Perspective{0.06, 0.06}, 1}
                                            : LightFieldGrid{20, 20, 50_um, 20, 20, Perspective{0.1, 0.1}, 1};
    std::shared_ptr<const FieldSource> hologram(const LightFieldBuffer& light_field, std::size_t looks) const {
        HologramOptions chosen = options(overlapping ? 4_um : 2_um);
        chosen.looks = looks;
        return make_hologram(borrow(light_field), chosen);
    }
};

// No method changes the brightness of the light field, at any depth.
TEST_P(DiffuseMethod, photographs_a_uniform_plane_with_its_own_radiance) {
    for (double depth : {0.0, 0.4e-3, 1.5e-3, -3e-3}) {
        const Card card{depth};
        const LightFieldBuffer light_field = light_field_of(grid, {&card, 1});
        Camera camera;
        camera.eye = {0, 0, 50_mm};
        camera.pupil = 3_mm;
        camera.focus_depth = depth;
        camera.picture = {10, 10, 50_um, 50_um, 0, 0};
        const Image image = photograph(*hologram(light_field, 1), std::span(&camera, 1))[0];
        double mean = 0;
        for (float value : image.pixels.elements()) mean += value / 100;
        EXPECT_NEAR(mean, 1, overlapping ? 0.16 : 0.08) << depth;
    }
}

// A near card hides the left half of a far plane. With either in focus, photographs by waves and by rays must agree,
// except for speckle and the pixel beside the edge.
TEST_P(DiffuseMethod, photographs_a_card_before_a_plane_as_rays_do) {
    const Card cards[] = {{0.5e-3, -1, 0, -1, 1, 1}, {3e-3, -1, 1, -1, 1, 0.25f}};
    const LightFieldBuffer light_field = light_field_of(grid, cards);
    for (double focus : {0.5e-3, 3e-3}) {
        Camera camera;
        camera.eye = {0, 0, 50_mm};
        camera.pupil = 3.4_mm;
        camera.focus_depth = focus;
        camera.picture = {8, 1, 80_um, 640_um, 0, 0};
        const Image waves = photograph(*hologram(light_field, 4), std::span(&camera, 1))[0];
        const Image rays = photograph(borrow(light_field), std::span(&camera, 1))[0];
        for (std::size_t x = 0; x < 8; ++x)
            EXPECT_NEAR(waves.pixels.data()[x], rays.pixels.data()[x], 0.05 + 0.1 * rays.pixels.data()[x])
                << focus << " " << x;
    }
}

TEST(OverlapAdd, neighbouring_parallax_is_the_largest_depth_times_the_step_of_directions) {
    const LightFieldGrid grid{40, 30, 6.4_um, 9, 9, Perspective{0.045, 0.036}, 1};
    const Card cards[] = {{-3e-3, -1, 0, -1, 1}, {2e-3}};
    const LightFieldBuffer light_field = light_field_of(grid, cards);
    // 3 mm · 0.09/9 at 6.4 µm.
    EXPECT_NEAR(neighbouring_parallax(light_field, 6.4_um), 3e-3 * 0.01 / 6.4e-6, 1e-6);
    EXPECT_EQ(neighbouring_parallax(LightFieldBuffer(grid), 6.4_um), 0);
}

TEST(OverlapAdd, a_picture_at_infinity_is_told_from_a_background) {
    LightFieldBuffer light_field({40, 30, 6.4_um, 3, 3, Perspective{0.045, 0.036}, 1}, true);
    std::ranges::fill(light_field.depth.elements(), std::numeric_limits<float>::infinity());
    std::ranges::fill(light_field.radiance.elements(), 0.02f);
    light_field.depth.data()[7] = 1e-3f;
    light_field.radiance.data()[7] = 1;
    EXPECT_FALSE(has_picture_at_infinity(borrow(light_field).front()));
    for (std::size_t ray = 0; ray < light_field.radiance.size(); ray += 9) light_field.radiance.data()[ray] = 1;
    EXPECT_TRUE(has_picture_at_infinity(borrow(light_field).front()));
    EXPECT_FALSE(has_picture_at_infinity(LightFieldBuffer(light_field.grid())));
}

// A fan of directions to one side, as for an off-axis camera, is as bright as a fan straight ahead.
TEST(OverlapAdd, an_off_axis_plane_photographs_with_its_own_radiance) {
    for (const double center : {0.5, -0.5}) {
        LightFieldGrid grid{100, 60, 4.8_um, 9, 9, Perspective{0.09, 0.09}, 1};
        grid.range().center_u = center;
        for (const double depth : {0.3e-3, 0.6e-3}) {
            const Card card{depth};
            const LightFieldBuffer light_field = light_field_of(grid, {&card, 1});
            Camera camera;
            camera.eye = {-center * 50_mm, 0, 50_mm};
            camera.pupil = 3_mm;
            camera.focus_depth = depth;
            camera.picture = {6, 4, 40_um, 40_um, 0, 0};
            const auto hologram = make_hologram(borrow(light_field), options_for(OverlapAdd{}, 0.6_um));
            const Image image = photograph(*hologram, std::span(&camera, 1))[0];
            double mean = 0;
            for (float value : image.pixels.elements()) mean += value / 24;
            EXPECT_NEAR(mean, 1, 0.16) << center << " " << depth;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, DiffuseMethod,
                         testing::Values(NamedMethod{"fourier random", Fourier{Phases::random}},
                                         NamedMethod{"fourier fixed", Fourier{Phases::fixed}},
                                         NamedMethod{"fourier designed", Fourier{Phases::designed}},
                                         NamedMethod{"phase-added", PhaseAdded{false}},
                                         NamedMethod{"phase-added-exact", PhaseAdded{true}},
                                         NamedMethod{"overlap-add random", OverlapAdd{PointPhases::random}}));

double peak_over_mean(std::span<const Complex> field) {
    double mean = 0, peak = 0;
    for (const Complex& value : field) {
        mean += std::norm(value) / double(field.size());
        peak = std::max(peak, double(std::norm(value)));
    }
    return peak / mean;
}

// The largest intensity of N random sums is about ln N times the mean.
TEST(DesignedPhases, flatten_the_fringe) {
    const LightFieldGrid grid{4, 4, 64_um, 24, 24, Perspective{0.12, 0.12}, 1};
    LightFieldBuffer light_field(grid);
    std::ranges::fill(light_field.radiance.elements(), 1.0f);
    const auto ratio = [&](Phases phases) {
        const Array<Complex, 2> field = whole(*make_hologram(borrow(light_field), options_for(Fourier{phases}, 2_um)));
        return peak_over_mean(field.elements());
    };
    EXPECT_NEAR(ratio(Phases::random), std::log(16384), 3);
    EXPECT_LT(ratio(Phases::designed), 2);
}

void expect_usage(const LightFieldSource& light_field, const HologramOptions& options, const std::string& part) {
    try {
        make_hologram(borrow(light_field), options);
        ADD_FAILURE() << "expected: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(MakeHologram, names_a_light_field_that_would_do_where_it_refuses_one) {
    const LightFieldBuffer flat({4, 4, 64_um, 25, 25, Perspective{0.12, 0.12}, 1});
    expect_usage(flat, options_for(PhaseAdded{}, 2_um), "needs the depth of every ray");
    expect_usage(flat, options_for(OverlapAdd{}, 2_um), "needs the depth of every ray");
    const LightFieldBuffer coarse({4, 4, 64_um, 24, 12, Perspective{0.12, 0.12}, 1}, true);
    expect_usage(coarse, options_for(PhaseAdded{}, 2_um), "need 25x25 directions or more");
    const LightFieldBuffer deep({4, 4, 64_um, 25, 25, Perspective{0.12, 0.12}, 1}, true);
    EXPECT_NO_THROW(make_hologram(borrow(deep), options_for(PhaseAdded{}, 2_um)));
}

}  // namespace
}  // namespace hogel::stereogram
