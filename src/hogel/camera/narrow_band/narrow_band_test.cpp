// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/narrow_band/narrow_band.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numbers>

#include "hogel/camera/narrow_band/kernels.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::camera::narrow_band {
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

// Demodulation turns a wave that converges on the viewpoint into a constant, which the low-pass preserves, for
// viewpoints that share the pass down the columns and for one that does not.
TEST(NarrowBand, a_wave_converging_on_the_eye_becomes_one) {
    const std::array eyes{Vec3{0, 0, 0.1}, Vec3{8e-3, 0, 0.1}, Vec3{-8e-3, 0, 0.1}, Vec3{5e-3, 30e-3, 0.08}};
    std::vector<NarrowBand> bands;
    for (const Vec3& eye : eyes) bands.emplace_back(grid, eye, 3_mm);
    for (std::size_t e = 0; e < eyes.size(); ++e) {
        const auto drawn = compute_narrow_bands(converging(grid, eyes[e]), bands, 0, 1);
        EXPECT_LT(deviation(bands[e], drawn[e][0]), 5e-4) << e;
    }
}

TEST(NarrowBand, is_the_same_for_any_number_of_threads) {
    const Field field = converging(grid, {1e-3, 2e-3, 0.09});
    const NarrowBand band(grid, {0, 0, 0.1}, 3_mm);
    const auto all = compute_narrow_bands(field, std::span(&band, 1), 0, 1);
    const ThreadLimit one(1);
    const auto alone = compute_narrow_bands(field, std::span(&band, 1), 0, 1);
    EXPECT_TRUE(std::ranges::equal(all[0][0].elements(), alone[0][0].elements()));
}

// A wave that converges on a viewpoint, computed on demand. It counts the samples of the hogels that are read.
class Hogels final : public FieldSource {
  public:
    Hogels(std::size_t side, std::size_t alignment, Vec3 eye) : alignment_(alignment), eye_(eye) {
        grid_ = {{side, side, 1_um, 1_um, 0, 0}, 633_nm};
    }
    const FieldGrid& grid() const override { return grid_; }
    std::size_t alignment() const override { return alignment_; }
    void read(const Region& region, std::size_t, View<std::complex<float>, 2> out) const override {
        const auto whole = [&](std::size_t first, std::size_t count) {
            return (first + count + alignment_ - 1) / alignment_ * alignment_ - first / alignment_ * alignment_;
        };
        made_ += whole(region.x0, region.width) * whole(region.y0, region.height);
        for (std::size_t y = 0; y < region.height; ++y) {
            const double dy = grid_.plane.y(double(region.y0 + y)) - eye_.y;
            path_phases({grid_.plane.x(double(region.x0)) - eye_.x, grid_.plane.pitch_x, dy * dy + eye_.z * eye_.z,
                         grid_.wavelength, 0},
                        out[y].elements());
            for (std::complex<float>& value : out[y].elements()) value = std::conj(value);
        }
    }
    double times_made() const { return double(made_) / double(grid_.plane.samples()); }

  private:
    FieldGrid grid_;
    std::size_t alignment_;
    Vec3 eye_;
    mutable std::atomic<std::size_t> made_ = 0;
};

// Tiles of 512 x 384 samples alone would make hogels of 250 samples 2.5 times.
TEST(NarrowBand, of_a_large_hologram_makes_most_hogels_once) {
    const Vec3 eye{1_mm, 0, 0.1};
    const Hogels hogels(9000, 250, eye), samples(9000, 1, eye);
    const NarrowBand band(hogels.grid(), eye, 3_mm);
    const auto drawn = compute_narrow_bands(hogels, std::span(&band, 1), 0, 1);
    EXPECT_LT(deviation(band, drawn[0][0]), 5e-4);
    EXPECT_LT(hogels.times_made(), 1.7);
    const auto of_samples = compute_narrow_bands(samples, std::span(&band, 1), 0, 1);
    EXPECT_EQ(samples.times_made(), 1);
    EXPECT_TRUE(std::ranges::equal(drawn[0][0].elements(), of_samples[0][0].elements()));
}

}  // namespace
}  // namespace hogel::camera::narrow_band
