// SPDX-License-Identifier: Apache-2.0
#include "hogel/field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <mutex>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::optics {
namespace {

using namespace literals;

FieldGrid plane_of(std::size_t width, std::size_t height) {
    FieldGrid grid;
    grid.plane = {width, height, 1_um, 2_um, 3_mm, -1_mm};
    grid.wavelength = 633_nm;
    return grid;
}

Field numbered(const FieldGrid& grid) {
    Field field(grid);
    for (std::size_t y = 0; y < grid.plane.height; ++y)
        for (std::size_t x = 0; x < grid.plane.width; ++x)
            field.samples(y, x) = {static_cast<float>(x) + 1, static_cast<float>(y) + 1};
    return field;
}

TEST(FieldGrid, coordinates_are_those_of_the_notation) {
    const Grid plane = plane_of(4, 3).plane;
    EXPECT_DOUBLE_EQ(plane.x(0), 3_mm - 1.5_um);
    EXPECT_DOUBLE_EQ(plane.x(3), 3_mm + 1.5_um);
    EXPECT_DOUBLE_EQ(plane.y(0), -1_mm + 2_um);
    EXPECT_DOUBLE_EQ(plane.y(2), -1_mm - 2_um);
    EXPECT_NEAR(plane.column(plane.x(2)), 2, 1e-9);
    EXPECT_NEAR(plane.row(plane.y(1)), 1, 1e-9);
}

TEST(Field, regions_read_and_write_their_slices) {
    const FieldGrid grid = plane_of(7, 5);
    const Field field = numbered(grid);
    for (std::size_t y0 = 0; y0 < 5; ++y0)
        for (std::size_t x0 = 0; x0 < 7; ++x0)
            for (std::size_t h = 1; h <= 5 - y0; ++h)
                for (std::size_t w = 1; w <= 7 - x0; ++w) {
                    Array<std::complex<float>, 2> values({h, w});
                    field.read({x0, y0, w, h}, 0, values);
                    Field back(grid);
                    back.write({x0, y0, w, h}, values);
                    for (std::size_t y = 0; y < 5; ++y)
                        for (std::size_t x = 0; x < 7; ++x) {
                            const bool inside = y >= y0 && y < y0 + h && x >= x0 && x < x0 + w;
                            const std::complex<float> want = inside ? field.samples(y, x) : 0;
                            ASSERT_EQ(back.samples(y, x), want);
                            if (inside) {
                                ASSERT_EQ(values(y - y0, x - x0), field.samples(y, x));
                            }
                        }
                }
}

// A source whose alignment does not divide the default region. Checks that regions are aligned.
class Aligned final : public FieldSource {
  public:
    Aligned(const Field& field, std::size_t alignment) : field_(field), alignment_(alignment) {}
    const FieldGrid& grid() const override { return field_.grid(); }
    std::size_t alignment() const override { return alignment_; }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        EXPECT_EQ(region.x0 % alignment_, 0u);
        EXPECT_EQ(region.y0 % alignment_, 0u);
        field_.read(region, look, out);
    }

  private:
    const Field& field_;
    std::size_t alignment_;
};

// A sink without in_memory().
class Written final : public FieldSink {
  public:
    explicit Written(Field& field) : field_(field) {}
    void write(const Region& region, View<const std::complex<float>, 2> values) override {
        field_.write(region, values);
    }

  private:
    Field& field_;
};

TEST(Field, copy_carries_every_sample_in_aligned_regions) {
    const Field from = numbered(plane_of(2311, 1301));
    for (std::size_t alignment : {1, 7, 62, 1000, 1500, 100000}) {
        Field to(from.grid());
        double last = -1;
        copy(Aligned(from, alignment), to, 0, [&](double fraction) {
            EXPECT_GT(fraction, last);
            last = fraction;
            return true;
        });
        EXPECT_EQ(last, 1);
        EXPECT_TRUE(std::ranges::equal(to.samples.elements(), from.samples.elements())) << alignment;
        Field written(from.grid());
        Written sink(written);
        copy(Aligned(from, alignment), sink);
        EXPECT_TRUE(std::ranges::equal(written.samples.elements(), from.samples.elements())) << alignment;
    }
}

