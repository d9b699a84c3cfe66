// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "hogel/error.h"
#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

namespace fs = std::filesystem;

class Import : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() /
                  fmt::format("hogel-{}-{}", test->name(), ::testing::UnitTest::GetInstance()->random_seed());
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "meshes");
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& bytes) {
        fs::path path = folder_ / "meshes" / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path;
    }
    /// Returns the message of an import that must fail: one line that begins with the file's name.
    static std::string refusal(const fs::path& path) {
        try {
            import_scene(path);
        } catch (const Error& error) {
            std::string message = error.what();
            EXPECT_EQ(error.code(), ErrorCode::bad_input) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            EXPECT_EQ(message.find(path.string() + ": "), 0u) << message;
            EXPECT_NE(message.find("expected"), std::string::npos) << message;
            return message;
        }
        ADD_FAILURE() << path << " was accepted";
        return {};
    }
    void expect_refusal(const std::string& name, const std::string& bytes, const std::string& words) {
        const std::string message = refusal(write(name, bytes));
        EXPECT_NE(message.find(words), std::string::npos) << message;
    }

    fs::path folder_;
};

/// Returns the start of an ASCII PLY file: vertices of three floats, and further header lines.
inline std::string ply_vertices(int count, const std::string& further = {}) {
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}", count,
        further);
}
inline const std::string ply_colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

/// Returns the first byte of a list of n vertices in a PLY file.
inline std::string face_of(int n) { return std::string(1, static_cast<char>(n)); }

inline std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

template <class T>
std::string raw(std::initializer_list<T> values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.begin(), bytes.size());
    return bytes;
}

/// Returns a document of one triangle with vertex colours; `nodes` and `roots` are JSON.
inline std::string gltf(const std::string& nodes, const std::string& roots, const std::string& material = "{}") {
    const std::string bytes =
        raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + raw<float>({0.5f, 0.25f, 1, 0.5f, 0.25f, 1, 0.5f, 0.25f, 1});
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":{}}}],"nodes":{},
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"COLOR_0":1}},"material":0}}]}}],"materials":[{}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":36}}],
"buffers":[{{"byteLength":72,"uri":"data:application/octet-stream;base64,{}"}}]}})",
        roots, nodes, material, base64(bytes));
}

}  // namespace hogel::scene::mesh_files
