// SPDX-License-Identifier: Apache-2.0
// Tests files that cannot be written and files that are damaged.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <span>

#include "hogel/core/half.h"
#include "hogel/io/hdf5/rehearsal.h"
#include "hogel/io/test_files.h"

namespace hogel::io {
namespace {

class DamagedFiles : public Files {};

TEST_F(DamagedFiles, unfinished_ones_leave_the_old_file_and_nothing_else) {
    const LightFieldGrid grid = grid_of(3, 2, 5, 4, 3);
    const LightFieldBuffer field = random_light_field(grid, false);
    copy(field, *create_front(path_, grid));
    const std::string old = text_of(path_);
    {
        const auto sink = create_front(path_, grid);
        LightFieldTile tile(grid, {0, 0, 3, 1}, false);
        sink->write(tile);
        EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()), 2);
        try {
            sink->finish();
            ADD_FAILURE() << "finished with half of the hogels";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::internal);
            EXPECT_SAYS(std::string(error.what()), "3 of 6 hogels");
        }
    }
    const FieldGrid planes[] = {plane_of(4, 3), plane_of(4, 3)};
    {
        auto sinks = create_hologram(path_, planes);
        copy(random_field(planes[0]), *sinks[0]);
        EXPECT_THROW(sinks[1]->finish(), Error);
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()), 1);
    EXPECT_EQ(text_of(path_), old);
}

TEST_F(DamagedFiles, errors_of_creating_say_what_is_in_the_way) {
    const auto creating = [](const fs::path& path, const LightFieldGrid& grid, ErrorCode code,
                             const Metadata& metadata = {}) -> std::string {
        try {
            create_front(path, grid, {SampleType::half, false, metadata});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
            return error.what();
        }
        return "";
    };
    const LightFieldGrid grid = grid_of(3, 2, 5, 4, 3);
    EXPECT_SAYS(creating(directory_, grid, ErrorCode::cannot_write), "is a directory");
    EXPECT_SAYS(creating(directory_ / "no" / "x.h5", grid, ErrorCode::cannot_write), "there is no directory");
    LightFieldGrid nothing = grid;
    nothing.directions_u = 0;
    EXPECT_SAYS(creating(path_, nothing, ErrorCode::usage), "0x4 directions");
    // No disk has space for 2^58 samples, which is detected before the first sample.
    const std::size_t many = std::size_t{1} << 14;
    LightFieldGrid large = grid_of(many, many, many, many, 1);
    large.pitch = 0.1e-3;
    EXPECT_SAYS(creating(path_, large, ErrorCode::cannot_write), path_.string());
    EXPECT_SAYS(creating(path_, grid, ErrorCode::usage, {{"format", "mine"}}), "reserved");
    EXPECT_SAYS(creating(path_, grid, ErrorCode::usage, {{"a", "1"}, {"a", "2"}}), "twice");
    EXPECT_SAYS(creating(path_, grid, ErrorCode::usage, {{"a", std::string(70000, 'x')}}), "more than a file holds");
    EXPECT_THROW(create_hologram(path_, {}), Error);
    EXPECT_TRUE(fs::is_empty(directory_));
    // So much metadata that the header is stored in several pieces.
    Metadata much;
    for (int i = 0; i < 200; ++i) much.emplace_back("word" + std::to_string(i), std::string(5000, 'y'));
    copy(random_light_field(grid, false), *create_front(path_, grid, {SampleType::half, false, much}));
    EXPECT_EQ(refusal(path_), "");
    EXPECT_EQ(std::ranges::count(summarize(path_).text, much[199]), 1);
}

TEST_F(DamagedFiles, a_full_disk_is_an_error_at_once) {
    const LightFieldGrid grid = grid_of(16, 16, 64, 64, 3);
    for (const rlim_t limit : {rlim_t{0}, rlim_t{1000}, rlim_t{100000}, rlim_t{2} << 20}) {
        const pid_t child = fork();
        if (child == 0) {
            std::signal(SIGXFSZ, SIG_IGN);  // then a limit on the size of files fails as a full disk does
            const rlimit size{limit, limit};
            setrlimit(RLIMIT_FSIZE, &size);
            int status = 1;
            try {
                create_front(path_, grid);
            } catch (const Error& error) {
                status = error.code() == ErrorCode::cannot_write &&
                                 std::string(error.what()).find(path_.string()) != std::string::npos
                             ? 0
                             : 2;
            }
            _exit(status);
        }
        int status = -1;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0) << limit;
        EXPECT_TRUE(fs::is_empty(directory_));
    }
}

