// SPDX-License-Identifier: Apache-2.0
#include "hogel/propagate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <numbers>
#include <random>

#include "hogel/error.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/optics/propagation/plain.h"
#include "hogel/units.h"

namespace hogel::optics::propagation {
namespace {

using namespace literals;
using Complex = std::complex<double>;
using std::numbers::pi;

template <class Value>
Field sampled(const Grid& plane, double wavelength, const Value& value) {
    Field field({plane, wavelength});
    for (std::size_t row = 0; row < plane.height; ++row)
        for (std::size_t column = 0; column < plane.width; ++column)
            field.samples(row, column) = std::complex<float>(value(plane.x(double(column)), plane.y(double(row))));
    return field;
}

Field noise(const Grid& plane, double wavelength, unsigned seed = 3) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    return sampled(plane, wavelength, [&](double, double) {
        const double real = normal(random);
        return Complex(real, normal(random));
    });
}

// Wave packets with random positions and directions. With a width of six samples they vanish at the borders of field
// and band.
Field packets(const Grid& plane, double wavelength, unsigned seed = 5) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    struct Packet {
        double x, y, fx, fy;
        Complex value;
    };
    std::vector<Packet> all;
    const double wx = 6 * plane.pitch_x, wy = 6 * plane.pitch_y;
    for (int i = 0; i < 30; ++i) {
        const double x = uniform(random), y = uniform(random), fx = uniform(random), fy = uniform(random);
        all.push_back({plane.center_x + x * (0.5 * plane.size_x() - 4 * wx),
                       plane.center_y + y * (0.5 * plane.size_y() - 4 * wy), 0.2 * fx / plane.pitch_x,
                       0.2 * fy / plane.pitch_y, std::polar(1.0, pi * uniform(random))});
    }
    return sampled(plane, wavelength, [&](double x, double y) {
        Complex sum = 0;
        for (const Packet& p : all)
            sum += p.value * std::exp(-std::pow((x - p.x) / wx, 2) - std::pow((y - p.y) / wy, 2)) *
                   unit_phasor(p.fx * x + p.fy * y);
        return sum;
    });
}

double energy(const Field& field) {
    double sum = 0;
    for (const auto& value : field.samples.elements()) sum += std::norm(Complex(value));
    return sum * field.grid().plane.pitch_x * field.grid().plane.pitch_y;
}

template <class Value>
double relative_error(const Field& field, const Value& value) {
    const Grid& plane = field.grid().plane;
    double error = 0, all = 0;
    for (std::size_t row = 0; row < plane.height; ++row)
        for (std::size_t column = 0; column < plane.width; ++column) {
            const Complex right = value(plane.x(double(column)), plane.y(double(row)));
            error += std::norm(Complex(field.samples(row, column)) - right);
            all += std::norm(right);
        }
    return std::sqrt(error / all);
}

double difference(const Field& a, const Field& b) {
    return relative_error(a, [&](double x, double y) {
        const Grid& plane = b.grid().plane;
        return Complex(b.samples(std::size_t(std::lround(plane.row(y))), std::size_t(std::lround(plane.column(x)))));
    });
}

// Returns the relative error at some output samples, including the corners.
template <class Sum>
double error_against(const Sum& sum, const Field& field, double distance, const Field& propagated) {
    const Grid& plane = propagated.grid().plane;
    std::mt19937 random(11);
    std::vector<PlanePoint> points;
    std::vector<Complex> values;
    for (std::size_t i = 0; i < 24; ++i) {
        const std::size_t row = i == 0 ? 0 : i == 1 ? plane.height - 1 : random() % plane.height;
        const std::size_t column = i == 0 ? 0 : i == 1 ? plane.width - 1 : random() % plane.width;
        points.push_back({plane.x(double(column)), plane.y(double(row))});
        values.push_back(Complex(propagated.samples(row, column)));
    }
    const std::vector<Complex> right = sum(field, distance, points);
    double error = 0, all = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        error += std::norm(values[i] - right[i]);
        all += std::norm(right[i]);
    }
    return std::sqrt(error / all);
}