// A source with overlapping windows.
class Overlapping final : public FieldSource {
  public:
    Overlapping(const Field& field, std::size_t overlap) : field_(field), overlap_(overlap) {}
    const FieldGrid& grid() const override { return field_.grid(); }
    std::size_t alignment() const override { return 100; }
    std::size_t overlap() const override { return overlap_; }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        field_.read(region, look, out);
    }

  private:
    const Field& field_;
    std::size_t overlap_;
};

TEST(Field, copy_writes_long_rows_or_squares_of_what_overlaps) {
    class Shapes final : public FieldSink {
      public:
        void write(const Region& region, View<const std::complex<float>, 2>) override {
            const std::lock_guard lock(mutex_);
            samples += region.samples();
            widest = std::max(widest, region.width);
            highest = std::max(highest, region.height);
        }
        std::size_t samples = 0, widest = 0, highest = 0;

      private:
        std::mutex mutex_;
    };
    const Field from(plane_of(3000, 1700));
    Shapes rows, squares;
    copy(Overlapping(from, 0), rows);
    copy(Overlapping(from, 100), squares);
    EXPECT_EQ(rows.samples, from.samples.size());
    EXPECT_EQ(rows.widest, 3000u);
    EXPECT_EQ(rows.highest, 100u);
    EXPECT_EQ(squares.samples, from.samples.size());
    EXPECT_EQ(squares.widest, 1000u);
    EXPECT_EQ(squares.highest, 1000u);
}

TEST(Field, refuses_regions_outside_and_arrays_of_another_shape_and_looks_beyond_the_first) {
    Field field(plane_of(7, 5));
    Array<std::complex<float>, 2> values({2, 2});
    constexpr std::size_t huge = std::numeric_limits<std::size_t>::max();
    for (const Region region : {Region{6, 0, 2, 2}, Region{0, 4, 2, 2}, Region{7, 0, 2, 2}, Region{huge, 0, 2, 2},
                                Region{0, 0, 0, 0}, Region{0, 0, 2, 1}, Region{0, 0, 1, 2}}) {
        EXPECT_THROW(field.read(region, 0, values), Error);
        EXPECT_THROW(field.write(region, values), Error);
    }
    EXPECT_THROW(field.read({0, 0, 2, 2}, 1, values), Error);
}

TEST(FieldGrid, validate_names_the_wrong_member) {
    const auto message = [](auto change) -> std::string {
        FieldGrid g = plane_of(4, 3);
        change(g);
        try {
            validate(g, ErrorCode::bad_input, "f.h5");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            return error.what();
        }
        return "";
    };
    using G = FieldGrid;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(message([](G&) {}), "");
    EXPECT_NE(message([](G& g) { g.plane.width = 0; }).find("f.h5: 0x3"), std::string::npos);
    for (double bad : {nan, infinite, 0.0, -1e-6}) {
        EXPECT_NE(message([=](G& g) { g.wavelength = bad; }).find("wavelength"), std::string::npos);
        EXPECT_NE(message([=](G& g) { g.plane.pitch_x = bad; }).find("pitch in x"), std::string::npos);
        EXPECT_NE(message([=](G& g) { g.plane.pitch_y = bad; }).find("pitch in y"), std::string::npos);
    }
    EXPECT_EQ(message([](G& g) { g.wavelength = 0.1e-3; }), "");
    EXPECT_NE(message([](G& g) { g.wavelength = 633; }).find("633*nm"), std::string::npos);
    EXPECT_NE(message([](G& g) { g.plane.center_y = nan; }).find("centre"), std::string::npos);
    const std::size_t big = std::size_t{1} << 32;
    EXPECT_NE(message([=](G& g) { g.plane.width = g.plane.height = big; }).find("addressed"), std::string::npos);
}

}  // namespace
}  // namespace hogel::optics
