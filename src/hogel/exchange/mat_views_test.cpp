// SPDX-License-Identifier: Apache-2.0
// Light fields as arrays of MAT files, in the orders of axes and classes of numbers that programs write.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "hogel/error.h"
#include "hogel/exchange/test_views.h"
#include "hogel/exchange/view_set.h"
#include "hogel/io/arrays/mat_write.h"

namespace hogel::exchange {
namespace {

using io::arrays::Number;

const TestScene scene{.columns = 4, .rows = 3, .width = 10, .height = 8};

// What an array holds at an index of its axes.
using At = std::array<std::size_t, 5>;
using Value = std::function<double(const At& at)>;

template <class T>
void append(std::vector<unsigned char>& bytes, double value) {
    const T number = static_cast<T>(value);
    const auto* const first = reinterpret_cast<const unsigned char*>(&number);
    bytes.insert(bytes.end(), first, first + sizeof number);
}

// A file with the array LF of these extents, the first index fastest.
std::vector<unsigned char> mat_file(const std::vector<std::size_t>& shape, Number number, const Value& value,
                                    const std::string& name = "LF") {
    io::arrays::MatWriter writer("x.mat");
    writer.numbers("baseline", std::vector<double>{0.1});
    writer.begin_numbers(name, shape, number);
    std::vector<unsigned char> bytes = writer.bytes();
    std::array<std::size_t, 5> at{};
    for (bool more = true; more;) {
        const double held = value(at);
        if (number == Number::uint8) append<std::uint8_t>(bytes, held);
        if (number == Number::uint16) append<std::uint16_t>(bytes, held);
        if (number == Number::single) append<float>(bytes, held);
        if (number == Number::real) append<double>(bytes, held);
        more = false;
        for (std::size_t axis = 0; axis < shape.size() && !more; ++axis) {
            more = ++at[axis] < shape[axis];
            if (!more) at[axis] = 0;
        }
    }
    bytes.resize((bytes.size() + 7) / 8 * 8);
    return bytes;
}

double code(std::size_t row, std::size_t column, std::size_t y, std::size_t x, std::size_t c) {
    return static_cast<double>((7 * row + 13 * column + 5 * y + 3 * x + 60 * c) % 256);
}

void expect_codes(const ViewSet& set, std::size_t channels) {
    ASSERT_EQ(set.rows, scene.rows);
    ASSERT_EQ(set.columns, scene.columns);
    ASSERT_EQ(set.width, scene.width);
    ASSERT_EQ(set.height, scene.height);
    ASSERT_EQ(set.channels, channels);
    for (std::size_t r = 0; r < scene.rows; ++r)
        for (std::size_t c = 0; c < scene.columns; ++c) {
            const image::Picture picture = set.pictures->read(r, c);
            const auto& samples = std::get<Array<std::uint8_t, 3>>(picture.samples);
            for (std::size_t y = 0; y < scene.height; ++y)
                for (std::size_t x = 0; x < scene.width; ++x)
                    for (std::size_t i = 0; i < channels; ++i) ASSERT_EQ(samples(y, x, i), code(r, c, y, x, i));
        }
}

ViewImportOptions column_second() {
    ViewImportOptions options;
    options.column_first = false;
    return options;
}

TEST(MatViews, AxesAreToldByTheirExtents) {
    const std::size_t m = scene.rows, n = scene.columns, h = scene.height, w = scene.width;
    const TestFolder folder;
    const auto path = folder.path() / "a.mat";
    const auto opened = [&](const std::vector<std::size_t>& shape, const Value& value) {
        folder.write("a.mat", mat_file(shape, Number::uint8, value));
        EXPECT_TRUE(is_view_set(path));
        return open_views(path, column_second());
    };
    expect_codes(opened({m, n, h, w, 3}, [](const At& i) { return code(i[0], i[1], i[2], i[3], i[4]); }), 3);
    expect_codes(opened({h, w, 3, m, n}, [](const At& i) { return code(i[3], i[4], i[0], i[1], i[2]); }), 3);
    expect_codes(opened({h, w, m, n, 3}, [](const At& i) { return code(i[2], i[3], i[0], i[1], i[4]); }), 3);
    expect_codes(opened({m, n, h, w}, [](const At& i) { return code(i[0], i[1], i[2], i[3], 0); }), 1);
    // A fourth channel is a weight.
    const ViewSet set =
        opened({m, n, h, w, 4}, [](const At& i) { return i[4] == 3 ? 255 : code(i[0], i[1], i[2], i[3], i[4]); });
    expect_codes(set, 3);
    EXPECT_EQ(std::ranges::count(set.notes, "the fourth channel was taken for a weight, and left out"), 1);
    EXPECT_EQ(set.notes.front(), "the axes of LF were taken for (row of views, column of views, y, x, channel)");
}

TEST(MatViews, CodesAreToldByClassAndLargestNumber) {
    const std::vector<std::size_t> shape{scene.rows, scene.columns, scene.height, scene.width};
    const TestFolder folder;
    const auto path = folder.path() / "a.mat";
    const auto opened = [&](Number number, double factor, double last) {
        folder.write("a.mat", mat_file(shape, number, [&](const At& i) {
                         return i == At{} ? last : factor * code(i[0], i[1], i[2], i[3], 0);
                     }));
        return open_views(path, column_second());
    };
    EXPECT_EQ(opened(Number::uint16, 4, 1023).max_code, 1023u);
    EXPECT_EQ(opened(Number::uint16, 16, 4095).max_code, 4095u);
    EXPECT_EQ(opened(Number::uint16, 200, 65535).max_code, 65535u);
    EXPECT_EQ(opened(Number::uint16, 0.2, 255).max_code, 65535u) << "a dark picture of 16 bits";
    EXPECT_EQ(opened(Number::real, 1, 255).max_code, 255u) << "codes as doubles";
    EXPECT_EQ(opened(Number::real, 1.0 / 255, 1).bits, 32u);
    const ViewSet floats = opened(Number::single, 0.5, 3.25);
    EXPECT_EQ(floats.bits, 32u);
    EXPECT_EQ((std::get<Array<float, 3>>(floats.pictures->read(0, 0).samples)(0, 0, 0)), 3.25f);
    EXPECT_EQ((std::get<Array<float, 3>>(floats.pictures->read(2, 3).samples)(7, 9, 0)), 0.5 * code(2, 3, 7, 9, 0));
}

TEST(MatViews, TheParallaxSaysWhichAxisIsTheColumn) {
    const TestScene large{.columns = 4, .rows = 3, .width = 96, .height = 80};
    std::vector<Array<std::uint8_t, 3>> views;
    for (std::size_t i = 0; i < 12; ++i) views.push_back(large.view(i / 4, i % 4, 1));
    const TestFolder folder;
    folder.write("a.mat", mat_file({4, 3, 80, 96}, Number::uint8,
                                   [&](const At& i) { return views[i[1] * 4 + i[0]](i[2], i[3], 0); }));
    const ViewSet set = open_views(folder.path() / "a.mat", {});
    EXPECT_EQ(set.columns, 4u);
    EXPECT_EQ(set.rows, 3u);
    EXPECT_EQ(std::ranges::count(set.notes, "by their parallax, the first axis of views is the column of views"), 1);
}

TEST(MatViews, WhatIsNoLightFieldIsRefusedByName) {
    const TestFolder folder;
    const auto path = folder.path() / "a.mat";
    ViewImportOptions options;
    options.layout = "mat";
    const auto error = [&](const std::vector<unsigned char>& bytes) {
        folder.write("a.mat", bytes);
        try {
            open_views(path, options);
        } catch (const Error& wrong) {
            EXPECT_EQ(wrong.code(), ErrorCode::bad_input);
            return std::string(wrong.what());
        }
        return std::string("nothing");
    };
    const auto zero = [](const At&) { return 0.0; };
    EXPECT_NE(error(mat_file({5, 4}, Number::uint8, zero)).find("has no array of four or five axes"),
              std::string::npos);
    EXPECT_NE(error(mat_file({2, 2, 5, 7, 6}, Number::uint8, zero)).find("1, 3 or 4 channels"), std::string::npos);
    // At every length: the reader either refuses the file or does not see the array.
    const std::vector<unsigned char> bytes = mat_file({2, 2, 3, 3}, Number::uint8, zero);
    EXPECT_EQ(error(bytes), "nothing");
    for (std::size_t length = 0; length + 8 < bytes.size(); ++length) {
        EXPECT_NE(error({bytes.begin(), bytes.begin() + static_cast<long>(length)}).find("a.mat"), std::string::npos)
            << length;
        is_view_set(path);
    }
    // Every byte of the heads changed is refused or read, but never worse.
    for (std::size_t at = 128; at < bytes.size(); ++at)
        for (const unsigned char value : {0x00, 0x7f, 0xff}) {
            std::vector<unsigned char> damaged = bytes;
            damaged[at] = value;
            error(damaged);
        }
}

}  // namespace
}  // namespace hogel::exchange