Field propagate_to(const Field& field, double distance, const Grid& output) {
    PropagateOptions options;
    options.output = output;
    return hogel::propagate(field, distance, options);
}

// Returns the distance at which light at the band edge has a sideways path of this number of field widths.
double distance_of(double widths, const Grid& plane, double wavelength) {
    const double sine = std::min(0.9, 0.5 * wavelength / plane.pitch_x);
    return widths * plane.size_x() * std::sqrt(1 - sine * sine) / sine;
}

// White noise, with full amplitude at the band edge, is the hardest field.
TEST(PropagateNear, noise_equals_the_sum_of_its_plane_waves) {
    for (const auto& [wavelength, pitch] :
         {std::pair(450_nm, 1_um), std::pair(650_nm, 4_um), std::pair(650_nm, 0.5_um)})
        for (const double widths : {0.0, 0.02, -0.5, 1.0}) {
            const Grid plane{40, 30, pitch, 1.25 * pitch, 3 * pitch, -2 * pitch};
            const Field field = noise(plane, wavelength);
            const double z = distance_of(widths, plane, wavelength);
            EXPECT_LT(error_against(sum_of_plane_waves, field, z, hogel::propagate(field, z)), 1e-3)
                << wavelength << ' ' << pitch << ' ' << z;
            const Grid other{50, 40, 0.7 * pitch, 0.9 * pitch, -10 * pitch, 5 * pitch};
            EXPECT_LT(error_against(sum_of_plane_waves, field, z, propagate_to(field, z, other)), 1e-3)
                << wavelength << ' ' << pitch << ' ' << z << " other samples";
        }
}

// Beyond the sideways path of the band edge the light is as weak as that of spherical waves.
TEST(PropagateNear, noise_equals_the_sum_of_spherical_waves_beyond_the_edge_of_its_band) {
    for (const double pitch : {1_um, 4_um})
        for (const double widths : {2.5, -4.0, 20.0}) {
            const Grid plane{44, 44, pitch, pitch, 0, 0};
            const Field field = noise(plane, 532_nm);
            const double z = distance_of(widths, plane, 532_nm);
            EXPECT_LT(error_against(sum_of_spherical_waves, field, z, hogel::propagate(field, z)), 1e-3)
                << pitch << ' ' << z;
        }
}

// Samples finer than half a wavelength give evanescent and grazing waves.
TEST(PropagateNear, fine_samples_equal_the_sum_of_their_plane_waves) {
    for (const double pitch : {0.25_um})
        for (const double z : {0_um, 0.4_um, 3_um, -12_um}) {
            const Grid plane{56, 52, pitch, 1.25 * pitch, 3 * pitch, -2 * pitch};
            const Field field = packets(plane, 633_nm);
            PropagateOptions options;
            options.max_error = 10;
            EXPECT_LT(error_against(sum_of_plane_waves, field, z, hogel::propagate(field, z, options)), 1e-3)
                << pitch << ' ' << z;
        }
}

