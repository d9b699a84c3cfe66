// SPDX-License-Identifier: Apache-2.0
// Objects of many kinds at known depths. Their holograms are computed by plane waves in double precision.
#include "hogel/focus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>

#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/reconstruct.h"
#include "hogel/units.h"

namespace hogel {
namespace {

using namespace literals;
using Complex = std::complex<float>;
using std::numbers::pi;

// Multiplies each frequency of a field, cycles per sample, by a factor.
void filter(Field& field, const std::function<std::complex<double>(double fx, double fy)>& factor) {
    const std::size_t width = field.grid().plane.width, height = field.grid().plane.height;
    const math::Fft2 fft(height, width);
    fft.forward(field.samples);
    const auto frequency = [](std::size_t i, std::size_t n) {
        return (double(i) - (2 * i < n ? 0 : double(n))) / double(n);
    };
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            field.samples(y, x) *=
                Complex(factor(frequency(x, width), frequency(y, height))) / static_cast<float>(width * height);
    fft.backward(field.samples);
}

enum class Surface { smooth, rough };

struct Case {
    FieldGrid grid;
    double depths = 0;  // depth of the object, in depths of focus of the samples
    Surface surface = Surface::smooth;
    double band = 1;  // bandwidth of the object's light, relative to the samples
    unsigned seed = 1;

