// SPDX-License-Identifier: Apache-2.0
// Rate and quality of every coder against a committed table, so that a change that makes files larger or worse is seen.
//
//   rates_tests                                  fails if a row differs by more than the tolerance
//   rates_tests --rows > tests/rates/table.txt measures all rows again and prints the table
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "hogel/compress.h"
#include "hogel/renderer.h"
#include "hogel/scene.h"
#include "hogel/shading.h"
#include "hogel/units.h"

namespace hogel {
namespace {

using namespace literals;

constexpr double max_bytes_off = 0.01;  // relative
constexpr double max_sqnr_off = 0.05;   // decibels

LightField::Source rendered(const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid) {
    auto field = std::make_shared<LightFieldBuffer>(grid);
    copy(*make_renderer("raytrace", scene, grid), *field);
    return field;
}

LightField render(const char* name, double size, const std::vector<LightFieldGrid>& grids) {
    const auto scene = std::make_shared<const ShadedScene>(shade_scene(make_scene(name, size), {}));
    std::vector<LightField::Source> faces;
    for (const LightFieldGrid& grid : grids) faces.push_back(rendered(scene, grid));
    return LightField(std::move(faces));
}

// Waves on a plane behind the hologram and on one in front of it, coarse enough for any sampling.
LightField smooth() {
    const LightFieldGrid grid{16, 16, 0.5_mm, 32, 32, Perspective{0.15, 0.15}, 1};
    auto field = std::make_unique<LightFieldBuffer>(grid);
    const auto wave = [&](std::size_t s, std::size_t t, std::size_t u, std::size_t v, double depth, double period) {
        const double x = grid.s(double(s)) + depth * grid.u(double(u)),
                     y = grid.t(double(t)) + depth * grid.v(double(v));
        return std::sin(6.28 * x / period + 0.4 * std::sin(4 * y / period)) * std::cos(4.4 * y / period);
    };
    for (std::size_t t = 0; t < 16; ++t)
        for (std::size_t s = 0; s < 16; ++s)
            for (std::size_t v = 0; v < 32; ++v)
                for (std::size_t u = 0; u < 32; ++u)
                    field->radiance(0, t, s, v, u) = static_cast<float>(1 + 0.3 * wave(s, t, u, v, 20_mm, 2_mm) +
                                                                        0.2 * wave(s, t, u, v, -12_mm, 1.5_mm));
    return field;
}

LightField make_light_field(const std::string& name) {
    const double pitch = 6_mm / 16;
    if (name == "smooth") return smooth();
    if (name == "pumpkin") return render("pumpkin", 6_mm, {{16, 16, pitch, 32, 32, Perspective{0.14, 0.14}, 3}});
    if (name == "church") return render("church", 6_mm, {{12, 12, 6_mm / 12, 40, 40, Perspective{0.14, 0.14}, 3}});
    // Horizontal parallax only: a single row of directions.
    if (name == "pumpkin-row") return render("pumpkin", 6_mm, {{24, 32, 6_mm / 32, 48, 1, Perspective{0.14, 0.01}, 3}});
    if (name == "pumpkin-hemicube")
        return render("pumpkin", 6_mm, hemicube({8, 8, 6_mm / 8, 24, 24, Perspective{1, 1}, 3}));
    throw Error(ErrorCode::usage, "no light field of that name: " + name);
}

const LightField& light_field(const std::string& name) {
    static std::map<std::string, LightField> made;
    const auto found = made.find(name);
    return found != made.end() ? found->second : made.emplace(name, make_light_field(name)).first->second;
}

// A line of the table.
struct Row {
    std::string scene, coder, layout, target;
    double sqnr = 0;
    std::uint64_t bytes = 0;
};

CompressionTarget target_of(const std::string& text) {
    if (text == "lossless") return Lossless{};
    return Step{std::stod(text)};
}

StreamLayout layout_of(const std::string& text) {
    if (text == "faces") return StreamLayout::faces;
    if (text == "unfolded") return StreamLayout::unfolded;
    if (text == "stacked") return StreamLayout::stacked;
    throw Error(ErrorCode::usage, "no layout of that name: " + text);
}

// The row with newly measured figures.
Row measured(Row row) {
    CompressionOptions options;
    options.method.coder = row.coder;
    options.layout = layout_of(row.layout);
    options.target = target_of(row.target);
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / fmt::format("hogel_rates_{}.hgl", getpid());
    const CompressionResult result = compress(light_field(row.scene), path, options);
    std::filesystem::remove(path);
    row.sqnr = result.sqnr;
    row.bytes = result.bytes;
    return row;
}

std::string text_of(const Row& row) {
    return fmt::format("{:16} {:9} {:8} {:8} {:7.3f} {:8}", row.scene, row.coder, row.layout, row.target, row.sqnr,
                       row.bytes);
}

std::vector<std::string> lines_of_table() {
    std::ifstream file(HOGEL_RATE_TABLE);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

bool is_row(const std::string& line) { return !line.empty() && line.front() != '#'; }

Row row_of(const std::string& line) {
    Row row;
    std::string sqnr;
    std::istringstream(line) >> row.scene >> row.coder >> row.layout >> row.target >> sqnr >> row.bytes;
    row.sqnr = std::stod(sqnr);
    return row;
}

TEST(Rates, are_those_of_the_table) {
    std::size_t rows = 0;
    for (const std::string& line : lines_of_table()) {
        if (!is_row(line)) continue;
        ++rows;
        const Row expected = row_of(line), found = measured(expected);
        const std::string message = "table:    " + text_of(expected) + "\nmeasured: " + text_of(found);
        EXPECT_NEAR(static_cast<double>(found.bytes), static_cast<double>(expected.bytes),
                    max_bytes_off * static_cast<double>(expected.bytes))
            << message;
        if (std::isfinite(expected.sqnr))
            EXPECT_NEAR(found.sqnr, expected.sqnr, max_sqnr_off) << message;
        else
            EXPECT_EQ(found.sqnr, expected.sqnr) << message;
    }
    EXPECT_GE(rows, 20u);
}

}  // namespace
}  // namespace hogel

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    if (argc == 1) return RUN_ALL_TESTS();
    if (argc != 2 || std::string(argv[1]) != "--rows") {
        std::cerr << "usage: rates_tests [--rows]\n";
        return EXIT_FAILURE;
    }
    for (const std::string& line : hogel::lines_of_table())
        std::cout << (hogel::is_row(line) ? text_of(measured(hogel::row_of(line))) : line) << '\n' << std::flush;
    return EXIT_SUCCESS;
}