// Combines every distance with every wavelength and every size.
TEST(PropagateFar, every_size_distance_and_wavelength_equals_the_sum_of_spherical_waves) {
    const std::array wavelengths{450_nm, 532_nm, 650_nm};
    std::size_t n = 0;
    for (const double size : {0.1_mm, 0.5_mm, 2_mm, 20_mm}) {
        ++n;  // so that distances cycle through all wavelengths
        for (const double z : {0_mm, 1_mm, 20_mm, -200_mm, 1_m, 10_m}) {
            const double wavelength = wavelengths[n++ % wavelengths.size()];
            const Grid plane{60, 54, size / 60, size / 60, 0, 0};
            const Field field = packets(plane, wavelength);
            const double aside = 0.5 * wavelength / plane.pitch_x * std::abs(z);
            // The aliases begin at 1.4 times the sideways path of the band edge, outside the output.
            if (aside > 2 * size) {
                EXPECT_LT(error_against(sum_of_spherical_waves, field, z, hogel::propagate(field, z)), 1e-3)
                    << size << ' ' << z << ' ' << wavelength;
                const Grid wide{7, 6, 0.6 * aside / 7, 0.6 * aside / 6, 0.1 * aside, -0.05 * aside};
                EXPECT_LT(error_against(sum_of_spherical_waves, field, z, propagate_to(field, z, wide)), 1e-3)
                    << size << ' ' << z << ' ' << wavelength << " wide";
            } else {
                EXPECT_LT(error_against(sum_of_plane_waves, field, z, hogel::propagate(field, z)), 1e-3)
                    << size << ' ' << z << ' ' << wavelength;
            }
        }
    }
}

// A Gaussian beam along z of waist w; paraxial, with a phase error of kz(λ/πw)⁴/8.
Complex gaussian_beam(double wavelength, double w, double x, double y, double z) {
    const double range = pi * w * w / wavelength, square = x * x + y * y;
    const Complex q = Complex(1, z / range);
    return std::exp(-square / (w * w) / q) / q * unit_phasor(z / wavelength);
}

TEST(PropagateFar, a_gaussian_beam_in_windows_much_narrower_than_itself) {
    for (const double w : {40_um, 100_um})
        for (const double z : {0_mm, 20_mm, 60_mm, 200_mm, 300_mm, 1_m, 10_m, -1_m})
            for (const std::size_t n : {512, 1000}) {
                const Grid plane{n, n - 12, 1_um, 1_um, 0, 0};
                if (w > 50_um && n == 512) continue;  // cut by the window by more than 1e-3
                const Field waist =
                    sampled(plane, 532_nm, [&](double x, double y) { return gaussian_beam(532_nm, w, x, y, 0); });
                const Field propagated = hogel::propagate(waist, z);
                EXPECT_LT(
                    relative_error(propagated, [&](double x, double y) { return gaussian_beam(532_nm, w, x, y, z); }),
                    z > 5_m && w < 50_um ? 6e-3 : 1e-3)
                    << w << ' ' << z << ' ' << n;
            }
}

TEST(PropagateFar, output_samples_of_any_pitch_show_the_whole_beam) {
    const Grid plane{512, 512, 1_um, 1_um, 20_um, 30_um};
    const double w = 40_um;
    const auto beam = [&](double x, double y, double z) { return gaussian_beam(532_nm, w, x - 20_um, y - 30_um, z); };
    const Field waist = sampled(plane, 532_nm, [&](double x, double y) { return beam(x, y, 0); });
    for (const double z : {10_mm, 0.3_m, 1_m, -1_m}) {
        const double wide = w * std::hypot(1, z * 532_nm / (pi * w * w));
        const Grid output{96, 110, 6.5 * wide / 96, 6.8 * wide / 110, 20_um, 30_um};
        const Field propagated = propagate_to(waist, z, output);
        EXPECT_LT(relative_error(propagated, [&](double x, double y) { return beam(x, y, z); }), 1e-3) << z;
        EXPECT_NEAR(energy(propagated) / energy(waist), 1, 1e-4) << z;
    }
}

// S(f) = Δ sin(πNΔf)/sin(πΔf) are the plane waves of N equal samples.
TEST(PropagateFar, a_square_opening_makes_fraunhofers_pattern) {
    const Grid plane{100, 80, 1_um, 1_um, 0, 0};
    const double wavelength = 532_nm, z = 10_m;
    const Field opening = sampled(plane, wavelength, [](double, double) { return Complex(1); });
    const Grid output{128, 128, 4_mm, 4_mm, 0, 0};
    const auto waves = [](double f, double n) {
        return std::abs(f) < 1 ? n * 1_um : 1_um * std::sin(pi * n * 1_um * f) / std::sin(pi * 1_um * f);
    };
    EXPECT_LT(relative_error(propagate_to(opening, z, output),
                             [&](double x, double y) {
                                 const double r = std::hypot(x, y, z), f = 1 / (wavelength * r);
                                 return Complex(0, -z / r * f) * waves(x * f, 100) * waves(y * f, 80) *
                                        unit_phasor(r / wavelength);
                             }),
              1e-3);
}

