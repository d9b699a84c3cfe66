// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/companding.h"

#include <gtest/gtest.h>

#include <functional>
#include <mutex>

#include "hogel/codec/encode/histogram_tone_mapping.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/codec/test_fields.h"
#include "hogel/compress.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::codec::format {
namespace {

// Textured planes with radiances over four and a half decades.
LightFieldBuffer high_range(std::size_t hogels_s, std::size_t hogels_t, std::size_t u, std::size_t v,
                            std::size_t channels) {
    LightFieldBuffer field = textured_planes(hogels_s, hogels_t, u, v, channels);
    for (float& value : field.radiance.elements()) value = static_cast<float>(std::pow(10, 6 * value - 4));
    return field;
}

Companding companding_of(const LightFieldBuffer& field, double decades, float chrominance) {
    return {encode::tone_curve_of(luminance_histogram(borrow(field)), decades), chrominance};
}

CompressionOptions with_companding(const CodingMethod& method, std::optional<double> decades, double chrominance) {
    CompressionOptions options;
    options.method = method;
    options.target = Sqnr{40};
    options.tone_decades = decades;
    options.chrominance = chrominance;
    options.tile = HogelRange{0, 0, 4, 3};
    return options;
}

TEST(Companding, is_undone) {
    for (const std::size_t channels : {1, 3})
        for (const float chrominance : {1.0f, 4.0f}) {
            LightFieldBuffer field = high_range(3, 2, 16, 12, channels);
            // The values include zero, negative colours, and colours of opposite signs.
            for (std::size_t c = 0; c < channels; ++c) {
                field.radiance(c, 0, 0, 0, 0) = 0;
                field.radiance(c, 0, 0, 0, 1) = -0.3f * static_cast<float>(c + 1);
                field.radiance(c, 0, 0, 0, 2) = c == 1 ? -0.3f : 0.2f;
            }
            const Companding companding = companding_of(field, 2, chrominance);
            ASSERT_TRUE(companding.tone);
            LightFieldBuffer there = field;
            companding.apply(there.radiance.view());
            EXPECT_LT(sqnr_of(field, there), 10);
            companding.undo(there.radiance.view());
            const std::size_t rays = field.radiance.size() / channels;
            for (std::size_t i = 0; i < rays; ++i) {
                double largest = 0;
                for (std::size_t c = 0; c < channels; ++c)
                    largest = std::max<double>(largest, std::abs(field.radiance.data()[c * rays + i]));
                for (std::size_t k = i; k < field.radiance.size(); k += rays)
                    ASSERT_NEAR(there.radiance.data()[k], field.radiance.data()[k], 3e-5 * largest) << i;
            }
        }
}

TEST(Companding, keeps_the_ratios_of_colours_and_divides_chrominance) {
    const LightFieldBuffer field = high_range(2, 2, 8, 8, 3);
    const auto at = [](const LightFieldBuffer& f, std::size_t c, std::size_t i) {
        return double(f.radiance.data()[c * f.radiance.size() / 3 + i]);
    };
    LightFieldBuffer toned = field, grey = field;
    companding_of(field, 2, 1).apply(toned.radiance.view());
    Companding{std::nullopt, 4}.apply(grey.radiance.view());
    for (std::size_t i = 0; i < field.radiance.size() / 3; ++i) {
        const double mean = (at(field, 0, i) + at(field, 1, i) + at(field, 2, i)) / 3;
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(at(toned, c, i) / at(toned, 0, i), at(field, c, i) / at(field, 0, i),
                        1e-6 * at(field, c, i) / at(field, 0, i));
            EXPECT_NEAR(at(grey, c, i) - mean, (at(field, c, i) - mean) / 4, 1e-6 * mean);
        }
    }
}

// The requested SQNR is that of the mapped light field.
TEST(Companding, works_with_every_coder) {
    const TestFolder folder;
    const LightFieldBuffer field = high_range(5, 4, 16, 12, 3);
    for (const CodingMethod& method : {CodingMethod{"hogel", ""},
                                       {"threepass", "cdf97"},
                                       {"ezw", "haar"},
                                       {"jpeg4d", "dct8"},
                                       {"fringes", "cdf97"}}) {
        const CompressionResult result = compress(field, folder / "a.hgl", with_companding(method, 2, 2));
        const Companding companding = StreamReader(folder / "a.hgl").info().companding;
        EXPECT_EQ(companding, companding_of(field, 2, 2));
        LightFieldBuffer truth = field, other = decoded(folder / "a.hgl");
        companding.apply(truth.radiance.view());
        companding.apply(other.radiance.view());
        EXPECT_GE(result.sqnr, 40) << method.coder;
        EXPECT_NEAR(sqnr_of(truth, other), result.sqnr, 0.01) << method.coder;
        if (method.coder == "fringes") {
            EXPECT_EQ(code_of([&] { open_coefficients(folder / "a.hgl"); }), ErrorCode::bad_input);
        }
    }
}

