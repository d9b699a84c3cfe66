// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <numbers>

#include "hogel/core/random.h"
#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/math/fft.h"
#include "hogel/pattern.h"
#include "hogel/patterns/pupils/camera.h"
#include "hogel/units.h"

namespace hogel::patterns {
namespace {

using namespace literals;
using Complex = std::complex<float>;

constexpr double wavelength = 520_nm, pixel_pitch = 8_um;
constexpr std::size_t pixels = 128, hogel_pixels = 4, directions = 9;

Modulator modulator(unsigned levels = 256) { return {"test", pixels, pixels, pixel_pitch, levels}; }

LightFieldGrid grid() {
    return {pixels / hogel_pixels,
            pixels / hogel_pixels,
            hogel_pixels * pixel_pitch,
            directions,
            directions,
            field_of_view(1.7 * std::asin(wavelength / 2 / pixel_pitch)),
            1};
}

// A plane of radiance texture(x, y) at a depth ζ, with its depth.
class PlaneScene final : public LightFieldSource {
  public:
    using Texture = std::function<double(double x, double y)>;
    PlaneScene(double depth, Texture texture) : depth_(depth), texture_(std::move(texture)) {}
    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }
    void read(LightFieldTile& tile) const override {
        const HogelRange& range = tile.range;
        for (std::size_t t = 0; t < range.nt; ++t)
            for (std::size_t s = 0; s < range.ns; ++s)
                for (std::size_t v = 0; v < directions; ++v)
                    for (std::size_t u = 0; u < directions; ++u) {
                        const double x = grid_.s(double(range.s0 + s)) + grid_.u(double(u)) * depth_;
                        const double y = grid_.t(double(range.t0 + t)) + grid_.v(double(v)) * depth_;
                        tile.radiance(0, t, s, v, u) = float(texture_(x, y));
                        if (tile.depth.size() > 0) tile.depth(t, s, v, u) = float(depth_);
                    }
    }

  private:
    LightFieldGrid grid_ = patterns::grid();
    double depth_;
    Texture texture_;
};

// A blob that is no mirror image of itself, on a grey ground.
double blob(double x, double y) {
    const auto spot = [&](double cx, double cy, double size) {
        return std::exp(-(std::pow(x - cx, 2) + std::pow(y - cy, 2)) / (size * size));
    };
    return 0.1 + spot(150_um, 80_um, 90_um) + 0.6 * spot(-100_um, -200_um, 60_um);
}

std::shared_ptr<const FieldSource> hologram(const std::shared_ptr<const LightFieldSource>& source, std::size_t looks) {
    HologramOptions options;
    options.channel = {wavelength, 0};
    options.pitch = pixel_pitch;
    options.looks = looks;
    return make_hologram(LightField(std::vector{source}), options);
}

std::vector<Pattern> encode(const FieldSource& field, const PatternOptions& options) {
    std::vector<Pattern> patterns;
    for (std::size_t look = 0; look < field.looks(); ++look) {
        Field one(field.grid());
        copy(field, one, look);
        patterns.push_back(encode_pattern(one, options));
    }
    return patterns;
}

SupervisedPatterns supervise(const std::shared_ptr<const FieldSource>& field, const LightFieldSource& light_field,
                             const PatternOptions& options) {
    const std::size_t channel = 0;
    return encode_supervised({&field, 1}, light_field, {&channel, 1}, options).front();
}

PatternOptions options_of(Encoding encoding, unsigned levels = 256) {
    PatternOptions options;
    options.encoding = encoding;
    options.modulator = modulator(levels);
    return options;
}

Array<Complex, 2> random_values(const Shape<2>& shape, std::uint32_t seed) {
    Array<Complex, 2> values(shape);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto bits = core::philox({std::uint32_t(i), 0, 0, 0}, {seed, 0});
        values.data()[i] = {float(bits[0] / 2147483648.0 - 1), float(bits[1] / 2147483648.0 - 1)};
    }
    return values;
}

std::complex<double> product(const Array<Complex, 2>& a, const Array<Complex, 2>& b) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::conj(std::complex<double>(a.data()[i])) * std::complex<double>(b.data()[i]);
    return sum;
}

// <P x, y> = <x, P* y> for the photograph P through any pupil.
TEST(PupilFilm, has_the_adjoint_of_its_photograph) {
    const PlaneScene scene(1_mm, blob);
    const PupilCamera camera(scene, 0, wavelength, modulator());
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Pupil pupil = camera.range().draw(7, i);
        const PupilFilm& film = camera.film(pupil);
        const Array<Complex, 2> x = random_values({pixels, pixels}, 1);
        Array<Complex, 2> y = random_values(film.shape(), 2), photograph(film.shape()), adjoint({pixels, pixels});
        film.photograph(x, pupil, wavelength, photograph);
        const std::complex<double> left = product(photograph, y);
        film.add_adjoint(y, pupil, wavelength, adjoint);
        const std::complex<double> right = product(x, adjoint);
        EXPECT_NEAR(std::abs(left - right) / std::abs(left), 0, 1e-4);
    }
}