// On the axis of a round opening of radius a, Rayleigh and Sommerfeld's integral is e^{ikz} − (z/r) e^{ikr}, r² = z² +
// a².
TEST(PropagateFar, the_axis_of_a_round_opening) {
    const Grid plane{801, 801, 0.5_um, 0.5_um, 0, 0};
    const double wavelength = 532_nm, radius = 180_um;
    // The edge is as soft as one sample, so that the samples have the disc's area.
    const Field disc = sampled(plane, wavelength, [&](double x, double y) {
        int inside = 0;
        for (int i = 0; i < 16; ++i)
            for (int j = 0; j < 16; ++j)
                inside += std::hypot(x + (i - 7.5) / 32 * 1_um, y + (j - 7.5) / 32 * 1_um) < radius;
        return Complex(inside / 256.0);
    });
    for (const double z : {20_mm, 61_mm, 0.2_m, 1_m, 10_m}) {
        const double r = std::hypot(z, radius);
        const Complex right = unit_phasor(z / wavelength) - z / r * unit_phasor(r / wavelength);
        const Field axis = propagate_to(disc, z, {1, 1, 1_um, 1_um, 0, 0});
        EXPECT_LT(std::abs(Complex(axis.samples(0, 0)) - right), 1e-3 * std::abs(right) + 2e-4) << z;
    }
}

// A round opening far away shows Airy's pattern.
TEST(PropagateFar, a_round_opening_makes_airys_pattern) {
    const Grid plane{401, 401, 0.25_um, 0.25_um, 0, 0};
    const double wavelength = 633_nm, radius = 45_um, z = 5_m;
    const Field disc = sampled(plane, wavelength, [&](double x, double y) {
        int inside = 0;
        for (int i = 0; i < 16; ++i)
            for (int j = 0; j < 16; ++j)
                inside += std::hypot(x + (i - 7.5) / 64 * 1_um, y + (j - 7.5) / 64 * 1_um) < radius;
        return Complex(inside / 256.0);
    });
    const Grid output{120, 120, 2_mm, 2_mm, 0, 0};
    EXPECT_LT(relative_error(propagate_to(disc, z, output),
                             [&](double x, double y) {
                                 const double r = std::hypot(x, y, z);
                                 const double v = 2 * pi * radius * std::hypot(x, y) / (wavelength * r);
                                 return Complex(0, -pi * radius * radius * z / (wavelength * r * r)) *
                                        (v < 1e-9 ? 1 : 2 * std::cyl_bessel_j(1.0, v) / v) *
                                        unit_phasor(r / wavelength);
                             }),
              1.5e-3);
}

// The energy is conserved if the output contains all light; propagation back restores the field, for any windows.
TEST(Propagate, there_and_back_through_a_window_that_holds_all_light) {
    const Grid plane{128, 120, 2_um, 2_um, 0, 0};
    const double wavelength = 532_nm;
    const Field field = packets(plane, wavelength);
    for (const double z : {0.3_mm, 5_mm, 80_mm}) {
        // Packets diffract by 0.2 + 0.2 cycles per pitch at the most.
        const double wide = plane.size_x() + 2 * 0.45 / 2_um * wavelength * z;
        const auto n = std::size_t(std::ceil(wide / 1.1_um));
        const Grid window{std::min<std::size_t>(n, 1500),
                          std::min<std::size_t>(n, 1500),
                          std::max(1.1_um, wide / 1500),
                          std::max(1.1_um, wide / 1500),
                          0,
                          0};
        const Field propagated = propagate_to(field, z, window);
        EXPECT_NEAR(energy(propagated) / energy(field), 1, 1e-4) << z;
        // The pitch of a larger window may be too coarse for the wave's curvature.
        if (n < 1500) {
            EXPECT_LT(difference(propagate_to(propagated, -z, plane), field), 1e-3) << z;
        }
    }
}