// The histogram is that of all faces together, and in the layout unfolded the mapping precedes the filling of corners.
TEST(Companding, maps_all_faces_of_a_hemicube) {
    const TestFolder folder;
    std::vector<LightFieldBuffer> fields;
    std::vector<const LightFieldSource*> faces;
    const LightFieldGrid front = high_range(3, 2, 16, 16, 3).grid();
    LightFieldGrid wide = front;
    wide.range().half_u = wide.range().half_v = 1;
    for (const LightFieldGrid& grid : hemicube(wide)) {
        LightFieldBuffer field(grid);
        const LightFieldBuffer truth = high_range(3, 2, grid.directions_u, grid.directions_v, 3);
        std::ranges::copy(truth.radiance.elements(), field.radiance.elements().begin());
        fields.push_back(std::move(field));
    }
    for (const LightFieldBuffer& field : fields) faces.push_back(&field);
    for (const StreamLayout layout : {StreamLayout::faces, StreamLayout::unfolded}) {
        CompressionOptions options = with_companding({"threepass", "cdf97"}, 2, 2);
        options.layout = layout;
        hogel::compress(borrow(faces), folder / "a.hgl", options);
        const Companding companding = StreamReader(folder / "a.hgl").info().companding;
        EXPECT_EQ(companding.tone, encode::tone_curve_of(luminance_histogram(borrow(faces)), 2));
        const LightField opened = open_stream(folder / "a.hgl");
        for (std::size_t i = 0; i < faces.size(); ++i) {
            LightFieldBuffer truth = fields[i], other(fields[i].grid());
            copy(*opened.faces()[i], other);
            companding.apply(truth.radiance.view());
            companding.apply(other.radiance.view());
            EXPECT_GT(sqnr_of(truth, other), 35);
        }
    }
}

TEST(Companding, does_not_change_a_light_field_of_low_range) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(5, 4, 16, 12, 3);
    compress(field, folder / "a.hgl", with_companding({}, std::nullopt, 1));
    compress(field, folder / "b.hgl", with_companding({}, 2, 1));
    EXPECT_EQ(bytes_of_file(folder / "a.hgl"), bytes_of_file(folder / "b.hgl"));
    compress(field, folder / "b.hgl", with_companding({}, 0.2, 1));
    EXPECT_NE(bytes_of_file(folder / "a.hgl"), bytes_of_file(folder / "b.hgl"));
}

// Counts the largest number of samples of one read and the total.
class WatchedSource final : public LightFieldSource {
  public:
    explicit WatchedSource(const LightFieldBuffer& field) : field_(field) {}
    const LightFieldGrid& grid() const override { return field_.grid(); }
    HogelRange preferred_tile() const override { return {0, 0, 3, 2}; }
    void read(LightFieldTile& tile) const override {
        const std::lock_guard lock(mutex_);
        max_samples = std::max(max_samples, tile.radiance.size());
        all += tile.radiance.size();
        field_.read(tile);
    }
    mutable std::size_t max_samples = 0, all = 0;

  private:
    const LightFieldBuffer& field_;
    mutable std::mutex mutex_;
};

TEST(Companding, histogram_does_not_depend_on_threads_and_reads_each_tile_once) {
    const LightFieldBuffer field = high_range(8, 7, 16, 12, 3);
    const LuminanceHistogram expected = luminance_histogram(borrow(field));
    for (const std::size_t threads : {1, 2, 5}) {
        const ThreadLimit limit(threads);
        const WatchedSource watched(field);
        const LuminanceHistogram histogram = luminance_histogram(borrow(watched));
        EXPECT_TRUE(std::ranges::equal(histogram.counts(), expected.counts()));
        EXPECT_EQ(watched.max_samples, field.radiance.size() / 56 * 6);
        EXPECT_EQ(watched.all, field.radiance.size());
    }
}

