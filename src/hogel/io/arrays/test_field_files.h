// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hogel/core/output_file.h"
#include "hogel/core/part.h"
#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/image.h"

namespace hogel::io::arrays {

namespace fs = std::filesystem;
using Complex = std::complex<float>;
using Bytes = std::vector<unsigned char>;
using Values = ExternalField::Values;

// Test fixture with a temporary folder.
class FieldFiles : public testing::Test {
  protected:
    FieldFiles() { fs::create_directories(directory_); }
    ~FieldFiles() override { fs::remove_all(directory_); }

    fs::path write(const std::string& name, const Bytes& bytes) const {
        core::write_file(directory_ / name, bytes);
        return directory_ / name;
    }

    // Returns whether the build lacks pictures, and then checks that writing one is refused.
    static bool without_pictures() {
        if (core::part("pictures").built_in) return false;
        try {
            encode_png(Image(1, 1, 1), 1);
            ADD_FAILURE() << "a picture was written";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::not_built_in) << error.what();
        }
        return true;
    }

    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_fields_" + std::to_string(::getpid()));
};

inline ExternalField known(Values values = Values::complex) {
    ExternalField what;
    what.pitch_x = what.pitch_y = 2e-6;
    what.wavelength = 633e-9;
    what.values = values;
    return what;
}

inline Array<Complex, 2> all_of(const FieldSource& field) {
    const Grid& plane = field.grid().plane;
    Array<Complex, 2> samples({plane.height, plane.width});
    field.read({0, 0, plane.width, plane.height}, 0, samples);
    return samples;
}

inline Bytes npy(const std::string& type, bool by_columns, const std::function<void(Bytes&)>& numbers) {
    std::string header =
        "{'descr': '" + type + "', 'fortran_order': " + (by_columns ? "True" : "False") + ", 'shape': (3, 2), }";
    header.resize(117, ' ');
    header += '\n';
    const std::string all = "\x93NUMPY\1" + std::string(1, '\0') + static_cast<char>(header.size()) + '\0' + header;
    Bytes bytes(all.begin(), all.end());
    numbers(bytes);
    return bytes;
}
template <class T>
void put(Bytes& bytes, T value) {
    const auto* begin = reinterpret_cast<const unsigned char*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof value);
}
// Three rows of two columns, 0 + 6i, 1 + 7i, 2 + 8i, … row by row.
inline Bytes npy_rows() {
    return npy("<c8", false, [](Bytes& bytes) {
        for (int i = 0; i < 6; ++i) {
            put(bytes, static_cast<float>(i));
            put(bytes, static_cast<float>(i + 6));
        }
    });
}

inline void expect_example(const FieldSource& field, double sign = 1) {
    ASSERT_EQ(field.grid().plane.width, 2u);
    ASSERT_EQ(field.grid().plane.height, 3u);
    EXPECT_EQ(field.grid().wavelength, 633e-9);
    EXPECT_EQ(field.grid().plane.pitch_x, 2e-6);
    const Array<Complex, 2> samples = all_of(field);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(samples.data()[i], Complex(float(i), float(sign * double(i + 6)))) << i;
}

// Expects that opening the field is refused because the build lacks a part.
inline void expect_not_built_in(const fs::path& path, const ExternalField& what, const std::string& option) {
    try {
        open_external_field(path, what);
        ADD_FAILURE() << path << " was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::not_built_in) << error.what();
        EXPECT_NE(std::string(error.what()).find(option), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
}

}  // namespace hogel::io::arrays