// The light from sample a to b equals that from b to a.
TEST(Propagate, is_reciprocal) {
    const Grid plane{90, 70, 1_um, 1.5_um, 0, 0}, other{60, 64, 2_um, 1_um, 25_um, -40_um};
    for (const double z : {5_mm, 30_mm, 2_m}) {
        Field one({plane, 532_nm}), two({other, 532_nm});
        one.samples(13, 70) = two.samples(51, 8) = 1;
        const Complex propagated = propagate_to(one, z, other).samples(51, 8),
                      back = propagate_to(two, z, plane).samples(13, 70);
        const Complex ratio = propagated / (1_um * 1.5_um) / (back / (2_um * 1_um));
        EXPECT_NEAR(std::abs(ratio - 1.0), 0, 1e-3) << z;
    }
}

TEST(Propagate, windows_are_parts_of_larger_ones_at_any_pitch) {
    const Grid plane{200, 150, 1_um, 1_um, 0, 0};
    const Field field = noise(plane, 532_nm);
    for (const double z : {0.2_mm, 3_mm, 50_mm, 1_m}) {
        const Grid large{400, 300, 1_um, 1_um, 10_um, 0};
        const Field all = propagate_to(field, z, large);
        const Grid cut = part(large, {250, 31, 90, 80});
        EXPECT_LT(difference(propagate_to(field, z, cut), all), 1e-3) << z;
        Grid coarse = part(large, {20, 40, 61, 31});
        coarse.pitch_x *= 5;
        coarse.pitch_y *= 7;
        coarse.center_x = large.x(20 + 5 * 30);
        coarse.center_y = large.y(40 + 7 * 15);
        EXPECT_LT(difference(propagate_to(field, z, coarse), all), 1e-3) << z;
    }
}

// Tiles of a large window join without a seam.
TEST(Propagate, tiles_equal_single_points) {
    const Grid plane{64, 60, 4_um, 4_um, 0, 0};
    const Field field = packets(plane, 633_nm);
    const Grid output{300, 300, 0.2_mm, 0.2_mm, 3_mm, 0};
    PropagateOptions options;
    options.output = output;
    const PropagationMethod method = propagation_method(field.grid(), 1_m, options);
    EXPECT_GT(method.tiles_x, 1u);
    EXPECT_LT(error_against(sum_of_spherical_waves, field, 1_m, propagate_to(field, 1_m, output)), 1e-3);
}

// The light cone of 64 samples of 1 um is 0.6 mm wide; the output of 4 mm is dark outside.
TEST(Propagate, a_window_wider_than_the_cone_of_light_is_dark_beside_it) {
    const Field field = packets({64, 60, 1_um, 1_um, 0, 0}, 532_nm);
    const Grid output{500, 400, 8_um, 8_um, 10_um, 0};
    PropagateOptions options;
    options.output = output;
    Field propagated({output, 532_nm});
    for (auto& sample : propagated.samples.elements()) sample = 7;
    hogel::propagate(field, 1_mm, propagated, options);
    EXPECT_EQ(propagated.samples(0, 0), 0.0f);
    EXPECT_EQ(propagated.samples(200, 499), 0.0f);
    EXPECT_EQ(propagated.samples(399, 250), 0.0f);
    EXPECT_LT(difference(propagate_to(field, 1_mm, part(output, {200, 150, 100, 100})), propagated), 1e-3);
    // Samples of 8 um are finer than the interference of light of a field of 64 um.
    EXPECT_NEAR(energy(propagated) / energy(field), 1, 1e-2);
    // The output is outside the cone on one side, and so far away that whole tiles are dark.
    Grid aside = output;
    aside.center_x = 2_mm;
    EXPECT_LT(difference(propagate_to(field, 1_mm, part(aside, {0, 150, 40, 100})), propagate_to(field, 1_mm, aside)),
              1e-3);
    options.output = Grid{4001, 2, 1_mm, 8_um, 0, 0};
    EXPECT_LT(propagation_method(field.grid(), 1_mm, options).bytes, 1e6);
}

