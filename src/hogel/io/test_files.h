// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <span>

#include "hogel/error.h"
#include "hogel/files.h"

#define EXPECT_SAYS(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

namespace hogel::io {

namespace fs = std::filesystem;

/// A folder for the files of a test.
class Files : public testing::Test {
  protected:
    Files() { fs::create_directories(directory_); }
    ~Files() override { fs::remove_all(directory_); }
    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_files_" + std::to_string(::getpid()));
    fs::path path_ = directory_ / "x.h5";
};

inline LightFieldGrid grid_of(std::size_t s, std::size_t t, std::size_t u, std::size_t v, std::size_t channels) {
    LightFieldGrid grid;
    grid.hogels_s = s;
    grid.hogels_t = t;
    grid.pitch = 0.1 / 3;
    grid.directions_u = u;
    grid.directions_v = v;
    grid.range().half_u = 0.4;
    grid.range().half_v = 1.0 / 3;
    grid.channels = channels;
    return grid;
}

inline FieldGrid plane_of(std::size_t width, std::size_t height) {
    return {{width, height, 1e-6, 2e-6, 1.0 / 3, -0.1}, 633e-9};
}

/// Random values of all magnitudes that are exact as half floats, and some infinite depths.
inline LightFieldBuffer random_light_field(const LightFieldGrid& grid, bool with_depth) {
    LightFieldBuffer field(grid, with_depth);
    std::mt19937 random(1);
    for (float& value : field.radiance.elements())
        value = std::ldexp(static_cast<float>(static_cast<int>(random() % 4096) - 2047),
                           static_cast<int>(random() % 20) - 20);
    for (float& value : field.depth.elements())
        value = random() % 5 == 0
                    ? INFINITY
                    : std::bit_cast<float>(0x30000000u + static_cast<std::uint32_t>(random()) % 0x10000000u);
    return field;
}

inline Field random_field(const FieldGrid& grid) {
    Field field(grid);
    std::mt19937 random(2);
    for (auto& value : field.samples.elements())
        value = {static_cast<float>(random()) / 7, -static_cast<float>(random()) / 3};
    return field;
}

template <class A, class B>
bool same_bits(const A& a, const B& b) {
    const auto bytes = [](const auto& array) { return std::as_bytes(std::span(array.elements())); };
    return std::ranges::equal(bytes(a), bytes(b));
}

inline std::string text_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void save(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// The message of the error when opening a light field; "" if there is none.
inline std::string refusal(const fs::path& path, ErrorCode code = ErrorCode::bad_input) {
    try {
        open_light_field(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code);
        EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "";
}

/// A light field file of a front alone.
inline std::unique_ptr<LightFieldSink> create_front(const fs::path& path, const LightFieldGrid& grid,
                                                    const LightFieldFileOptions& options = {}) {
    return std::move(create_light_field(path, {&grid, 1}, options).front());
}

}  // namespace hogel::io
