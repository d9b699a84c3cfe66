// SPDX-License-Identifier: Apache-2.0
// Test scene with closed-form views, as seen by a camera array.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hogel/array.h"
#include "hogel/image/formats/formats.h"

namespace hogel::exchange {

class TestFolder {
  public:
    TestFolder()
        : path_(std::filesystem::temp_directory_path() /
                ("hogel_views_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TestFolder() { std::filesystem::remove_all(path_); }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    void write(const std::string& name, const std::vector<unsigned char>& bytes) const {
        std::ofstream(path_ / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    void write(const std::string& name, const std::string& text) const {
        write(name, std::vector<unsigned char>(text.begin(), text.end()));
    }

  private:
    std::filesystem::path path_;
};

/// Cameras at distance D in front of the zero-parallax plane z = 0; behind it a textured plane at depth `far`, and at
/// depth `near` a card in front of its middle. Lengths in metres.
struct TestScene {
    std::size_t columns = 4, rows = 3, width = 64, height = 48;
    double distance = 0.3, spacing = 0.01, pixel = 0.5e-3;
    double near = -0.02, far = 0.03;

    /// Position, x to the right and y up, of the camera in column c from the left and row r from the top.
    double camera_x(std::size_t c) const {
        return (static_cast<double>(c) + 0.5 - 0.5 * static_cast<double>(columns)) * spacing;
    }
    double camera_y(std::size_t r) const {
        return (0.5 * static_cast<double>(rows) - static_cast<double>(r) - 0.5) * spacing;
    }
    /// Position of a pixel on the plane z = 0.
    double pixel_x(std::size_t i) const {
        return (static_cast<double>(i) + 0.5 - 0.5 * static_cast<double>(width)) * pixel;
    }
    double pixel_y(std::size_t j) const {
        return (0.5 * static_cast<double>(height) - static_cast<double>(j) - 0.5) * pixel;
    }

    /// Returns the radiance, 0 to 1, along the ray from the camera at (cx, cy) through (s, t) of the plane z = 0.
    double radiance(double cx, double cy, double s, double t) const {
        const double met = depth(cx, cy, s, t),
                     m = 1 + met / distance;  // fraction of the path from the camera to z = 0
        const double x = cx + (s - cx) * m, y = cy + (t - cy) * m;
        return met == near ? texture(x + 0.1, y) : texture(x, y - 0.2);
    }
    /// Returns the depth behind z = 0 of the point that this ray hits.
    double depth(double cx, double cy, double s, double t) const {
        const double m = 1 + near / distance;
        return std::abs(cx + (s - cx) * m) < 0.2 * static_cast<double>(width) * pixel &&
                       std::abs(cy + (t - cy) * m) < 0.25 * static_cast<double>(height) * pixel
                   ? near
                   : far;
    }

    /// Returns the display codes, 0 to 255, of a view. Channels differ only by an offset.
    Array<std::uint8_t, 3> view(std::size_t r, std::size_t c, std::size_t channels = 3) const {
        Array<std::uint8_t, 3> codes({height, width, channels});
        for (std::size_t j = 0; j < height; ++j)
            for (std::size_t i = 0; i < width; ++i)
                for (std::size_t channel = 0; channel < channels; ++channel)
                    codes(j, i, channel) = static_cast<std::uint8_t>(
                        std::lround(200 * radiance(camera_x(c), camera_y(r), pixel_x(i), pixel_y(j))) + 20 * channel);
        return codes;
    }
    std::vector<unsigned char> png(std::size_t r, std::size_t c) const {
        return image::png_file(view(r, c), {}, image::Curve::srgb);
    }

  private:
    // Pseudorandom values at the corners of cells of 2.5 mm, smoothly interpolated.
    static double texture(double x, double y) {
        constexpr double cell = 2.5e-3;
        const double i = std::floor(x / cell), j = std::floor(y / cell);
        const auto smooth = [](double f) { return f * f * (3 - 2 * f); };
        const double fx = smooth(x / cell - i), fy = smooth(y / cell - j);
        const double top = (1 - fx) * corner(i, j) + fx * corner(i + 1, j);
        const double bottom = (1 - fx) * corner(i, j + 1) + fx * corner(i + 1, j + 1);
        return (1 - fy) * top + fy * bottom;
    }
    static double corner(double i, double j) {
        auto bits =
            static_cast<std::uint64_t>(static_cast<std::int64_t>(i) * 7919 + static_cast<std::int64_t>(j) * 104729);
        bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9;
        bits = (bits ^ bits >> 27) * 0x94d049bb133111eb;
        return static_cast<double>((bits ^ bits >> 31) % 1001) / 1000;
    }
};

}  // namespace hogel::exchange
