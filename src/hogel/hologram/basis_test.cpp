// SPDX-License-Identifier: Apache-2.0
// Basis fringes against one transform a hogel with the same phases.
#include <gtest/gtest.h>

#include <cmath>

#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/hologram/frequency_grid.h"
#include "hogel/hologram/fringe_table.h"
#include "hogel/math/fft.h"
#include "hogel/transform/transform.h"
#include "hogel/units.h"

namespace hogel::hologram {
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

HologramOptions options_for(Method method, const std::string& transform) {
    HologramOptions options;
    options.method = method;
    options.phases = Phases::fixed;
    options.average = LobeAverage::amplitude;
    options.pitch = 2_um;
    options.transform = transform;
    options.looks = 2;
    return options;
}

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

TEST(Basis, gives_what_one_transform_a_hogel_gives_whatever_the_transform_of_the_directions) {
    const LightFieldBuffer light_field = smooth_light_field();
    for (const Phases phases : {Phases::fixed, Phases::designed}) {
        HologramOptions fourier = options_for(Method::fourier, "");
        fourier.phases = phases;
        const auto expected = make_hologram(light_field, fourier);
        for (const std::string_view name : transform::transform_names()) {
            if (phases == Phases::designed && name != "ai33") continue;
            HologramOptions options = options_for(Method::basis, std::string(name));
            options.phases = phases;
            const auto basis = make_hologram(light_field, options);
            for (std::size_t look : {0, 1})
                EXPECT_LT(difference(whole(*expected, look), whole(*basis, look)), 1e-5) << name << " " << look;
        }
    }
}

// What carries a share of the amplitude is left out, and the fringes differ by no more than about that.
TEST(Basis, leaves_out_what_does_not_matter) {
    const LightFieldBuffer light_field = smooth_light_field();
    const Array<Complex, 2> all = whole(*make_hologram(light_field, options_for(Method::basis, "cdf97")), 0);
    for (const double tolerance : {0.3, 0.05, 0.01}) {
        HologramOptions options = options_for(Method::basis, "cdf97");
        options.tolerance = tolerance;
        const double error = difference(all, whole(*make_hologram(light_field, options), 0));
        EXPECT_LT(error, 1.2 * tolerance);
        EXPECT_GT(error, 0.05 * tolerance);
    }
}

TEST(Basis, takes_coefficients_as_they_are) {
    const LightFieldBuffer light_field = smooth_light_field();
    LightFieldBuffer coefficients = light_field;
    for (float& value : coefficients.radiance.elements()) value = std::sqrt(value);
    transform::transform("cdf42").forward(transform::Pyramid::separate({6, 18, 20}, {{1, 2}}),
                                          coefficients.radiance.elements());
    const HologramOptions options = options_for(Method::basis, "cdf42");
    const auto expected = make_hologram(light_field, options);
    EXPECT_LT(difference(whole(*expected, 1), whole(*make_hologram_of_coefficients(coefficients, options), 1)), 1e-6);
}

// Lucente's basis: a direction's fringe is the transform of the part of each lobe that its cell covers. The cells cover
// all lobes within the field of view, so the fringes of a uniform hogel add up to that of linear interpolation.
TEST(Basis, of_pieces_is_one_cell_of_directions_each) {
    const LightFieldGrid grid{1, 1, 48_um, 20, 18, Perspective{0.14, 0.13}, 1};
    LightFieldBuffer uniform(grid), one(grid);
    std::ranges::fill(uniform.radiance.elements(), 2.0f);
    const auto of = [&](const LightFieldBuffer& light_field, Method method) {
        return whole(*make_hologram(light_field, options_for(method, "pieces")), 0);
    };
    EXPECT_LT(difference(of(uniform, Method::fourier), of(uniform, Method::basis)), 1e-5);
    one.radiance(0, 0, 0, 9, 4) = 1;
    Array<Complex, 2> spectrum = of(one, Method::basis);
    math::Fft2(24, 24).forward(spectrum);
    // The cell's light lies within its cell of frequencies, half a step of theirs around it.
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

TEST(Basis, refuses_what_cannot_be) {
    const LightFieldBuffer light_field = smooth_light_field();
    HologramOptions options = options_for(Method::basis, "cdf97");
    options.phases = Phases::random;
    EXPECT_THROW(make_hologram(light_field, options), Error);
    EXPECT_THROW(make_hologram(light_field, options_for(Method::basis, "wavy")), Error);
    const LightFieldBuffer fine({1, 1, 512_um, 256, 256, Perspective{0.14, 0.13}, 1});
    EXPECT_THROW(make_hologram(fine, options_for(Method::basis, "cdf97")), Error);
}

TEST(Fringes, sum_alike_plainly_and_fast) {
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
}  // namespace hogel::hologram
