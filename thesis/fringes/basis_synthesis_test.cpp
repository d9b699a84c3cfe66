// SPDX-License-Identifier: Apache-2.0
// Compares basis fringes with one Fourier transform per hogel with the same phases.
#include <gtest/gtest.h>

#include <cmath>

#include "hogel/core/test_targets.h"
#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/math/fft.h"
#include "hogel/stereogram/frequency_grid.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"
#include "thesis/fringes/fringe_table.h"
#include "thesis/wavelets/transform.h"

namespace hogel::fringes {

using namespace stereogram;

namespace {

using namespace literals;
using Complex = std::complex<float>;

LightFieldBuffer smooth_light_field() {
    LightFieldBuffer light_field({3, 2, 48_um, 20, 18, Perspective{0.14, 0.13}, 1});
    for (std::size_t t = 0; t < 2; ++t)
        for (std::size_t s = 0; s < 3; ++s)
            for (std::size_t l = 0; l < 18; ++l)
                for (std::size_t k = 0; k < 20; ++k)
                    light_field.radiance(0, t, s, l, k) =
                        float(std::pow(0.5 + 0.4 * std::sin(0.2 * double(k) + 0.3 * double(l) + double(s + 2 * t)), 2));
    return light_field;
}

HologramOptions options_for(const HologramMethod& method) {
    HologramOptions options;
    options.method = method;
    options.pitch = 2_um;
    options.looks = 2;
    return options;
}

HologramOptions basis_options(std::string_view transform, double tolerance = 0) {
    return options_for(Basis{std::string(transform), tolerance});
}

const Fourier fixed_amplitudes{Phases::fixed, LobeAverage::amplitude};

Array<Complex, 2> whole(const FieldSource& source, std::size_t look) {
    const Grid& plane = source.grid().plane;
    Array<Complex, 2> field({plane.height, plane.width});
    source.read({0, 0, plane.width, plane.height}, look, field);
    return field;
}

double difference(const Array<Complex, 2>& a, const Array<Complex, 2>& b) {
    double error = 0, energy = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        error += std::norm(a.data()[i] - b.data()[i]);
        energy += std::norm(a.data()[i]);
    }
    return std::sqrt(error / energy);
}

TEST(BasisSynthesis, equals_one_fourier_transform_a_hogel_for_every_transform_of_the_directions) {
    const LightFieldBuffer light_field = smooth_light_field();
    for (const SharedPhases phases : {SharedPhases::fixed, SharedPhases::designed}) {
        const bool designed = phases == SharedPhases::designed;
        const Fourier fourier{designed ? Phases::designed : Phases::fixed, LobeAverage::amplitude};
        const auto expected = make_hologram(borrow(light_field), options_for(fourier));
        for (const std::string_view name : wavelets::transform_names()) {
            if (designed && name != "ai33") continue;
            const auto basis = make_hologram(borrow(light_field), options_for(Basis{std::string(name), 0, phases}));
            for (std::size_t look : {0, 1})
                EXPECT_LT(difference(whole(*expected, look), whole(*basis, look)), 1e-5) << name << " " << look;
        }
    }
}

// Light that differs from hogel to hogel, from face to face and along both directions.
double varied(Vec3 hogel, Vec3 direction) {
    const Vec3 d = normalize(direction);
    const double wave = std::sin(5 * d.x + 3 * d.y * d.z + 4e4 * hogel.x) + std::cos(4 * d.y - 5e4 * hogel.y);
    return std::pow(0.5 + 0.2 * wave, 2);
}

// Returns the coefficients of every face, in place of its radiances.
LightField coefficients_of(const LightField& light_field, std::string_view transform) {
    std::vector<LightField::Source> faces;
    for (const LightField::Source& face : light_field.faces()) {
        auto part = std::make_shared<LightFieldBuffer>(face->grid());
        copy(*face, *part);
        for (float& value : part->radiance.elements()) value = std::sqrt(value);
        const LightFieldGrid& grid = face->grid();
        wavelets::transform(transform).forward(
            wavelets::Pyramid::separate({grid.hogels(), grid.directions_v, grid.directions_u}, {{1, 2}}),
            part->radiance.elements());
        faces.push_back(part);
    }
    return LightField(std::move(faces));
}

struct Sides {
    const char* name;
    LightField light_field;
    double pitch;
    std::optional<double> line_pitch;
};

// Returns a hemicube, one whose sides shrink, lines of a front, and of a hemisquare.
std::vector<Sides> beyond_a_front() {
    const LightFieldGrid square{3, 2, 18_um, 12, 12, Perspective{1, 1}, 1};
    const LightFieldGrid row{3, 2, 48_um, 20, 1, Perspective{0.14, 0.01}, 1};
    const LightFieldGrid wide_row{3, 2, 18_um, 16, 1, Perspective{1, 0.1}, 1};
    return {{"hemicube", hemicube_of(square, varied), 0.36_um, {}},
            {"shrunk hemicube", light_field_of_faces(hemicube(square, 130_deg, 120_deg), varied), 0.36_um, {}},
            {"lines", light_field_of_faces({&row, 1}, varied), 2_um, 6_um},
            {"lines of a hemisquare", hemicube_of(wide_row, varied), 0.36_um, 3_um}};
}

TEST(BasisSynthesis, of_hemicubes_and_of_lines_equals_one_fourier_transform_a_hogel) {
    for (const Sides& sides : beyond_a_front())
        for (const SharedPhases phases : {SharedPhases::fixed, SharedPhases::designed}) {
            const bool designed = phases == SharedPhases::designed;
            const Phases same = designed ? Phases::designed : Phases::fixed;
            HologramOptions options = options_for(Fourier{same, LobeAverage::amplitude});
            if (sides.line_pitch) options.method = Lines{*sides.line_pitch, same, LobeAverage::amplitude};
            options.pitch = sides.pitch;
            const auto expected = make_hologram(sides.light_field, options);
            for (const char* name : {"haar", "cdf97", "ai33", "dct8"}) {
                if (designed && std::string_view(name) != "ai33") continue;
                options.method = Basis{name, 0, phases, sides.line_pitch};
                const auto basis = make_hologram(sides.light_field, options);
                ASSERT_EQ(basis->grid().plane, expected->grid().plane) << sides.name;
                for (std::size_t look : {0, 1})
                    EXPECT_LT(difference(whole(*expected, look), whole(*basis, look)), 1e-5)
                        << sides.name << " " << name << " " << look;
                const auto of_coefficients =
                    make_hologram_of_coefficients(coefficients_of(sides.light_field, name), options);
                EXPECT_LT(difference(whole(*basis, 1), whole(*of_coefficients, 1)), 1e-6) << sides.name << " " << name;
            }
        }
}

// Every direction of every face has its cell, so that the fringes of uniform light add up to that of interpolation.
TEST(BasisSynthesis, pieces_of_all_faces_add_up_to_uniform_light) {
    for (const Sides& sides : beyond_a_front()) {
        std::vector<LightFieldGrid> grids;
        for (const LightField::Source& face : sides.light_field.faces()) grids.push_back(face->grid());
        const LightField uniform = light_field_of_faces(grids, [](Vec3, Vec3) { return 2.0; });
        HologramOptions options = options_for(fixed_amplitudes);
        if (sides.line_pitch) options.method = Lines{*sides.line_pitch, Phases::fixed, LobeAverage::amplitude};
        options.pitch = sides.pitch;
        const auto expected = make_hologram(uniform, options);
        options.method = Basis{"pieces", 0, SharedPhases::fixed, sides.line_pitch};
        EXPECT_LT(difference(whole(*expected, 0), whole(*make_hologram(uniform, options), 0)), 1e-5) << sides.name;
    }
}

// Equal lines would send light only straight ahead.
TEST(BasisSynthesis, lines_have_phases_of_their_own) {
    const LightFieldGrid grid{1, 3, 48_um, 20, 1, Perspective{0.14, 0.01}, 1};
    HologramOptions options = options_for(Basis{"haar", 0, SharedPhases::fixed, 4_um});
    const auto field =
        whole(*make_hologram(light_field_of_faces({&grid, 1}, [](Vec3, Vec3) { return 1.0; }), options), 0);
    ASSERT_EQ(field.extent(0), std::size_t{3 * 12});
    std::complex<double> mean = 0;
    for (std::size_t line = 0; line < field.extent(0); ++line) {
        const std::complex<double> turn = std::complex<double>(field(line, 5)) / std::complex<double>(field(0, 5));
        EXPECT_NEAR(std::abs(turn), 1, 1e-5);
        for (std::size_t x = 0; x < field.extent(1); ++x)
            EXPECT_LT(std::abs(std::complex<double>(field(line, x)) - turn * std::complex<double>(field(0, x))), 1e-4);
        mean += turn / double(field.extent(0));
    }
    EXPECT_LT(std::abs(mean), 0.5);
}

// The error of the fringes is about the share of the amplitude that the omitted coefficients carry.
TEST(BasisSynthesis, tolerance_bounds_the_error_of_leaving_out_small_coefficients) {
    const LightFieldBuffer light_field = smooth_light_field();
    const Array<Complex, 2> all = whole(*make_hologram(borrow(light_field), basis_options("cdf97")), 0);
    for (const double tolerance : {0.3, 0.05, 0.01}) {
        const HologramOptions options = basis_options("cdf97", tolerance);
        const double error = difference(all, whole(*make_hologram(borrow(light_field), options), 0));
        EXPECT_LT(error, 1.2 * tolerance);
        EXPECT_GT(error, 0.05 * tolerance);
    }
}

TEST(BasisSynthesis, coefficients_and_radiances_make_the_same_hologram) {
    const LightFieldBuffer light_field = smooth_light_field();
    LightFieldBuffer coefficients = light_field;
    for (float& value : coefficients.radiance.elements()) value = std::sqrt(value);
    wavelets::transform("cdf42").forward(wavelets::Pyramid::separate({6, 18, 20}, {{1, 2}}),
                                         coefficients.radiance.elements());
    const HologramOptions options = basis_options("cdf42");
    const auto expected = make_hologram(borrow(light_field), options);
    EXPECT_LT(difference(whole(*expected, 1), whole(*make_hologram_of_coefficients(borrow(coefficients), options), 1)),
              1e-6);
}

// Lucente's basis: a direction's fringe is the transform of the part of each lobe that its cell covers. The cells cover
// all lobes within the field of view, so the fringes of a uniform hogel add up to that of linear interpolation.
TEST(BasisSynthesis, each_fringe_of_the_piecewise_basis_lights_one_cell_of_directions) {
    const LightFieldGrid grid{1, 1, 48_um, 20, 18, Perspective{0.14, 0.13}, 1};
    LightFieldBuffer uniform(grid), one(grid);
    std::ranges::fill(uniform.radiance.elements(), 2.0f);
    const auto of = [&](const LightFieldBuffer& light_field, const HologramOptions& options) {
        return whole(*make_hologram(borrow(light_field), options), 0);
    };
    EXPECT_LT(difference(of(uniform, options_for(fixed_amplitudes)), of(uniform, basis_options("pieces"))), 1e-5);
    one.radiance(0, 0, 0, 9, 4) = 1;
    Array<Complex, 2> spectrum = of(one, basis_options("pieces"));
    math::Fft2(24, 24).forward(spectrum);
    // The light of the cell is within its range of frequencies, extended by half a step of the frequency grid.
    const double step = 633_nm / 48_um, u = grid.u(4), v = grid.v(9);
    for (std::ptrdiff_t row = -12; row < 12; ++row)
        for (std::ptrdiff_t column = -12; column < 12; ++column) {
            const double sx = step * double(column), sy = -step * double(row);
            const double cosine = std::sqrt(1 - sx * sx - sy * sy);
            const bool lit = std::abs(-sx / cosine - u) < 0.52 * (step + grid.step_u()) &&
                             std::abs(-sy / cosine - v) < 0.52 * (step + grid.step_v());
            EXPECT_TRUE(lit || std::abs(spectrum(std::size_t(row + 24) % 24, std::size_t(column + 24) % 24)) < 1e-6);
        }
}

TEST(BasisSynthesis, refuses_unknown_transforms_other_methods_and_fringes_beyond_the_memory) {
    const LightFieldBuffer light_field = smooth_light_field();
    EXPECT_THROW(make_hologram(borrow(light_field), basis_options("wavy")), Error);
    EXPECT_THROW(make_hologram_of_coefficients(borrow(light_field), options_for(Fourier{})), Error);
    const LightFieldBuffer fine({1, 1, 512_um, 256, 256, Perspective{0.14, 0.13}, 1});
    EXPECT_THROW(make_hologram(borrow(fine), basis_options("cdf97")), Error);
}

HOGEL_TEST_ON_EVERY_TARGET(Fringes);

TEST_P(Fringes, sums_equal_the_plain_version) {
    const std::size_t size = 1000;
    Array<Complex, 2> fringes({5, size}), plain({1, size}), fast({1, size});
    for (std::size_t i = 0; i < fringes.size(); ++i)
        fringes.data()[i] = Complex(float(i * 7919 % 1009) / 1009 - 0.5f, float(i * 104729 % 1013) / 1013 - 0.5f);
    std::vector<WeightedFringe> sum;
    for (std::size_t i = 0; i < 5; ++i) sum.push_back({&fringes(i, 0), float(i) - 1.7f});
    sum_fringes_plain(sum, plain.elements());
    sum_fringes(sum, fast.elements());
    EXPECT_LT(difference(plain, fast), 1e-6);
}

}  // namespace
}  // namespace hogel::fringes
