// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/unfolded.h"

#include <gtest/gtest.h>

#include "hogel/codec/test_fields.h"
#include "hogel/compress.h"
#include "hogel/core/checksum.h"
#include "hogel/error.h"

namespace hogel::codec::format {
namespace {

// Returns a hemicube around hogels that see a smooth sky: the same function of direction on all faces.
std::vector<LightFieldBuffer> smooth_hemicube(std::size_t hogels, std::size_t directions_u, std::size_t directions_v) {
    const LightFieldGrid grid{hogels, hogels, 1e-3, directions_u, directions_v, Perspective{1, 1}, 1};
    std::vector<LightFieldBuffer> faces;
    for (const LightFieldGrid& face : hemicube(grid)) {
        LightFieldBuffer& field = faces.emplace_back(face);
        for (std::size_t j = 0; j < hogels; ++j)
            for (std::size_t i = 0; i < hogels; ++i)
                for (std::size_t l = 0; l < face.directions_v; ++l)
                    for (std::size_t k = 0; k < face.directions_u; ++k) {
                        const Vec3 direction = normalize(face.direction_of(face.u(double(k)), face.v(double(l))));
                        field.radiance(0, j, i, l, k) =
                            static_cast<float>(1 + 0.4 * std::sin(3 * direction.x + 0.5 * double(i)) +
                                               0.3 * std::cos(2 * direction.y - direction.z + double(j)));
                    }
    }
    return faces;
}

LightField light_field(const std::vector<LightFieldBuffer>& faces) {
    std::vector<const LightFieldSource*> result;
    for (const LightFieldBuffer& face : faces) result.push_back(&face);
    return borrow(result);
}

LightFieldBuffer unfolded(const std::vector<LightFieldBuffer>& faces) {
    const auto source = unfold(light_field(faces));
    LightFieldBuffer whole(source->grid());
    copy(*source, whole);
    return whole;
}

TEST(Unfolding, places_each_face) {
    const std::vector<LightFieldBuffer> faces = smooth_hemicube(2, 40, 24);
    const LightFieldBuffer whole = unfolded(faces);
    ASSERT_EQ(whole.grid().directions_u, 80u);
    ASSERT_EQ(whole.grid().directions_v, 48u);
    EXPECT_NEAR(whole.grid().step_u(), faces[0].grid().step_u(), 1e-12);
    EXPECT_EQ(whole.radiance(0, 1, 0, 12, 20), faces[0].radiance(0, 1, 0, 0, 0));
    EXPECT_EQ(whole.radiance(0, 1, 0, 12, 0), faces[1].radiance(0, 1, 0, 0, 0));   // left
    EXPECT_EQ(whole.radiance(0, 1, 0, 12, 60), faces[2].radiance(0, 1, 0, 0, 0));  // right
    EXPECT_EQ(whole.radiance(0, 1, 0, 0, 20), faces[3].radiance(0, 1, 0, 0, 0));   // top
    EXPECT_EQ(whole.radiance(0, 1, 0, 36, 20), faces[4].radiance(0, 1, 0, 0, 0));  // bottom
}

// A smooth sky continues around the edges of the cube: no step in the array near the faces is much larger than the
// largest step inside a face. Farther out a corner has a single value.
TEST(Unfolding, corners_continue_the_sides) {
    for (const auto& [n_u, n_v] : {std::pair{64u, 64u}, {64u, 48u}}) {
        const std::vector<LightFieldBuffer> faces = smooth_hemicube(1, n_u, n_v);
        const LightFieldBuffer whole = unfolded(faces);
        const auto view = whole.radiance[0][0][0];
        double largest = 0;
        for (const LightFieldBuffer& face : faces)
            for (std::size_t l = 0; l < face.grid().directions_v; ++l)
                for (std::size_t k = 0; k + 1 < face.grid().directions_u; ++k)
                    largest = std::max(
                        largest, double(std::abs(face.radiance(0, 0, 0, l, k + 1) - face.radiance(0, 0, 0, l, k))));
        const std::size_t u0 = n_u / 2, u1 = u0 + n_u, v0 = n_v / 2, v1 = v0 + n_v;
        for (std::size_t b = 0; b < v0; ++b)
            for (const std::size_t v : {b, v1 + b}) {
                EXPECT_LT(std::abs(view(v, u0 - 1) - view(v, u0)), 3 * largest) << v;
                EXPECT_LT(std::abs(view(v, u1) - view(v, u1 - 1)), 3 * largest) << v;
            }
        for (std::size_t a = 0; a < u0; ++a)
            for (const std::size_t u : {a, u1 + a}) {
                EXPECT_LT(std::abs(view(v0 - 1, u) - view(v0, u)), 3 * largest) << u;
                EXPECT_LT(std::abs(view(v1, u) - view(v1 - 1, u)), 3 * largest) << u;
            }
        EXPECT_EQ(view(0, 0), view(v0 - 1 - Unfolding::band, u0 - 1 - Unfolding::band));
        double sum = 0;  // over the faces in the top left quarter
        for (std::size_t v = 0; v < n_v; ++v)
            for (std::size_t u = 0; u < n_u; ++u)
                if (u >= u0 || v >= v0) sum += view(v, u);
        EXPECT_NEAR(view(0, 0), sum / (0.75 * n_u * n_v), 1e-5);
    }
}

TEST(Unfolding, refuses_faces_that_do_not_fit) {
    std::vector<LightFieldGrid> grids = hemicube({2, 2, 1e-3, 16, 12, Perspective{1, 1}, 3});
    EXPECT_NO_THROW(Unfolding{grids});
    const std::vector<LightFieldGrid> four(grids.begin(), grids.begin() + 4);
    EXPECT_THROW(Unfolding{four}, Error);
    grids[1].directions_v = 14;
    EXPECT_THROW(Unfolding{grids}, Error);
}

// The requested SQNR is that of all faces together, without the corners.
TEST(Hemicube, has_the_sqnr_asked_for_in_both_layouts) {
    const TestFolder folder;
    const std::vector<LightFieldBuffer> faces = smooth_hemicube(5, 24, 16);
    for (const StreamLayout layout : {StreamLayout::faces, StreamLayout::unfolded})
        for (const CodingMethod& method : {CodingMethod{"hogel", ""}, {"ezw", "ai33"}, {"jpeg4d", "dct8"}}) {
            CompressionOptions options;
            options.method = method;
            options.target = Sqnr{30};
            options.layout = layout;
            options.tile = HogelRange{0, 0, 3, 3};
            const CompressionResult result = compress(light_field(faces), folder / "a.hgl", options);
            const LightField opened = open_stream(folder / "a.hgl", {.memory = 1});
            ASSERT_EQ(opened.faces().size(), 5u);
            double signal = 0, error = 0;
            for (std::size_t i = 0; i < 5; ++i) {
                ASSERT_EQ(opened.faces()[i]->grid(), faces[i].grid());
                LightFieldBuffer other(faces[i].grid());
                copy(*opened.faces()[i], other);
                for (std::size_t k = 0; k < other.radiance.size(); ++k) {
                    const double f = faces[i].radiance.data()[k], e = f - other.radiance.data()[k];
                    signal += f * f;
                    error += e * e;
                }
            }
            const double sqnr = 10 * std::log10(signal / error);
            EXPECT_NEAR(sqnr, result.sqnr, 1e-6) << method.coder;
            EXPECT_GE(sqnr, 30);
            EXPECT_LE(sqnr, 30.1) << method.coder;
            EXPECT_NEAR(result.pixels_per_bit, 5 * 5 * 3 * 24 * 16 / (8.0 * double(result.bytes)), 1e-9);
        }
}

// Returns the mean square of the step that the coding error makes across the edges of the front, where neighbouring
// directions are on different faces.
double seam(const std::vector<LightFieldBuffer>& faces, const CodingMethod& method, StreamLayout layout) {
    const TestFolder folder;
    CompressionOptions options;
    options.method = method;
    options.target = Sqnr{35};
    options.layout = layout;
    options.tile = HogelRange{0, 0, 3, 3};
    compress(light_field(faces), folder / "a.hgl", options);
    const LightField opened = open_stream(folder / "a.hgl");
    std::vector<LightFieldBuffer> errors;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        LightFieldBuffer& decoded = errors.emplace_back(faces[i].grid());
        copy(*opened.faces()[i], decoded);
        for (std::size_t k = 0; k < decoded.radiance.size(); ++k)
            decoded.radiance.data()[k] -= faces[i].radiance.data()[k];
    }
    const LightFieldGrid &front = faces[0].grid(), &left = faces[1].grid(), &top = faces[3].grid();
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](float inside, float outside) {
        sum += double(inside - outside) * double(inside - outside);
        ++count;
    };
    for (std::size_t t = 0; t < front.hogels_t; ++t)
        for (std::size_t s = 0; s < front.hogels_s; ++s) {
            const auto of = [&](std::size_t face) { return errors[face].radiance[0][t][s]; };
            for (std::size_t v = 0; v < front.directions_v; ++v) {
                add(of(0)(v, 0), of(1)(v, left.directions_u - 1));
                add(of(0)(v, front.directions_u - 1), of(2)(v, 0));
            }
            for (std::size_t u = 0; u < front.directions_u; ++u) {
                add(of(0)(0, u), of(3)(top.directions_v - 1, u));
                add(of(0)(front.directions_v - 1, u), of(4)(0, u));
            }
        }
    return sum / double(count);
}