    double depth_of_focus() const { return 2 * grid.plane.pitch_x * grid.plane.pitch_x / grid.wavelength; }
    double depth() const { return depths * depth_of_focus(); }
};

// Discs of different brightness in the middle of the hologram, with a constant or random phase.
Field object_of(const Case& test_case) {
    Field field(test_case.grid);
    const Grid& plane = test_case.grid.plane;
    std::mt19937 random(test_case.seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const double side = 0.6 * double(std::min(plane.width, plane.height));
    std::vector<double> light(plane.samples(), 0.0);
    for (int disc = 0; disc < 14; ++disc) {
        const double x0 = double(plane.width) / 2 + side * (unit(random) - 0.5),
                     y0 = double(plane.height) / 2 + side * (unit(random) - 0.5), radius = 3 + 9 * unit(random),
                     value = 0.3 + 0.7 * unit(random);
        for (std::size_t y = 0; y < plane.height; ++y)
            for (std::size_t x = 0; x < plane.width; ++x)
                if (std::hypot(double(x) - x0, double(y) - y0) < radius) light[y * plane.width + x] = value;
    }
    for (std::size_t i = 0; i < light.size(); ++i)
        field.samples.data()[i] =
            Complex(std::polar(std::sqrt(light[i]), test_case.surface == Surface::rough ? 2 * pi * unit(random) : 0.0));
    filter(field, [&](double fx, double fy) {
        return std::max(std::abs(fx), std::abs(fy)) <= 0.5 * test_case.band ? 1.0 : 0.0;
    });
    return field;
}

// Propagates the object's light forward to the hologram.
Field hologram_of(const Case& test_case) {
    Field field = object_of(test_case);
    filter(field, [&](double fx, double fy) {
        const double square = (fx * fx + fy * fy) / std::pow(test_case.grid.plane.pitch_x, 2),
                     inverse = 1 / test_case.grid.wavelength;
        return std::polar(
            1.0, 2 * pi * test_case.depth() * (std::sqrt(std::max(0.0, inverse * inverse - square)) - inverse));
    });
    return field;
}

FieldGrid grid_of(std::size_t width, std::size_t height, double pitch, double wavelength) {
    return {{width, height, pitch, pitch, 0, 0}, wavelength};
}

FocusSearch search_near(const Fields& fields, const Case& test_case, double around = 60) {
    FocusOptions options;
    options.from = test_case.depth() - around * test_case.depth_of_focus() * 1.013;
    options.to = test_case.depth() + around * test_case.depth_of_focus();
    return find_focus(fields, options);
}

// Returns the error of the clearest plane, in depths of focus of the object's light.
double error_of(const FocusSearch& search, const Case& test_case) {
    if (search.planes.empty()) return std::numeric_limits<double>::infinity();
    return (search.planes.front().depth - test_case.depth()) / test_case.depth_of_focus() * test_case.band *
           test_case.band;
}

// The combinations of cases differ from those with which the thresholds were tuned.
TEST(Planes, of_smooth_and_rough_objects_are_found_within_a_depth_of_focus) {
    const FieldGrid grids[] = {grid_of(180, 224, 5_um, 450_nm), grid_of(240, 192, 10.8_um, 1064_nm),
                               grid_of(144, 150, 2_um, 633_nm)};
    double depths = 21.7;
    unsigned seed = 7;
    for (const FieldGrid& grid : grids)
        for (const Surface surface : {Surface::smooth, Surface::rough})
            for (const double band : {1.0, 0.6, 0.35}) {
                depths = depths > 0 ? -depths - 1.3 : -depths;
                const Case test_case{grid, depths / (band * band), surface, band, seed++};
                const FocusSearch search =
                    search_near({std::make_shared<Field>(hologram_of(test_case))}, test_case, 14 / (band * band));
                EXPECT_LT(std::abs(error_of(search, test_case)), 1)
                    << (surface == Surface::smooth ? "smooth" : "rough") << " at " << test_case.depth() << ", band "
                    << band << ", seed " << test_case.seed;
                // Nine tenths of the amplitudes are in less than the band, and there is no light outside the band.
                EXPECT_GT(search.light_depth_of_focus * band * band, search.depth_of_focus);
                EXPECT_LT(search.light_depth_of_focus * band * band, 2.5 * search.depth_of_focus);
            }
}

// Without a range, searches up to the depths at which pitch and size limit the resolution equally, on both sides.
TEST(Planes, of_unknown_depth_are_found) {
    for (const Surface surface : {Surface::smooth, Surface::rough})
        for (const double depths : {23.6, -31.1}) {
            const Case test_case{grid_of(160, 160, 6_um, 520_nm), depths, surface, 0.8, 3};
            EXPECT_LT(std::abs(error_of(find_focus(hologram_of(test_case)), test_case)), 1) << depths;
        }
}

// Beyond this range the depth of focus grows. No plane in the first range is as clear as the object.
TEST(Planes, beyond_the_first_range_are_found) {
    const Grid window{128, 128, 4_um, 4_um, 0, 0};
    const double first = 128 * 4e-6 * 4e-6 / 532e-9;
    for (const Surface surface : {Surface::smooth, Surface::rough})
        for (const double depth : {1.6 * first, -3.1 * first}) {
            // A wide plane; the hologram records the central part of its light.
            Case test_case{grid_of(256, 256, 4_um, 532_nm), 0, surface, 0.4, 6};
            test_case.depths = depth / test_case.depth_of_focus();
            const Field wide = hologram_of(test_case);
            Field field({window, 532_nm});
            wide.read({64, 64, 128, 128}, 0, field.samples);
            const FocusSearch search = find_focus(field);
            ASSERT_FALSE(search.planes.empty()) << depth;
            EXPECT_GT(search.planes.front().prominence, 1) << depth;
            // The recorded part of the light is in focus over a tenth of the depth.
            EXPECT_NEAR(search.planes.front().depth, depth, 0.15 * std::abs(depth));
            EXPECT_GT(search.depths.back(), std::abs(depth));
        }
}

// The selected order of an off-axis recording has few frequencies.
TEST(Planes, of_off_axis_recordings_are_found) {
    const double frequency = 0.31;
    for (const Surface surface : {Surface::smooth, Surface::rough})
        for (const double depths : {81.0, -104.0}) {
            const Case test_case{grid_of(360, 320, 4_um, 633_nm), depths, surface, 0.3, 5};
            Field field = hologram_of(test_case);
            for (std::size_t i = 0; i < field.samples.size(); ++i) {
                const double x = double(i % field.grid().plane.width);
                const double light = std::norm(std::complex<double>(field.samples.data()[i]) * 0.2 +
                                               std::polar(1.0, -2 * pi * frequency * x));
                field.samples.data()[i] = Complex(float(light));
            }
            OrderSelection selection;
            selection.without_mean = true;
            selection.which = OrderSelection::Which::right;
            const SelectedOrder order = select_order(field, selection);
            EXPECT_LT(std::abs(error_of(find_focus(order.field, {.from = -10_mm, .to = 10_mm}), test_case)), 1)
                << depths;
        }
}

// The twin image of an in-line recording is at the same distance on the other side.
TEST(Planes, of_in_line_recordings_are_found_on_either_side) {
    const Case test_case{grid_of(224, 224, 3.45_um, 532_nm), 33.3, Surface::smooth, 1, 9};
    Field field = hologram_of(test_case);
    double mean = 0;
    for (Complex& sample : field.samples.elements()) {
        sample = Complex(std::norm(1.0f - 0.4f * sample));
        mean += double(sample.real()) / double(field.samples.size());
    }
    for (Complex& sample : field.samples.elements()) sample -= Complex(float(mean));
    const FocusSearch search = find_focus(field);
    ASSERT_FALSE(search.planes.empty());
    EXPECT_NEAR(std::abs(search.planes.front().depth), test_case.depth(), test_case.depth_of_focus());
}

// Combines the colours of one object, each with its own sampling. A colour without content does no harm.
TEST(Planes, of_several_colours_are_those_of_one_object) {
    for (const Surface surface : {Surface::smooth, Surface::rough}) {
        const double depth = 2.1_mm;
        Fields fields;
        Case middle;
        for (const auto& [wavelength, pitch] :
             {std::pair(638_nm, 5_um), std::pair(520_nm, 4.5_um), std::pair(450_nm, 4_um)}) {
            middle = {grid_of(160, 160, pitch, wavelength), depth * wavelength / (2 * pitch * pitch), surface, 1, 4};
            fields.push_back(std::make_shared<Field>(hologram_of(middle)));
        }
        FocusSearch search = search_near(fields, middle, 20);
        EXPECT_LT(std::abs(error_of(search, middle)), 1);
        EXPECT_NEAR(search.depth_of_focus, 2 * 4e-6 * 4e-6 / 450e-9, 1e-9);
        fields.push_back(std::make_shared<Field>(middle.grid));
        search = search_near(fields, middle, 20);
        EXPECT_LT(std::abs(error_of(search, middle)), 1);
    }
    EXPECT_THROW(find_focus(Fields{}), Error);
}

// A region wider than max_side is searched in parts that cover exactly the region.
TEST(Planes, are_found_in_parts_of_a_field) {
    const Case test_case{grid_of(300, 260, 4_um, 532_nm), 9.4, Surface::smooth, 1, 2};
    const Field field = hologram_of(test_case);
    FocusOptions options;
    options.from = -2 * test_case.depth();
    options.to = 3 * test_case.depth();
    options.max_side = 128;
    EXPECT_EQ(focus_region(field.grid(), options), (Region{86, 66, 128, 128}));
    options.width = 999;
    options.height = 260;
    EXPECT_EQ(focus_region(field.grid(), options), (Region{0, 0, 300, 260}));
    const FocusSearch parts = find_focus(field, options);
    EXPECT_LT(std::abs(error_of(parts, test_case)), 1);
    // At depth 0 the contrast of one-sample squares is that of the field itself.
    options.from = 0;
    options.to = 1_um;
    options.planes = 8;
    double light = 0, squares = 0;
    for (const Complex& sample : field.samples.elements()) {
        light += double(std::norm(sample));
        squares += std::pow(double(std::norm(sample)), 2);
    }
    EXPECT_NEAR(find_focus(field, options).contrasts.front()[0],
                squares * double(field.samples.size()) / (light * light) - 1, 1e-4);
}

}  // namespace
}  // namespace hogel