TEST(Propagate, by_nothing_is_the_same_field_or_its_interpolation) {
    const Grid plane{64, 50, 1_um, 1_um, 0, 0};
    const Field field = noise(plane, 532_nm);
    const Field same = hogel::propagate(field, 0);
    EXPECT_TRUE(std::ranges::equal(same.samples.elements(), field.samples.elements()));
    Grid inner = part(plane, {10, 10, 40, 30});
    EXPECT_LT(difference(propagate_to(field, 0, inner), field), 1e-3);
}

TEST(Propagate, is_the_same_for_any_number_of_threads_and_in_a_file) {
    const Grid plane{150, 130, 1_um, 1_um, 0, 0};
    const Field field = noise(plane, 532_nm);
    const auto run = [&](const ScratchOptions& scratch) {
        PropagateOptions options;
        options.scratch = scratch;
        options.output = Grid{200, 160, 3_um, 1_um, 0.1_mm, 0};
        return hogel::propagate(field, 7_mm, options);
    };
    const Field all = run({}), in_file = run({0, ::testing::TempDir()});
    const ThreadLimit one(1);
    const Field alone = run({});
    EXPECT_TRUE(std::ranges::equal(all.samples.elements(), alone.samples.elements()));
    EXPECT_TRUE(std::ranges::equal(all.samples.elements(), in_file.samples.elements()));
}

// A sink that fails after some writes, and already has some regions.
class Interrupted final : public FieldSink {
  public:
    Interrupted(Field& field, std::vector<Region>& had, std::size_t writes)
        : field_(field), had_(had), before_(had), writes_(writes) {}
    void write(const Region& region, View<const std::complex<float>, 2> values) override {
        const std::lock_guard lock(mutex_);
        EXPECT_EQ(std::ranges::find(before_, region), before_.end()) << "is written again";
        if (written_ == writes_) throw Error(ErrorCode::cancelled, "stopped");
        ++written_;
        field_.write(region, values);
        had_.push_back(region);
    }
    bool has_already(const Region& region) override { return std::ranges::find(before_, region) != before_.end(); }

  private:
    std::mutex mutex_;
    Field& field_;
    std::vector<Region>& had_;
    std::vector<Region> before_;
    std::size_t writes_, written_ = 0;
};

TEST(Propagate, goes_on_where_a_sink_was_interrupted) {
    const Grid plane{64, 60, 4_um, 4_um, 0, 0};
    const Field field = packets(plane, 633_nm);
    PropagateOptions options;
    options.output = Grid{300, 300, 0.2_mm, 0.2_mm, 3_mm, 0};
    ASSERT_GT(propagation_method(field.grid(), 1_m, options).tiles_x, 1u);
    const Field expected = hogel::propagate(field, 1_m, options);
    Field result(expected.grid());
    std::vector<Region> had;
    const auto run = [&](const FieldSource& source, std::size_t writes) {
        Interrupted sink(result, had, writes);
        hogel::propagate(source, 1_m, sink, options);
    };
    for (std::size_t before = 0; before < 30; before += 10) {
        EXPECT_THROW(run(field, 10), Error);
        EXPECT_GE(had.size(), before + 10);
    }
    run(field, SIZE_MAX);
    EXPECT_TRUE(std::ranges::equal(result.samples.elements(), expected.samples.elements()));
    // Complete regions are not computed again: the field cannot be read.
    class Unreadable final : public FieldSource {
      public:
        explicit Unreadable(const FieldGrid& grid) : grid_(grid) {}
        const FieldGrid& grid() const override { return grid_; }
        void read(const Region&, std::size_t, View<std::complex<float>, 2>) const override { FAIL(); }

      private:
        FieldGrid grid_;
    };
    run(Unreadable(field.grid()), 0);
}