TEST(Companding, impossible_requests_are_refused) {
    const TestFolder folder;
    const LightFieldBuffer colours = high_range(2, 2, 8, 8, 3), grey = high_range(2, 2, 8, 8, 1);
    const auto refused = [&](const LightFieldBuffer& field, const CompressionOptions& options) {
        return code_of([&] { compress(field, folder / "a.hgl", options); }) == ErrorCode::usage;
    };
    EXPECT_FALSE(refused(grey, with_companding({}, 2, 1)));
    EXPECT_TRUE(refused(grey, with_companding({}, 2, 3)));
    for (const double bad : {0.5, 0.0, -1.0, 1e6, double(NAN)})
        EXPECT_TRUE(refused(colours, with_companding({}, {}, bad)));
    for (const double bad : {0.0, -1.0, 21.0, double(NAN)}) EXPECT_TRUE(refused(colours, with_companding({}, bad, 1)));
    for (const bool lossless : {false, true}) {
        CompressionOptions exact = with_companding({}, 2, 1);
        exact.target = MaxError{0.1};
        if (lossless) exact.target = Lossless{};
        EXPECT_TRUE(refused(colours, exact));
        exact.tone_decades.reset();
        EXPECT_FALSE(refused(colours, exact));
        exact.chrominance = 2;
        EXPECT_TRUE(refused(colours, exact));
    }
}

// Returns the message of the error that reading a header throws; empty if there is none.
std::string complaint(const std::filesystem::path& path) {
    try {
        read_stream_info(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos);
        EXPECT_NE(message.find(path.string()), std::string::npos) << message;
        return message;
    }
    return "";
}

// The checksum is corrected, so that the field itself must be checked.
TEST(Companding, damaged_field_of_a_header_is_refused) {
    const TestFolder folder;
    const LightFieldBuffer field = high_range(2, 2, 8, 8, 3);
    compress(field, folder / "plain.hgl", with_companding({"threepass", "haar"}, {}, 1));
    compress(field, folder / "a.hgl", with_companding({"threepass", "haar"}, 2, 2));
    const auto length_of = [](const std::vector<std::uint8_t>& file) { return file[12] | std::size_t{file[13]} << 8; };
    const std::vector<std::uint8_t> plain = bytes_of_file(folder / "plain.hgl"), good = bytes_of_file(folder / "a.hgl");
    const std::size_t begin = 16 + length_of(plain), end = 16 + length_of(good);
    ASSERT_GT(end, begin + 100);
    const std::vector<std::uint8_t> part(good.begin() + std::ptrdiff_t(begin), good.begin() + std::ptrdiff_t(end));
    const std::size_t chrominance = part.size() - 4 - 11 - 4 - 4;  // offset of the field: its name, length and factor
    const auto with = [&](const std::vector<std::uint8_t>& forged) {
        ByteWriter file;
        file.put(std::span(good).first(12));
        file.put(static_cast<std::uint32_t>(begin - 16 + forged.size()));
        file.put(std::span(good).subspan(16, begin - 16));
        file.put(std::span(forged));
        file.put(core::checksum(file.bytes));
        file.put(std::span(good).subspan(end + 4));
        write_bytes(folder / "b.hgl", file.bytes);
        return complaint(folder / "b.hgl");
    };
    EXPECT_EQ(with(part), "");
    EXPECT_EQ(with({part.begin(), part.begin() + std::ptrdiff_t(chrominance)}), "");
    for (std::size_t length = 1; length < part.size(); length += length % 16 == 2 ? 12 : 1)
        EXPECT_EQ(with({part.begin(), part.begin() + std::ptrdiff_t(length)}).empty(), length == chrominance) << length;
    for (std::size_t at = 0; at<part.size(); at += at> 20 && at + 30 < chrominance ? 5 : 1)
        for (const int bit : {0, 7}) {
            std::vector<std::uint8_t> bad = part;
            bad[at] = static_cast<std::uint8_t>(bad[at] ^ 1 << bit);
            const bool number = (at >= 12 && at < chrominance) || at >= part.size() - 4;
            EXPECT_TRUE(!with(bad).empty() || number) << at;
            if (!number) continue;
            // A damaged number may still be valid and give other samples.
            if (complaint(folder / "b.hgl").empty()) decoded(folder / "b.hgl");
        }
    ByteWriter twice, swapped;
    for (ByteWriter* forged : {&twice, &swapped}) forged->put(std::span(part).subspan(chrominance));
    twice.put(std::span(part).subspan(chrominance));
    EXPECT_NE(with(twice.bytes).find("unknown field, or one twice"), std::string::npos);
    swapped.put(std::span(part).first(chrominance));
    EXPECT_NE(with(swapped.bytes), "");
    for (const float bad : {1.0f, 0.5f, -2.0f, 2000.0f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
        ByteWriter forged;
        forged.put(std::span(part).first(part.size() - 4));
        forged.put(bad);
        EXPECT_NE(with(forged.bytes).find("factor of chrominance"), std::string::npos) << bad;
    }
}

}  // namespace
}  // namespace hogel::codec::format