// At the same quality, in layouts that code the faces together and one by one. Wavelets longer than Haar's reach across
// the edges; blocks and Haar's wavelets end there in both layouts.
TEST(Hemicube, unfolded_has_smaller_seams_than_by_faces) {
    const std::vector<LightFieldBuffer> faces = smooth_hemicube(6, 32, 32);
    for (const auto& [coder, transform, at_most] :
         {std::tuple{"threepass", "ai33", 0.4}, {"threepass", "cdf97", 0.1}, {"hogel", "", 0.9}}) {
        const CodingMethod method{coder, transform};
        EXPECT_LT(seam(faces, method, StreamLayout::unfolded), at_most * seam(faces, method, StreamLayout::faces))
            << coder << " " << transform;
    }
}

TEST(Hemicube, every_truncation_and_every_flipped_byte_is_noticed) {
    const TestFolder folder;
    const std::vector<LightFieldBuffer> faces = smooth_hemicube(2, 4, 4);
    const auto fails = [&](const std::vector<std::uint8_t>& bytes) {
        write_bytes(folder / "b.hgl", bytes);
        try {
            const LightField opened = open_stream(folder / "b.hgl");
            for (const LightField::Source& face : opened.faces()) {
                LightFieldBuffer field(face->grid());
                copy(*face, field);
            }
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            return true;
        }
        return false;
    };
    for (const StreamLayout layout : {StreamLayout::faces, StreamLayout::unfolded}) {
        CompressionOptions options;
        options.target = Step{0.02};
        options.layout = layout;
        compress(light_field(faces), folder / "a.hgl", options);
        const std::vector<std::uint8_t> good = bytes_of_file(folder / "a.hgl");
        ASSERT_FALSE(fails(good));
        for (std::size_t length = 0; length < good.size(); length += 17)
            ASSERT_TRUE(fails({good.begin(), good.begin() + std::ptrdiff_t(length)})) << length;
        for (std::size_t at = 0; at < good.size(); at += 7) {
            std::vector<std::uint8_t> bad = good;
            bad[at] = static_cast<std::uint8_t>(bad[at] ^ 1 << at % 8);
            ASSERT_TRUE(fails(bad)) << at;
            // A forged header with a valid checksum may be read differently but does no harm.
            const std::size_t length = good[12] | std::size_t{good[13]} << 8;
            if (at < 16 || at >= 16 + length) continue;
            const std::uint32_t sum = core::checksum(std::span(std::as_const(bad)).first(16 + length));
            for (std::size_t i = 0; i < 4; ++i) bad[16 + length + i] = static_cast<std::uint8_t>(sum >> (8 * i));
            fails(bad);
        }
    }
}

}  // namespace
}  // namespace hogel::codec::format