TEST(Propagate, goes_on_beside_the_cone_of_light) {
    const Field field = packets({32, 30, 1_um, 1_um, 0, 0}, 532_nm);
    PropagateOptions options;
    options.output = Grid{500, 400, 8_um, 8_um, 0.3_mm, 0};
    const Field expected = hogel::propagate(field, 1_mm, options);
    Field result(expected.grid());
    std::vector<Region> had;
    for (const std::size_t writes : {std::size_t{2}, SIZE_MAX}) {
        Interrupted sink(result, had, writes);
        try {
            hogel::propagate(field, 1_mm, sink, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cancelled);
        }
    }
    EXPECT_TRUE(std::ranges::equal(result.samples.elements(), expected.samples.elements()));
    std::size_t samples = 0;
    for (const Region& region : had) samples += region.samples();
    EXPECT_EQ(samples, expected.samples.size());
}

TEST(Propagate, says_how_it_will) {
    const FieldGrid field{{512, 512, 1_um, 1_um, 0, 0}, 532_nm};
    EXPECT_EQ(propagation_method(field, 0).name, "identity");
    EXPECT_EQ(propagation_method(field, 1_mm).name, "fft");
    const PropagationMethod far = propagation_method(field, 1_m);
    EXPECT_EQ(far.name, "chirp-z");
    EXPECT_NEAR(far.fresnel_number, 0.256e-3 * 0.256e-3 / 532e-9, 1e-9);
    EXPECT_LT(far.error, 1e-3);
    EXPECT_LT(far.frequencies_x, 200u);
    EXPECT_LT(far.bytes, propagation_method(field, 1_mm).bytes);
}

TEST(Propagate, refuses_what_it_cannot_do) {
    const Field field({{64, 64, 1_um, 1_um, 0, 0}, 532_nm});
    const auto message = [&](double z, const Grid& output) -> std::string {
        try {
            propagate_to(field, z, output);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message(1_mm, {64, 64, 1_um, 1_um, 1_mm, 0}).find("no light reaches the output"), std::string::npos);
    // No sample of the output is in the cone, although its rectangle covers it.
    EXPECT_NE(message(1_mm, {2, 1, 1_m, 1_um, 0, 0}).find("no light reaches the output"), std::string::npos);
    EXPECT_NE(message(std::nan(""), field.grid().plane).find("finite"), std::string::npos);
    EXPECT_NE(message(1_m, {0, 64, 1_um, 1_um, 0, 0}), "");
    EXPECT_NE(message(1_m, {64, 64, 1_um, 1_um, std::nan(""), 0}), "");
    PropagateOptions strict;
    strict.max_error = 1e-9;
    EXPECT_THROW(hogel::propagate(field, 1_mm, strict), Error);
    PropagateOptions small;
    small.scratch = {100, {}};
    EXPECT_THROW(hogel::propagate(field, 1_mm, small), Error);
    // Noise on samples much finer than the wavelength: light nearly parallel to the plane.
    const Field fine = noise({64, 64, 0.1_um, 0.1_um, 0, 0}, 532_nm);
    EXPECT_THROW(hogel::propagate(fine, 0.05_um), Error);
    PropagateOptions any;
    any.max_error = std::numeric_limits<double>::infinity();
    EXPECT_NO_THROW(hogel::propagate(fine, 0.05_um, any));
    const Field dark(fine.grid());
    EXPECT_NO_THROW(hogel::propagate(dark, 0.05_um));
    EXPECT_NO_THROW(hogel::propagate(dark, 0.05_um, any));
}

}  // namespace
}  // namespace hogel::optics::propagation