// Photographs by waves of a hologram with many looks are those by rays, in place, parallax, focus and brightness.
class Photographs : public testing::TestWithParam<double> {};

TEST_P(Photographs, by_waves_and_by_rays_agree) {
    constexpr std::size_t looks = 64;
    const auto scene = std::make_shared<PlaneScene>(GetParam(), blob);
    const auto field = hologram(scene, looks);
    const PupilCamera camera(*scene, 0, wavelength, modulator());
    std::vector<Array<Complex, 2>> spectra;
    for (std::size_t look = 0; look < looks; ++look) {
        spectra.emplace_back(Shape<2>{pixels, pixels});
        field->read({0, 0, pixels, pixels}, look, spectra.back());
        math::Fft2(pixels, pixels).forward(spectra.back());
    }
    PhotographSums all;
    for (std::uint32_t i = 0; i < 6; ++i) {
        Pupil pupil = camera.range().draw(3, i);
        if (i % 2 == 0) pupil.focus = 0;  // in focus, a plane looks the same in all directions
        const Shape<2> shape = camera.film(pupil).shape();
        Array<float, 2> rays(shape), waves(shape);
        std::vector<Array<Complex, 2>> fields(looks, Array<Complex, 2>(shape));
        camera.photograph_rays(pupil, rays);
        camera.photograph_waves(spectra, pupil, fields, waves);
        const PhotographSums sums = camera.sums(pupil, waves, rays);
        const double error = sums.bb - sums.ab * sums.ab / sums.aa;
        EXPECT_LT(error / sums.bb, 0.009) << "pupil " << i;
        all += sums;
        EXPECT_NEAR(sums.factor() / all.factor(), 1, 0.1) << "pupil " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Depths, Photographs, testing::Values(-1.5_mm, 0.0, 1.5_mm));

// The contrast of a diffuse plane is that of fully developed speckle, divided by √N for N patterns of other phases.
TEST(PupilQuality, finds_the_contrast_of_speckle) {
    const auto scene = std::make_shared<PlaneScene>(0, [](double, double) { return 1.0; });
    const PatternOptions options = options_of(Encoding::gradient);
    for (const std::size_t looks : {std::size_t{1}, std::size_t{8}}) {
        const auto patterns = encode(*hologram(scene, looks), options);
        const double contrast = pupil_quality(patterns, *scene, 0, wavelength, options).contrast;
        EXPECT_NEAR(contrast * std::sqrt(double(looks)), 1, 0.25) << looks;
    }
}

// The power that shows the radiance of the light field is the power that shows its hologram.
TEST(PupilQuality, finds_the_power_of_the_light) {
    const auto scene = std::make_shared<PlaneScene>(0.5_mm, blob);
    const PatternOptions options = options_of(Encoding::gradient);
    const auto patterns = encode(*hologram(scene, 1), options);
    EXPECT_NEAR(pupil_quality(patterns, *scene, 0, wavelength, options).power / patterns[0].power, 1, 0.1);
}

struct Gain {
    std::size_t looks;
    unsigned levels;
    double decibels;
};

class Supervised : public testing::TestWithParam<Gain> {};

// Photographs are nearer to those by rays than those of patterns that show the field, also if levels are few.
TEST_P(Supervised, improves_photographs) {
    const Gain& gain = GetParam();
    const auto scene = std::make_shared<PlaneScene>(0.8_mm, blob);
    const auto field = hologram(scene, gain.looks);
    const PatternOptions start = options_of(Encoding::gradient, gain.levels);
    PatternOptions options = options_of(Encoding::supervised, gain.levels);
    options.iterations = 300;
    const SupervisedPatterns patterns = supervise(field, *scene, options);
    ASSERT_EQ(patterns.frames.size(), gain.looks);
    const PupilQuality supervised = pupil_quality(patterns.frames, *scene, 0, wavelength, options);
    EXPECT_EQ(supervised.psnr, patterns.quality.psnr);
    const PupilQuality gradient = pupil_quality(encode(*field, start), *scene, 0, wavelength, start);
    EXPECT_GT(supervised.psnr, gradient.psnr + gain.decibels);
    EXPECT_GT(supervised.lowest_psnr, gradient.lowest_psnr);
}

INSTANTIATE_TEST_SUITE_P(Patterns, Supervised, testing::Values(Gain{1, 256, 1}, Gain{4, 256, 2.5}, Gain{1, 4, 0.5}));

TEST(Supervised, refuses_what_it_cannot_show) {
    const auto scene = std::make_shared<PlaneScene>(0, blob);
    const auto field = hologram(scene, 1);
    EXPECT_THROW(encode_pattern(*field, options_of(Encoding::supervised)), Error);
    PatternOptions coarse = options_of(Encoding::supervised);
    coarse.modulator.pitch = 16_um;
    EXPECT_THROW(supervise(field, *scene, coarse), Error);
}

}  // namespace
}  // namespace hogel::patterns
