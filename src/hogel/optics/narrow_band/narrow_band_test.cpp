// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/narrow_band/narrow_band.h"

#include <gtest/gtest.h>

#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/units.h"

namespace hogel::optics::narrow_band {
namespace {

using namespace literals;

// A wave that converges on a point of the lens plane.
Field converging(const FieldGrid& grid, Vec3 to) {
    Field field(grid);
    const ViewGeometry geometry(to, grid.wavelength);
    for (std::size_t y = 0; y < grid.plane.height; ++y)
        for (std::size_t x = 0; x < grid.plane.width; ++x) {
            const double cycles = geometry.cycles(grid.plane.x(double(x)), grid.plane.y(double(y)));
            field.samples(y, x) =
                std::complex<float>(std::polar(1.0, -2 * std::numbers::pi * std::remainder(cycles, 1.0)));
        }
    return field;
}

const FieldGrid grid{{1100, 900, 2_um, 2_um, 0.3_mm, -0.2_mm}, 633_nm};

// The largest |G − 1| where the kernel is within the hologram.
double deviation(const NarrowBand& band, const Array<std::complex<float>, 2>& samples) {
    double worst = 0;
    for (std::size_t m = 2 * NarrowBand::margin; m + 2 * NarrowBand::margin < band.plane.height; ++m)
        for (std::size_t n = 2 * NarrowBand::margin; n + 2 * NarrowBand::margin < band.plane.width; ++n)
            worst = std::max(worst, double(std::abs(samples(m, n) - 1.0f)));
    return worst;
}

// Demodulation turns a wave that converges on the eye into a constant, which the low-pass keeps, both for eyes that
// share the pass down the columns and for one that does not.
TEST(NarrowBand, a_wave_converging_on_the_eye_becomes_one) {
    const std::array eyes{Vec3{0, 0, 0.1}, Vec3{8e-3, 0, 0.1}, Vec3{-8e-3, 0, 0.1}, Vec3{5e-3, 30e-3, 0.08}};
    std::vector<NarrowBand> bands;
    for (const Vec3& eye : eyes) bands.emplace_back(grid, eye, 3_mm);
    for (std::size_t e = 0; e < eyes.size(); ++e) {
        const auto drawn = draw_narrow_bands(converging(grid, eyes[e]), bands, 0, 1);
        EXPECT_LT(deviation(bands[e], drawn[e][0]), 5e-4) << e;
    }
}

TEST(NarrowBand, is_the_same_for_any_number_of_threads) {
    const Field field = converging(grid, {1e-3, 2e-3, 0.09});
    const NarrowBand band(grid, {0, 0, 0.1}, 3_mm);
    const auto all = draw_narrow_bands(field, std::span(&band, 1), 0, 1);
    const ThreadLimit one(1);
    const auto alone = draw_narrow_bands(field, std::span(&band, 1), 0, 1);
    EXPECT_TRUE(std::ranges::equal(all[0][0].elements(), alone[0][0].elements()));
}

}  // namespace
}  // namespace hogel::optics::narrow_band
