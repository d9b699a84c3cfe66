// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "hogel/compress.h"
#include "hogel/core/random.h"
#include "hogel/error.h"
#include "hogel/light_field.h"

namespace hogel::codec {

// Returns two textured planes at different depths, the nearer one covering the middle, with some noise.
inline LightFieldBuffer textured_planes(std::size_t hogels_s, std::size_t hogels_t, std::size_t directions_u,
                                        std::size_t directions_v, std::size_t channels) {
    LightFieldGrid grid{hogels_s, hogels_t, 1e-3, directions_u, directions_v, Perspective{0.3, 0.3}, channels};
    LightFieldBuffer field(grid);
    const double per_hogel = grid.pitch / grid.step_u();  // depth with a disparity of one direction
    for (std::size_t j = 0; j < hogels_t; ++j)
        for (std::size_t i = 0; i < hogels_s; ++i)
            for (std::size_t l = 0; l < directions_v; ++l)
                for (std::size_t k = 0; k < directions_u; ++k) {
                    const auto at = [&](double depth) {
                        return std::pair{grid.s(double(i)) + grid.u(double(k)) * depth,
                                         grid.t(double(j)) + grid.v(double(l)) * depth};
                    };
                    auto [x, y] = at(1.5 * per_hogel);
                    const bool near = std::abs(x) < 0.2 * per_hogel && std::abs(y) < 0.3 * per_hogel;
                    if (!near) std::tie(x, y) = at(4 * per_hogel);
                    const double scale = 20 / per_hogel;
                    const auto noise = core::philox(
                        {std::uint32_t(i), std::uint32_t(j), std::uint32_t(k), std::uint32_t(l)}, {1, 2})[0];
                    for (std::size_t c = 0; c < channels; ++c)
                        field.radiance(c, j, i, l, k) =
                            static_cast<float>(0.6 + 0.2 * std::sin(scale * x + double(c)) * std::cos(1.3 * scale * y) +
                                               0.2 * near + 0.01 * double(noise) * 0x1p-32);
                }
    return field;
}

inline std::vector<std::uint8_t> bytes_of_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// A temporary folder, removed with its content.
class TestFolder {
  public:
    TestFolder() {
        std::string name = std::filesystem::temp_directory_path() / "hogel_codec_XXXXXX";
        path_ = mkdtemp(name.data());
    }
    ~TestFolder() { std::filesystem::remove_all(path_); }
    std::filesystem::path operator/(const char* name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

inline double sqnr_of(const LightFieldBuffer& truth, const LightFieldBuffer& other) {
    double signal = 0, error = 0;
    for (std::size_t i = 0; i < truth.radiance.size(); ++i) {
        const double f = truth.radiance.data()[i], e = f - other.radiance.data()[i];
        signal += f * f;
        error += e * e;
    }
    return 10 * std::log10(signal / error);
}

inline LightFieldBuffer decoded(const std::filesystem::path& path) {
    const LightField opened = open_stream(path);
    LightFieldBuffer field(opened.grid());
    copy(opened.front(), field);
    return field;
}

// Returns the code of the error that a call throws, 0 if none. The message must be a single line.
inline ErrorCode code_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.code();
    }
    return ErrorCode{0};
}

// Calls compress() with a borrowed source.
inline CompressionResult compress(const LightFieldSource& field, const std::filesystem::path& path,
                                  const CompressionOptions& options) {
    return hogel::compress(borrow(field), path, options);
}
inline CompressionResult compress(const std::vector<const LightFieldSource*>& faces, const std::filesystem::path& path,
                                  const CompressionOptions& options) {
    return hogel::compress(borrow(faces), path, options);
}

}  // namespace hogel::codec
