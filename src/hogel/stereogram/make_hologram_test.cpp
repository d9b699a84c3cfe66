// SPDX-License-Identifier: Apache-2.0
// Tests make_hologram(): tiling, shared ownership, errors, and the table of methods.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"

namespace hogel::stereogram {
namespace {

using namespace literals;
using Complex = std::complex<float>;

HologramOptions options_for(const HologramMethod& method, double pitch) {
    HologramOptions options;
    options.method = method;
    options.pitch = pitch;
    return options;
}

LightField row_of_directions(const Radiance& radiance) {
    const LightFieldGrid grid{6, 5, 36_um, 16, 1, Perspective{0.1, 0.1}, 1};
    return light_field_of_faces({&grid, 1}, radiance);
}

Array<Complex, 2> whole(const FieldSource& source) {
    const Grid& plane = source.grid().plane;
    Array<Complex, 2> field({plane.height, plane.width});
    source.read({0, 0, plane.width, plane.height}, 0, field);
    return field;
}

// Random phases depend on the position of a hogel and the number of a line, not on the region.
TEST(MakeHologram, hemicubes_and_lines_give_the_same_bytes_in_any_tiling) {
    const auto light = [](Vec3 hogel, Vec3 direction) { return 1 + 3000 * hogel.x + direction.x / length(direction); };
    const LightField cube = hemicube_of({6, 5, 36_um, 16, 16, Perspective{1, 1}, 1}, light);
    const LightField row = row_of_directions(light);
    for (const auto& source :
         {make_hologram(cube, options_for(Fourier{}, 0.36_um)), make_hologram(row, options_for(Lines{9_um}, 3_um))}) {
        const Grid& plane = source->grid().plane;
        const Array<Complex, 2> all = whole(*source);
        EXPECT_NE(all(0, 0), all(1, 0));
        for (const Region& region : {Region{7, 3, 50, 11}, Region{plane.width - 1, plane.height - 1, 1, 1}}) {
            Array<Complex, 2> part({region.height, region.width});
            source->read(region, 0, part);
            for (std::size_t y = 0; y < region.height; ++y)
                for (std::size_t x = 0; x < region.width; ++x)
                    ASSERT_EQ(part(y, x), all(region.y0 + y, region.x0 + x)) << x << " " << y;
        }
    }
}

// Light fields and holograms share ownership of their sources, so temporaries may be passed.
TEST(MakeHologram, a_photograph_may_be_taken_of_temporaries_alone) {
    const LightFieldGrid grid{8, 8, 64_um, 16, 16, Perspective{0.1, 0.1}, 1};
    const auto light = [](Vec3, Vec3) { return 0.5; };
    const auto make_source = [&] { return std::make_unique<LightFieldBuffer>(light_field_of(grid, light)); };
    Camera camera;
    camera.eye = {0, 0, 100_mm};
    camera.pupil = 5_mm;
    camera.picture = {8, 8, 64_um, 64_um, 0, 0};
    const HologramOptions options = options_for(Fourier{}, 2_um);
    const LightFieldBuffer kept = light_field_of(grid, light);
    const Image expected = photograph(*make_hologram(borrow(kept), options), {&camera, 1})[0];
    const Image image =
        photograph(*make_hologram(cached_tiles(LightField(make_source()), 1e6), options), {&camera, 1})[0];
    EXPECT_TRUE(std::ranges::equal(image.pixels.elements(), expected.pixels.elements()));
}

TEST(MakeHologram, every_method_keeps_its_light_field_alive) {
    const LightFieldGrid grid{4, 4, 64_um, 25, 25, Perspective{0.12, 0.12}, 1};
    for (const HologramMethodInfo& info : hologram_methods().rows()) {
        if (line_pitch(info.method)) continue;
        auto buffer = std::make_shared<LightFieldBuffer>(grid, true);
        std::ranges::fill(buffer->radiance.elements(), 1.0f);
        std::ranges::fill(buffer->depth.elements(), 2e-3f);
        const std::weak_ptr<LightFieldBuffer> watched = buffer;
        auto hologram = make_hologram(LightField(std::move(buffer)), options_for(info.method, 2_um));
        EXPECT_FALSE(watched.expired()) << info.name;
        EXPECT_NE(whole(*hologram)(40, 40), Complex(0)) << info.name;
        hologram.reset();
        EXPECT_TRUE(watched.expired()) << info.name;
    }
}

TEST(HologramMethods, have_unique_names_and_say_whether_they_need_depth) {
    std::vector<std::string> names = hologram_methods().names();
    names.resize(7);  // rows added by programs come last
    EXPECT_EQ(names, (std::vector<std::string>{"fourier", "lines", "basis", "basis-lines", "phase-added",
                                               "phase-added-exact", "olas"}));
    for (const HologramMethodInfo& info : hologram_methods().rows())
        EXPECT_EQ(info.needs_depth, needs_depth(info.method)) << info.name;
    EXPECT_TRUE(std::get<PhaseAdded>(hologram_methods().find("phase-added-exact").method).exact);
    EXPECT_THROW(hologram_methods().find("fourrier"), Error);
}

TEST(HologramMethods, of_a_program_work_like_the_librarys) {
    // Shows the mean radiance of each hogel as the amplitude of a plane wave.
    const auto make = [](const LightField& light_field, const FieldGrid& grid, const HologramOptions& options) {
        auto field = std::make_shared<Field>(grid);
        const LightFieldGrid& rays = light_field.grid();
        LightFieldTile tile(rays, {0, 0, rays.hogels_s, rays.hogels_t}, false);
        light_field.front().read(tile);
        const std::size_t side = grid.plane.width / rays.hogels_s;
        for (std::size_t y = 0; y < grid.plane.height; ++y)
            for (std::size_t x = 0; x < grid.plane.width; ++x)
                field->samples(y, x) = tile.radiance(options.channel.index, y / side, x / side, 0, 0);
        return field;
    };
    hologram_methods().add({"means", "the mean of each hogel", OwnMethod{"means", false, make}, false});
    LightFieldBuffer rays({4, 4, 64_um, 25, 25, Perspective{0.12, 0.12}, 1});
    std::ranges::fill(rays.radiance.elements(), 0.25f);
    const HologramMethod method = hologram_methods().find("means").method;
    EXPECT_EQ(whole(*make_hologram(borrow(rays), options_for(method, 2_um)))(40, 40), Complex(0.25f));
    EXPECT_FALSE(needs_depth(method));
}

TEST(Channels, pair_wavelengths_with_channels) {
    EXPECT_EQ(mono(532_nm), (std::vector<Channel>{{532_nm, 0}}));
    EXPECT_EQ(rgb(633_nm, 532_nm, 465_nm), (std::vector<Channel>{{633_nm, 0}, {532_nm, 1}, {465_nm, 2}}));
}

// Runs `use` and expects Error(usage) with `part` in its message.
template <class Use>
void expect_usage(const Use& use, const std::string& part) {
    try {
        use();
        ADD_FAILURE() << "expected: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

void expect_refused(const LightField& light_field, const HologramOptions& options, const std::string& part) {
    expect_usage([&] { make_hologram(light_field, options); }, part);
}

TEST(HologramGrid, refuses_faces_that_are_not_those_of_a_light_field) {
    const LightFieldGrid front{2, 2, 36_um, 8, 8, Perspective{1, 1}, 1};
    const std::vector<LightFieldGrid> cube = hemicube(front);
    const HologramOptions options = options_for(Fourier{}, 0.36_um);
    expect_usage([&] { hologram_grid({}, options); }, "begins with its front");
    expect_usage([&] { hologram_grid({&cube[1], 1}, options); }, "begins with its front");
    const LightFieldGrid mixed[] = {{3, 2, 36_um, 8, 8, Perspective{1, 1}, 1}, cube[1]};
    expect_usage([&] { hologram_grid(mixed, options); }, "other hogels");
}

TEST(MakeHologram, sides_of_a_hemicube_need_a_method_that_supports_them) {
    const LightField cube = hemicube_of({2, 2, 36_um, 8, 8, Perspective{1, 1}, 1}, [](Vec3, Vec3) { return 1.0; });
    for (const HologramMethod& method :
         {HologramMethod(PhaseAdded{}), HologramMethod(PhaseAdded{true}), HologramMethod(OverlapAdd{})})
        expect_refused(cube, options_for(method, 0.36_um), "needs the method fourier, lines, basis or basis-lines");
    expect_refused(cube, options_for(Lines{9_um}, 0.36_um), "8x1 directions would do");
    expect_refused(cube, options_for(Basis{.line_pitch = 9_um}, 0.36_um), "8x1 directions would do");
}

TEST(MakeHologram, lines_need_one_row_of_directions_and_a_line_pitch_that_is_not_negative) {
    const auto light = [](Vec3, Vec3) { return 1.0; };
    const LightFieldGrid grid{2, 2, 36_um, 8, 6, Perspective{0.1, 0.1}, 1};
    expect_refused(light_field_of_faces({&grid, 1}, light), options_for(Lines{9_um}, 3_um), "8x1 directions would do");
    const LightField row = row_of_directions(light);
    expect_refused(row, options_for(Lines{-1}, 3_um), "must not be negative");
    EXPECT_EQ(make_hologram(row, options_for(Lines{}, 3_um))->grid().plane.height, std::size_t{5 * 12});
    EXPECT_EQ(make_hologram(row, options_for(Lines{9_um}, 3_um))->grid().plane.height, std::size_t{5 * 4});
}

TEST(MakeHologram, frequencies_need_a_pitch_that_diffracts_them_and_no_added_phases) {
    LightFieldGrid sines{2, 2, 36_um, 31, 31, Perspective{15.5 * 633e-9 / 36e-6, 15.5 * 633e-9 / 36e-6}, 1};
    sines.view = Frequencies{sines.range()};
    const LightField exact(std::make_shared<const LightFieldBuffer>(sines, true));
    // 20 samples per hogel show only frequencies up to 10.
    expect_refused(exact, options_for(Fourier{}, 1.8_um), "a pitch of 1.2 um or less would do");
    EXPECT_NO_THROW(make_hologram(exact, options_for(Fourier{}, 1.2_um)));
    expect_refused(exact, options_for(PhaseAdded{}, 1.2_um), "uniform in sines");
}

// A hogel of width d resolves directions with sines λ/d apart, between −1 and 1.
TEST(HologramGrid, refuses_waves_longer_than_two_hogels_and_hogels_without_samples) {
    LightFieldGrid grid;
    grid.hogels_s = grid.hogels_t = 4;
    grid.pitch = 10_um;
    grid.directions_u = grid.directions_v = 4;
    grid.view = field_of_view(1_deg);
    const auto refusal = [&](double wavelength, double pitch) -> std::string {
        HologramOptions options;
        options.channel = {wavelength, 0};
        options.pitch = pitch;
        try {
            hologram_grid({&grid, 1}, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal(20_um, 5_um), "");
    EXPECT_NE(refusal(20.1_um, 5_um).find("expected at most twice the hogel, 20 um"), std::string::npos);
    EXPECT_NE(refusal(633, 5_um).find("the wavelength is 633 m; expected at most 0.1 mm"), std::string::npos);
    EXPECT_NE(refusal(633, 5_um).find("633*nm"), std::string::npos);
    EXPECT_EQ(refusal(1_um, 20_um), "");
    EXPECT_NE(refusal(1_um, 20.1_um).find("without samples"), std::string::npos);
}

}  // namespace
}  // namespace hogel::stereogram