TEST_F(DamagedFiles, missing_truncated_and_other_files_are_refused) {
    EXPECT_SAYS(refusal(path_), "No such file");
    EXPECT_SAYS(refusal(directory_), "not a plain file");
    save(path_, "");
    EXPECT_SAYS(refusal(path_), "not an HDF5 file");
    save(path_, std::string(1000, 'x'));
    EXPECT_SAYS(refusal(path_), "not an HDF5 file");
    const LightFieldGrid grid = grid_of(3, 2, 5, 4, 3);
    copy(random_light_field(grid, true), *create_front(path_, grid, {SampleType::half, true, {{"a", "b"}}}));
    const std::string whole = text_of(path_);
    for (std::size_t length = 0; length < whole.size(); length += length < 300 ? 1 : 97) {
        save(path_, whole.substr(0, length));
        EXPECT_NE(refusal(path_), "") << length;
    }
    save(path_, whole.substr(0, whole.size() - 1));
    EXPECT_NE(refusal(path_), "");
}

// Damages each byte of a file except the samples, one at a time, and reads the file, which may throw only Error. Each
// byte is changed in one of three ways, by turns, and with HOGEL_THOROUGH in the environment in all of them.
template <class Samples, class Read>
void damage_every_byte(const fs::path& path, const Samples& samples, const Read& read) {
    const hdf5::NoRehearsal fast;
    const std::string whole = text_of(path);
    const std::string_view bytes(reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(samples[0]));
    const std::size_t first_sample = whole.find(bytes);
    ASSERT_NE(first_sample, std::string::npos);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const auto put = [&](std::size_t at, char value) {
        file.seekp(static_cast<std::streamoff>(at)).put(value).flush();
    };
    static constexpr int changes[] = {0x01, 0x80, 0xff};
    const std::span<const int> all(changes);
    const bool thorough = std::getenv("HOGEL_THOROUGH") != nullptr;
    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        if (at == first_sample) at += bytes.size();
        if (at >= whole.size()) break;
        for (const int change : thorough ? all : all.subspan(at % all.size(), 1)) {
            put(at, static_cast<char>(whole[at] ^ change));
            try {
                read();
            } catch (const Error& error) {
                ++refused;
                ASSERT_EQ(error.code(), ErrorCode::bad_input) << at << ": " << error.what();
            }
        }
        put(at, whole[at]);
    }
    EXPECT_GT(refused, thorough ? 1000u : 333u) << "checksums cover the headers";
}

TEST_F(DamagedFiles, a_light_field_damaged_in_any_byte_of_its_header_is_refused_or_unchanged) {
    const LightFieldGrid grid = grid_of(2, 3, 4, 5, 3);
    const LightFieldBuffer field = random_light_field(grid, false);
    copy(field, *create_front(path_, grid, {SampleType::single, false, {{"hogel_command", "x"}}}));
    damage_every_byte(path_, field.radiance.elements(), [&] {
        const LightField source = open_light_field(path_);
        EXPECT_EQ(source.grid(), grid);
        LightFieldBuffer back(grid);
        copy(source.front(), back);
        EXPECT_TRUE(same_bits(back.radiance, field.radiance));
        summarize(path_);
    });
}

TEST_F(DamagedFiles, a_side_face_damaged_in_any_byte_of_its_header_is_refused_or_unchanged) {
    std::vector<LightFieldGrid> grids = hemicube(grid_of(1, 1, 2, 2, 1));
    grids.resize(2);
    auto sinks = create_light_field(path_, grids, {SampleType::single, false, {}});
    const LightFieldBuffer front = random_light_field(grids[0], false), left = random_light_field(grids[1], false);
    copy(front, *sinks[0]);
    copy(left, *sinks[1]);
    damage_every_byte(path_, front.radiance.elements(), [&] {
        const LightField light_field = open_light_field(path_);
        const auto faces = light_field.faces();
        ASSERT_EQ(faces.size(), 2u);
        for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(faces[i]->grid(), grids[i]);
        LightFieldBuffer back(grids[0]);
        copy(*faces[0], back);
        EXPECT_TRUE(same_bits(back.radiance, front.radiance));
    });
}

TEST_F(DamagedFiles, a_hologram_damaged_in_any_byte_of_its_header_is_refused_or_unchanged) {
    const FieldGrid grid = plane_of(7, 5);
    Field field = random_field(grid);
    // Numbers that are exact as half floats.
    for (auto& sample : field.samples.elements()) {
        const auto kept = [](float part) { return core::float_of(core::half_of(1e-6f * part)); };
        sample = {kept(sample.real()), kept(sample.imag())};
    }
    std::vector<std::uint16_t> halves(2 * field.samples.size());
    core::to_half(reinterpret_cast<const float*>(field.samples.data()), halves.data(), halves.size());
    const auto read = [&] {
        const Fields fields = open_hologram(path_);
        EXPECT_EQ(fields.at(0)->grid(), grid);
        Field back(grid);
        copy(*fields[0], back);
        EXPECT_TRUE(same_bits(back.samples, field.samples));
        summarize(path_);
    };
    copy(field, *create_hologram(path_, {&grid, 1}, {SampleType::single, {{"hogel_command", "x"}}})[0]);
    damage_every_byte(path_, field.samples.elements(), read);
    copy(field, *create_hologram(path_, {&grid, 1}, {SampleType::half, {{"hogel_command", "x"}}})[0]);
    damage_every_byte(path_, halves, read);
}

}  // namespace
}  // namespace hogel::io
