// SPDX-License-Identifier: Apache-2.0
#include "hogel/reconstruct.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/focus.h"
#include "hogel/propagate.h"
#include "hogel/units.h"

namespace hogel {
namespace {

using namespace literals;
using Complex = std::complex<float>;
using std::numbers::pi;

double x_of(const Grid& plane, std::size_t column) {
    return (double(column) + 0.5 - double(plane.width) / 2) * plane.pitch_x;
}
double y_of(const Grid& plane, std::size_t row) {
    return (double(plane.height) / 2 - double(row) - 0.5) * plane.pitch_y;
}

template <class F>
Field made(const Grid& plane, double wavelength, const F& value) {
    Field field({plane, wavelength});
    for (std::size_t row = 0; row < plane.height; ++row)
        for (std::size_t column = 0; column < plane.width; ++column)
            field.samples(row, column) = Complex(value(x_of(plane, column), y_of(plane, row)));
    return field;
}

double energy(const Field& field) {
    double sum = 0;
    for (const Complex& sample : field.samples.elements()) sum += std::norm(sample);
    return sum * field.grid().plane.pitch_x * field.grid().plane.pitch_y;
}

// |⟨a, b⟩|² / (⟨a, a⟩⟨b, b⟩)
double likeness(const Field& a, const Field& b) {
    std::complex<double> product = 0;
    double aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
        const std::complex<double> x = a.samples.data()[i], y = b.samples.data()[i];
        product += x * std::conj(y);
        aa += std::norm(x);
        bb += std::norm(y);
    }
    return std::norm(product) / (aa * bb);
}

// The transform of a Gaussian is one, beside the axis where the input is tilted; energy stays.
TEST(Reconstruction, behind_a_lens_is_the_fourier_transform) {
    const double wavelength = 532_nm, focal = 200_mm, waist = 100_um, pitch = 5_um;
    const double fx = 0.11 / pitch, fy = -0.07 / pitch;
    const Field in = made({256, 200, pitch, pitch, 0, 0}, wavelength, [&](double x, double y) {
        return std::exp(-(x * x + y * y) / (waist * waist)) * std::polar(1.0, 2 * pi * (fx * x + fy * y));
    });
    const Field out = fourier_image(in, focal);
    EXPECT_NEAR(out.grid().plane.pitch_x, wavelength * focal / (256 * pitch), 1e-12);
    EXPECT_NEAR(out.grid().plane.pitch_y, wavelength * focal / (200 * pitch), 1e-12);
    EXPECT_NEAR(energy(out) / energy(in), 1, 1e-5);
    const double width = wavelength * focal / (pi * waist), peak = pi * waist * waist / (wavelength * focal);
    const Field expected = made(out.grid().plane, wavelength, [&](double x, double y) {
        const double dx = x - wavelength * focal * fx, dy = y - wavelength * focal * fy;
        return std::complex<double>(0, -peak) * std::exp(-(dx * dx + dy * dy) / (width * width));
    });
    double worst = 0;
    for (std::size_t i = 0; i < out.samples.size(); ++i)
        worst = std::max(worst, double(std::abs(out.samples.data()[i] - expected.samples.data()[i])));
    EXPECT_LT(worst, 1e-3 * peak);
    EXPECT_THROW(fourier_image(in, 0), Error);
    EXPECT_THROW(fourier_image(in, -focal), Error);
}

// A single transform agrees with the angular spectrum where both are accurate, forwards and backwards.
TEST(Reconstruction, by_one_fresnel_transform_is_propagation) {
    const double wavelength = 532_nm, pitch = 8_um;
    const Field in = made({256, 256, pitch, pitch, 0, 0}, wavelength, [&](double x, double y) {
        return std::exp(-(std::pow((x - 100_um) / 150_um, 2) + std::pow((y + 60_um) / 200_um, 2)));
    });
    for (const double distance : {60_mm, -80_mm}) {
        const Field fast = fresnel_image(in, distance);
        EXPECT_NEAR(energy(fast) / energy(in), 1, 1e-5);
        PropagateOptions options;
        options.output = fast.grid().plane;
        const Field exact = propagate(in, distance, options);
        EXPECT_GT(likeness(fast, exact), 0.9999) << distance;
    }
}

// A recorded off-axis hologram: |O + R|² with a plane reference.
TEST(Orders, of_an_off_axis_hologram_are_found_and_hold_the_object) {
    const double wavelength = 633_nm, pitch = 4_um, z = 40_mm;
    const Grid plane{256, 256, pitch, pitch, 0, 0};
    const auto object = [&](double x, double y) {
        std::complex<double> sum = 0;
        for (const auto& [px, py] : {std::pair(100e-6, 40e-6), std::pair(-150e-6, -90e-6), std::pair(20e-6, 120e-6)})
            sum += std::polar(0.1, 2 * pi / wavelength * std::hypot(x - px, y - py, z));
        return sum * std::exp(-(x * x + y * y) / std::pow(300_um, 2));
    };
    const double fx = 0.27, fy = 0.2;  // of R*, cycles per sample
    const Field hologram = made(plane, wavelength, [&](double x, double y) {
        return std::norm(object(x, y) + std::polar(1.0, -2 * pi * (fx * x + fy * y) / pitch));
    });
    const Field wanted = made(plane, wavelength, object);
    OrderSelection selection;
    selection.without_mean = true;
    selection.which = OrderSelection::Which::right;
    const SelectedOrder found = select_order(hologram, selection);
    EXPECT_NEAR(found.frequency_x, fx, 0.03);
    EXPECT_NEAR(found.frequency_y, fy, 0.03);
    selection.which = OrderSelection::Which::at;
    selection.frequency_x = fx;
    selection.frequency_y = fy;
    // The carrier lies between frequencies of the transform, so a tilt of less than half a step remains.
    Field field = select_order(hologram, selection).field;
    const double rest_x = fx - std::round(fx * 256) / 256, rest_y = fy - std::round(fy * 256) / 256;
    for (std::size_t row = 0; row < 256; ++row)
        for (std::size_t column = 0; column < 256; ++column)
            field.samples(row, column) *=
                Complex(std::polar(1.0, -2 * pi * (rest_x * x_of(plane, column) + rest_y * y_of(plane, row)) / pitch));
    EXPECT_GT(likeness(field, wanted), 0.98);
    // The other order is the conjugate.
    selection.which = OrderSelection::Which::left;
    const SelectedOrder other = select_order(hologram, selection);
    EXPECT_NEAR(other.frequency_x, -found.frequency_x, 1e-9);
    EXPECT_LT(likeness(other.field, wanted), 0.3);
    selection.radius = 1e-3;
    EXPECT_THROW(select_order(hologram, selection), Error);
}

// With a spherical reference the object is where it was, not where a plane wave would show it.
TEST(Orders, with_a_spherical_reference_hold_the_object) {
    const double wavelength = 633_nm, pitch = 4_um;
    const Grid plane{256, 256, pitch, pitch, 0, 0};
    const Vec3 source{0.6e-3, 0, -9e-3}, point{-0.1e-3, 0.05e-3, -30e-3};
    const auto wave = [&](const Vec3& from, double x, double y) {
        return std::polar(1.0, 2 * pi / wavelength * std::hypot(x - from.x, y - from.y, from.z));
    };
    const Field hologram = made(
        plane, wavelength, [&](double x, double y) { return std::norm(0.2 * wave(point, x, y) + wave(source, x, y)); });
    OrderSelection selection;
    selection.without_mean = true;
    selection.reference_source = source;
    selection.radius = 0.15;
    const Field field = select_order(hologram, selection).field;
    const Field wanted = made(plane, wavelength, [&](double x, double y) { return wave(point, x, y); });
    EXPECT_GT(likeness(field, wanted), 0.8);
    selection.reference_source = Vec3{0, 0, 1e-3};
    EXPECT_LT(likeness(select_order(hologram, selection).field, wanted), 0.2);
    selection.reference_source = Vec3{0, 0, 0};
    EXPECT_THROW(select_order(hologram, selection), Error);
}

// Points at several depths, on both sides, are found within a depth of focus.
TEST(Focus, finds_the_planes_of_points) {
    const double wavelength = 532_nm, pitch = 5_um;
    const Grid plane{192, 192, pitch, pitch, 0, 0};
    for (const double depth : {3_mm, 5.7_mm, -4.1_mm}) {
        const Field field = made(plane, wavelength, [&](double x, double y) {
            const double k = 2 * pi / wavelength * (depth > 0 ? 1 : -1);
            return std::polar(1.0, k * std::hypot(x - 50e-6, y + 30e-6, depth)) +
                   std::polar(1.0, k * std::hypot(x + 130e-6, y + 90e-6, depth));
        });
        const FocusSearch search = find_focus(field);
        ASSERT_FALSE(search.planes.empty()) << depth;
        EXPECT_NEAR(search.planes.front().depth, depth, search.depth_of_focus);
        EXPECT_TRUE(search.planes.front().brightest);
    }
    const Field two = made(plane, wavelength, [&](double x, double y) {
        const double k = 2 * pi / wavelength;
        return std::polar(1.0, k * std::hypot(x - 150e-6, y, 2_mm)) +
               std::polar(1.0, k * std::hypot(x + 150e-6, y, 4_mm));
    });
    FocusOptions range;
    range.from = 1_mm;
    range.to = 5_mm;
    const FocusSearch search = find_focus(two, range);
    ASSERT_GE(search.planes.size(), 2u);
    const double a = search.planes[0].depth, b = search.planes[1].depth;
    EXPECT_NEAR(std::min(a, b), 2_mm, search.depth_of_focus);
    EXPECT_NEAR(std::max(a, b), 4_mm, search.depth_of_focus);
    range.planes = 3;
    EXPECT_THROW(find_focus(two, range), Error);
}

// A plane wave is uniform at every depth.
TEST(Focus, finds_nothing_where_nothing_is) {
    const Field field = made({128, 128, 5_um, 5_um, 0, 0}, 532_nm, [](double, double) { return 1.0; });
    EXPECT_TRUE(find_focus(field).planes.empty());
}

TEST(Focus, stops_on_request) {
    const Field field = made({256, 256, 5_um, 5_um, 0, 0}, 532_nm, [](double x, double) { return std::cos(1e5 * x); });
    std::stop_source stop;
    const Progress progress(stop.get_token(), [&](double) {
        stop.request_stop();
        return true;
    });
    EXPECT_THROW(find_focus(field, {}, progress), Error);
}

}  // namespace
}  // namespace hogel
