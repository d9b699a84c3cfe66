// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "hogel/compress.h"
#include "hogel/io/test_files.h"

namespace hogel::io {
namespace {

class WithoutHdf5 : public Files {
  protected:
    WithoutHdf5() { std::ofstream(path_, std::ios::binary) << "\x89HDF\r\n\x1a\n and more"; }

    static void expect_refusal(const std::function<void()>& work) {
        try {
            work();
            ADD_FAILURE() << "was accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::not_built_in) << error.what();
            EXPECT_SAYS(std::string(error.what()),
                        "x.h5', an HDF5 file: this build of hogel lacks HDF5; the build option "
                        "HOGEL_HDF5=ON brings it");
        }
    }
};

TEST_F(WithoutHdf5, files_are_refused_by_name) {
    const std::array light_field{grid_of(3, 2, 5, 4, 3)};
    const std::array hologram{plane_of(4, 3)};
    expect_refusal([&] { open_light_field(path_); });
    expect_refusal([&] { open_hologram(path_); });
    expect_refusal([&] { file_kind(path_); });
    expect_refusal([&] { summarize(path_); });
    expect_refusal([&] { require_hdf5(path_); });
    fs::remove(path_);
    expect_refusal([&] { create_light_field(path_, light_field); });
    expect_refusal([&] { create_hologram(path_, hologram); });
    EXPECT_FALSE(fs::exists(path_));
    EXPECT_EQ(file_formats().look_up("hdf5"), nullptr);
}

TEST_F(WithoutHdf5, missing_files_are_still_missing) {
    try {
        open_light_field(directory_ / "missing.h5");
        FAIL() << "opened a missing file";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_SAYS(std::string(error.what()), "missing.h5");
    }
}

TEST_F(WithoutHdf5, compressed_light_fields_are_written_and_read) {
    const LightFieldGrid grid = grid_of(4, 4, 6, 6, 3);
    const auto field = std::make_shared<LightFieldBuffer>(grid, false);
    for (float& value : field->radiance.elements()) value = 0.5f;
    CompressionOptions options;
    options.target = Sqnr{40};
    compress(LightField(field), directory_ / "a.hgl", options);
    EXPECT_EQ(file_kind(directory_ / "a.hgl"), FileKind::light_field);
    EXPECT_EQ(summarize(directory_ / "a.hgl").kind, FileKind::light_field);
    LightFieldBuffer back(grid, false);
    copy(open_light_field(directory_ / "a.hgl").front(), back);
    for (const float value : back.radiance.elements()) ASSERT_NEAR(value, 0.5f, 0.01f);
}

}  // namespace
}  // namespace hogel::io
