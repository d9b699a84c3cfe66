// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <numeric>

#include "hogel/error.h"
#include "hogel/io/hdf5/part_file.h"
#include "hogel/io/part_sinks.h"

namespace hogel::io {
namespace {

namespace fs = std::filesystem;

class PartFileTest : public testing::Test {
  protected:
    PartFileTest() {
        fs::create_directory(folder_);
        grid_.hogels_s = 4;
        grid_.hogels_t = 5;
        grid_.directions_u = grid_.directions_v = 3;
        grid_.channels = 3;
        grid_.pitch = 1e-3;
        grid_.view = Perspective{{0.3, 0.3}};
    }
    ~PartFileTest() override { fs::remove_all(folder_); }

    // Writes rows of a light field of counted samples, one tile a row.
    void write(const std::vector<std::unique_ptr<LightFieldSink>>& sinks, const Rows& rows) const {
        LightFieldGrid here = grid_;
        here.hogels_t = rows.count;
        for (std::size_t t = 0; t < rows.count; ++t) {
            LightFieldTile tile(here, {0, t, here.hogels_s, 1}, true);
            std::iota(tile.radiance.elements().begin(), tile.radiance.elements().end(),
                      static_cast<float>(100 * (rows.first + t)));
            std::iota(tile.depth.elements().begin(), tile.depth.elements().end(), static_cast<float>(rows.first + t));
            sinks.front()->write(tile);
        }
        sinks.front()->finish();
    }
    fs::path part(std::size_t number, std::size_t count, const Rows& rows) const {
        const fs::path path = folder_ / ("part" + std::to_string(number));
        write(create_light_field_part(path, {&grid_, 1}, options_, {number, count, "input"}, rows), rows);
        return path;
    }
    static std::string bytes_of(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    static void write_bytes(const fs::path& path, const std::string& bytes) {
        std::ofstream(path, std::ios::binary) << bytes;
    }

    fs::path folder_ = fs::temp_directory_path() / ("hogel_parts_" + std::to_string(::getpid()));
    LightFieldGrid grid_;
    LightFieldFileOptions options_{SampleType::half, true, {{"option seed", "1"}}, {}};
};

TEST_F(PartFileTest, joined_parts_have_the_bytes_of_the_whole_file) {
    write(create_light_field(folder_ / "whole.h5", {&grid_, 1}, options_), {0, 5});
    const std::vector<fs::path> parts{part(3, 3, {3, 2}), part(1, 3, {0, 1}), part(2, 3, {1, 2})};
    join_parts(folder_ / "joined.h5", parts, {});
    EXPECT_EQ(bytes_of(folder_ / "joined.h5"), bytes_of(folder_ / "whole.h5"));
}

TEST_F(PartFileTest, rows_that_overlap_or_are_missing_are_refused) {
    for (const Rows& second : {Rows{1, 4}, Rows{3, 2}, Rows{2, 2}}) {
        const std::vector<fs::path> parts{part(1, 2, {0, 2}), part(2, 2, second)};
        try {
            join_parts(folder_ / "joined.h5", parts, {});
            FAIL() << "joined";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
        }
        EXPECT_FALSE(fs::exists(folder_ / "joined.h5"));
    }
}

// Damage of any byte is rejected or has no effect (texts for messages). Tries a subset of bytes, because each trial
// writes a file.
TEST_F(PartFileTest, damaged_parts_are_refused) {
    write(create_light_field(folder_ / "whole.h5", {&grid_, 1}, options_), {0, 5});
    const std::string whole = bytes_of(folder_ / "whole.h5");
    const fs::path damaged = folder_ / "damaged";
    const std::string bytes = bytes_of(part(1, 1, {0, 5}));
    const std::size_t records = bytes.find("\nrecords\n") + 9;
    const auto refused = [&](const std::string& text) {
        write_bytes(damaged, text);
        try {
            join_parts(folder_ / "joined.h5", {&damaged, 1}, {});
        } catch (const Error& error) {
            return error.code() == ErrorCode::bad_input && !fs::exists(folder_ / "joined.h5");
        }
        return false;
    };
    for (std::size_t length = 0; length < bytes.size(); length += length < 300 ? 7 : 211)
        ASSERT_TRUE(refused(bytes.substr(0, length))) << length << " bytes";
    ASSERT_TRUE(refused(bytes + '\0'));
    for (std::size_t at = 0; at < bytes.size(); at += at < 100 ? 3 : 61) {
        std::string flipped = bytes;
        flipped[at] = static_cast<char>(flipped[at] ^ (1 << at % 8));
        if (refused(flipped)) continue;
        EXPECT_LT(at, records);
        EXPECT_EQ(bytes_of(folder_ / "joined.h5"), whole) << "byte " << at;
        fs::remove(folder_ / "joined.h5");
    }
}

// Bands of several records, which end inside of rows.
TEST_F(PartFileTest, bands_of_several_records_are_joined) {
    grid_.hogels_s = 23;
    grid_.directions_u = grid_.directions_v = 81;
    write(create_light_field(folder_ / "whole.h5", {&grid_, 1}, options_), {0, 5});
    const std::vector<fs::path> parts{part(1, 2, {0, 2}), part(2, 2, {2, 3})};
    join_parts(folder_ / "joined.h5", parts, {});
    EXPECT_EQ(bytes_of(folder_ / "joined.h5"), bytes_of(folder_ / "whole.h5"));
    EXPECT_GT(fs::file_size(parts[0]), std::size_t{2} << 20);
}

void expect_refused(const fs::path& part, const std::string& words) {
    try {
        hdf5::PartReader reader(part);
        ADD_FAILURE() << "read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST_F(PartFileTest, other_files_are_refused_by_name) {
    const fs::path file = folder_ / "other";
    write_bytes(file, "hogel part 1 123 0123abcd\npart 1 of 2\n");
    expect_refused(file, "an earlier version of hogel wrote this part; write it again");
    const std::string header = work::checkpoint_header({"input"});
    write_bytes(file, header + work::CheckpointRecord{{1, 2, 3}, "result"}.encoded());
    expect_refused(file, "it is no part of a file of hogel's");
    write_bytes(file, header);
    expect_refused(file, "it is no part of a file of hogel's");
    write_bytes(file, "");
    expect_refused(file, "it is no part of a file of hogel's");
}

// The file of a program that was killed before it had written all samples.
TEST_F(PartFileTest, parts_that_are_not_completed_are_refused) {
    const fs::path path = folder_ / "part", unfinished = folder_ / "unfinished";
    options_.resume = "input";
    {
        const auto sinks = create_light_field_part(path, {&grid_, 1}, options_, {1, 1, "input"}, {0, 5});
        LightFieldTile tile(grid_, {0, 0, 4, 1}, true);
        sinks.front()->write(tile);
    }
    fs::copy_file(path.string() + ".part", unfinished);
    EXPECT_THROW(join_parts(folder_ / "joined.h5", {&unfinished, 1}, {}), Error);
    const auto sinks = create_light_field_part(path, {&grid_, 1}, options_, {1, 1, "input"}, {0, 5});
    EXPECT_TRUE(sinks.front()->has_already({0, 0, 4, 1}));
    EXPECT_FALSE(sinks.front()->has_already({0, 1, 4, 1}));
}

}  // namespace
}  // namespace hogel::io
