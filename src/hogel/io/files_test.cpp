// SPDX-License-Identifier: Apache-2.0
#include "hogel/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <random>
#include <span>

#include "hogel/core/half.h"
#include "hogel/core/parallel.h"
#include "hogel/error.h"

// HDF5 1.10 forgets what it had begun to load when a checksum turns out wrong; builds with a leak checker ask here.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace hogel::io {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
  protected:
    Files() { fs::create_directories(directory_); }
    ~Files() override { fs::remove_all(directory_); }
    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_files_" + std::to_string(::getpid()));
    fs::path path_ = directory_ / "x.h5";
};

LightFieldGrid grid_of(std::size_t s, std::size_t t, std::size_t u, std::size_t v, std::size_t channels) {
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

FieldGrid plane_of(std::size_t width, std::size_t height) {
    return {{width, height, 1e-6, 2e-6, 1.0 / 3, -0.1}, 633e-9};
}

// Random values that half floats keep exactly, of all sizes and with infinities.
LightFieldBuffer random_light_field(const LightFieldGrid& grid, bool with_depth) {
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

Field random_field(const FieldGrid& grid) {
    Field field(grid);
    std::mt19937 random(2);
    for (auto& value : field.samples.elements())
        value = {static_cast<float>(random()) / 7, -static_cast<float>(random()) / 3};
    return field;
}

// Writes by tiles of a size, in random order and from several threads.
void write_tiles(const LightFieldBuffer& from, LightFieldSink& sink, std::size_t ns, std::size_t nt) {
    const LightFieldGrid& g = from.grid();
    std::vector<HogelRange> ranges;
    for (std::size_t t = 0; t < g.hogels_t; t += nt)
        for (std::size_t s = 0; s < g.hogels_s; s += ns)
            ranges.push_back({s, t, std::min(ns, g.hogels_s - s), std::min(nt, g.hogels_t - t)});
    std::ranges::shuffle(ranges, std::mt19937(3));
    core::parallel_for(ranges.size(), [&](std::size_t i) {
        LightFieldTile tile(g, ranges[i], from.has_depth());
        from.read(tile);
        sink.write(tile);
    });
    sink.finish();
}

template <class A, class B>
bool same_bits(const A& a, const B& b) {
    const auto bytes = [](const auto& array) { return std::as_bytes(std::span(array.elements())); };
    return std::ranges::equal(bytes(a), bytes(b));
}

std::string text_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void save(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

// The message of the Error that opening throws, whichever way a file is opened; "" if every way works.
std::string refusal(const fs::path& path, ErrorCode code = ErrorCode::bad_input) {
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

#define EXPECT_SAYS(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

TEST_F(Files, a_light_field_of_any_size_comes_back_from_any_tiling) {
    const LightFieldGrid grids[] = {grid_of(1, 1, 1, 1, 1),   grid_of(1, 1, 1, 1, 3),   grid_of(7, 5, 3, 2, 3),
                                    grid_of(1, 13, 11, 1, 1), grid_of(13, 1, 1, 11, 3), grid_of(4, 4, 64, 300, 3)};
    for (const LightFieldGrid& grid : grids)
        for (const SampleType type : {SampleType::half, SampleType::single})
            for (const bool with_depth : {false, true})
                for (const auto& [ns, nt] : {std::pair{1, 1}, {3, 2}, {2, 5}, {100, 1}, {100, 100}}) {
                    const LightFieldBuffer from = random_light_field(grid, with_depth);
                    const auto tile_s = std::min(static_cast<std::size_t>(ns), grid.hogels_s);
                    const auto tile_t = std::min(static_cast<std::size_t>(nt), grid.hogels_t);
                    write_tiles(from, *create_light_field(path_, grid, {type, with_depth, {}}), tile_s, tile_t);
                    const auto source = open_light_field(path_);
                    ASSERT_EQ(source->grid(), grid);
                    ASSERT_EQ(source->has_depth(), with_depth);
                    LightFieldBuffer to(grid, with_depth);
                    write_tiles(from, to, tile_t, tile_s);
                    copy(*source, to);
                    ASSERT_TRUE(same_bits(from.radiance, to.radiance));
                    ASSERT_TRUE(same_bits(from.depth, to.depth));
                }
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()), 1);
}

TEST_F(Files, every_range_of_a_light_field_file_is_the_slice) {
    const LightFieldGrid g = grid_of(5, 4, 3, 2, 3);
    const LightFieldBuffer field = random_light_field(g, true);
    for (const SampleType type : {SampleType::half, SampleType::single}) {
        copy(field, *create_light_field(path_, g, {type, true, {}}));
        const auto source = open_light_field(path_);
        for (std::size_t t0 = 0; t0 < g.hogels_t; ++t0)
            for (std::size_t s0 = 0; s0 < g.hogels_s; ++s0)
                for (std::size_t nt = 1; nt <= g.hogels_t - t0; ++nt)
                    for (std::size_t ns = 1; ns <= g.hogels_s - s0; ++ns) {
                        LightFieldTile a(g, {s0, t0, ns, nt}, true), b(g, {s0, t0, ns, nt}, true);
                        field.read(a);
                        source->read(b);
                        ASSERT_TRUE(same_bits(a.radiance, b.radiance));
                        ASSERT_TRUE(same_bits(a.depth, b.depth));
                    }
        LightFieldTile outside(g, {0, 0, 1, 1}, false);
        outside.range.s0 = g.hogels_s;
        EXPECT_THROW(source->read(outside), Error);
    }
}

TEST_F(Files, directions_spaced_by_sines_come_back_as_such) {
    LightFieldGrid grid = grid_of(2, 2, 3, 5, 1);
    grid.view = Frequencies{grid.range()};
    LightFieldGrid tangents = grid;
    tangents.view = Perspective{tangents.range()};
    for (const LightFieldGrid& one : {grid, tangents}) {
        const LightFieldBuffer field = random_light_field(one, false);
        copy(field, *create_light_field(path_, one, {SampleType::single, false, {}}));
        EXPECT_EQ(open_light_field(path_)->grid(), one);
    }
}

TEST_F(Files, the_faces_of_a_hemicube_come_back_from_one_file) {
    const std::vector<LightFieldGrid> grids = hemicube(grid_of(3, 2, 6, 4, 3));
    for (const bool with_depth : {false, true}) {
        auto sinks = create_light_field_faces(path_, grids, {SampleType::half, with_depth, {{"hogel_note", "cube"}}});
        ASSERT_EQ(sinks.size(), 5u);
        std::vector<LightFieldBuffer> faces;
        for (const LightFieldGrid& grid : grids) faces.push_back(random_light_field(grid, with_depth));
        for (std::size_t i = 0; i < 5; ++i) {
            EXPECT_EQ(fs::exists(path_), with_depth) << "has its name before the last face";
            copy(faces[i], *sinks[i]);
        }
        const auto sources = open_light_field_faces(path_);
        ASSERT_EQ(sources.size(), 5u);
        for (std::size_t i = 0; i < 5; ++i) {
            ASSERT_EQ(sources[i]->grid(), grids[i]);
            ASSERT_EQ(sources[i]->has_depth(), with_depth);
            LightFieldBuffer back(grids[i], with_depth);
            copy(*sources[i], back);
            EXPECT_TRUE(same_bits(back.radiance, faces[i].radiance));
            EXPECT_TRUE(same_bits(back.depth, faces[i].depth));
        }
        EXPECT_EQ(open_light_field(path_)->grid(), grids[0]);
        EXPECT_EQ(std::ranges::count(summarize(path_).text,
                                     std::pair<std::string, std::string>("faces", "front left right top bottom")),
                  1);
    }
    const auto refused = [&](std::vector<LightFieldGrid> wrong) {
        try {
            create_light_field_faces(path_, wrong);
        } catch (const Error& error) {
            return error.code() == ErrorCode::usage;
        }
        return false;
    };
    EXPECT_TRUE(refused({}));
    EXPECT_TRUE(refused({grids[1]}));
    EXPECT_TRUE(refused({grids[0], grids[1], grids[1]}));
    LightFieldGrid other = grids[1];
    other.hogels_s = 7;
    EXPECT_TRUE(refused({grids[0], other}));
    LightFieldGrid aside = grids[0];
    aside.range().center_u = 0.3;
    copy(random_light_field(aside, false), *create_light_field(path_, aside));
    EXPECT_EQ(open_light_field(path_)->grid(), aside);
}

TEST_F(Files, a_hologram_of_any_size_comes_back) {
    for (const auto& [width, height] :
         {std::pair<std::size_t, std::size_t>{1, 1}, {1, 17}, {2311, 1301}, {1024, 1024}}) {
        const std::vector<FieldGrid> grids{plane_of(width, height), plane_of(height, width)};
        const Field first = random_field(grids[0]), second = random_field(grids[1]);
        auto sinks = create_hologram(path_, grids, {.metadata = {{"hogel_command", "hologram a.h5"}}});
        ASSERT_EQ(sinks.size(), 2u);
        copy(first, *sinks[0]);
        EXPECT_TRUE(!fs::exists(path_) || width != 1 || height != 1) << "has its name before the last field";
        copy(second, *sinks[1]);
        const HologramFile file = open_hologram(path_);
        ASSERT_EQ(file.fields.size(), 2u);
        EXPECT_EQ(file.fields[0]->grid(), grids[0]);
        EXPECT_EQ(file.fields[1]->grid(), grids[1]);
        EXPECT_EQ(file.metadata, (Metadata{{"hogel_command", "hologram a.h5"}}));
        Field back_first(grids[0]), back_second(grids[1]);
        copy(*file.fields[0], back_first);
        copy(*file.fields[1], back_second);
        EXPECT_TRUE(same_bits(first.samples, back_first.samples));
        EXPECT_TRUE(same_bits(second.samples, back_second.samples));
        Array<std::complex<float>, 2> one({1, 1});
        EXPECT_THROW(file.fields[0]->read({width, 0, 1, 1}, 0, one), Error);
        EXPECT_THROW(file.fields[0]->read({0, 0, 1, 1}, 1, one), Error);
    }
}

TEST_F(Files, a_hologram_of_halves_comes_back_to_eleven_bits) {
    const FieldGrid grid = plane_of(1301, 1030);
    Field field = random_field(grid);
    for (auto& sample : field.samples.elements()) sample *= 1e-6f;
    copy(field, *create_hologram(path_, {&grid, 1}, {.type = SampleType::half})[0]);
    const HologramFile file = open_hologram(path_);
    EXPECT_EQ(file.fields.at(0)->grid(), grid);
    EXPECT_LT(fs::file_size(path_), 4 * grid.plane.samples() + 8192);
    EXPECT_EQ(std::ranges::count(summarize(path_).text, std::pair<std::string, std::string>{"samples", "half"}), 1);
    Field back(grid);
    copy(*file.fields[0], back);
    const auto same = [](float value, float kept) {
        return std::abs(kept - value) <= std::max(std::abs(value) * 0x1p-11f, 0x1p-25f);
    };
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        ASSERT_TRUE(same(field.samples.data()[i].real(), back.samples.data()[i].real())) << i;
        ASSERT_TRUE(same(field.samples.data()[i].imag(), back.samples.data()[i].imag())) << i;
    }
    Array<std::complex<float>, 2> part({3, 5});
    file.fields[0]->read({1290, 1020, 5, 3}, 0, part);
    EXPECT_EQ(part(2, 4), back.samples(1022, 1294));

    field.samples(700, 5) = {0, -65505};
    const auto sinks = create_hologram(path_, {&grid, 1}, {.type = SampleType::half});
    try {
        copy(field, *sinks[0]);
        ADD_FAILURE() << "wrote an infinite sample";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_SAYS(std::string(error.what()), "65505");
    }
}

TEST_F(Files, tell_what_they_are) {
    const LightFieldGrid grid = grid_of(3, 2, 5, 4, 3);
    const Metadata words{{"hogel_command", "render 'ünïcode'\twith tab"}, {"hogel_version", "0.1.0"}, {"empty", ""}};
    copy(random_light_field(grid, true), *create_light_field(path_, grid, {SampleType::half, true, words}));
    EXPECT_EQ(file_kind(path_), FileKind::light_field);
    const FileSummary summary = summarize(path_);
    EXPECT_EQ(summary.kind, FileKind::light_field);
    for (const auto& word : words) EXPECT_EQ(std::ranges::count(summary.text, word), 1) << word.first;
    const auto number = [](const FileSummary& all, const std::string& name) {
        const auto found = std::ranges::find(all.numbers, name, &std::pair<std::string, double>::first);
        return found == all.numbers.end() ? NAN : found->second;
    };
    EXPECT_EQ(number(summary, "hogels_s"), 3);
    EXPECT_EQ(number(summary, "hogel_pitch_m"), grid.pitch);
    EXPECT_EQ(number(summary, "bytes"), static_cast<double>(fs::file_size(path_)));
    EXPECT_NEAR(number(summary, "field_of_view_u_deg"), 43.6028, 1e-4);  // 2 atan 0.4

    const fs::path hologram = directory_ / "name_without_extension";
    const FieldGrid plane = plane_of(4, 3);
    copy(random_field(plane), *create_hologram(hologram, {&plane, 1})[0]);
    EXPECT_EQ(file_kind(hologram), FileKind::hologram);
    EXPECT_EQ(number(summarize(hologram), "field0_wavelength_m"), plane.wavelength);
    EXPECT_EQ(number(summarize(hologram), "fields"), 1);

    for (const auto& [name, kind] :
         {std::pair{"a.PNG", FileKind::picture}, {"a.glb", FileKind::mesh}, {"a.txt", FileKind::unknown}}) {
        save(directory_ / name, "x");
        EXPECT_EQ(file_kind(directory_ / name), kind);
        EXPECT_EQ(summarize(directory_ / name).kind, kind);
    }
    EXPECT_THROW(file_kind(directory_ / "missing.h5"), Error);
    EXPECT_THROW(file_kind(directory_), Error);
    // The one kind is not the other.
    EXPECT_SAYS(refusal(hologram), "'hogel hologram', but a 'hogel light field'");
    EXPECT_THROW(open_hologram(path_), Error);
}

TEST_F(Files, unfinished_files_leave_nothing_and_keep_the_old_one) {
    const LightFieldGrid grid = grid_of(3, 2, 5, 4, 3);
    const LightFieldBuffer field = random_light_field(grid, false);
    copy(field, *create_light_field(path_, grid));
    const std::string old = text_of(path_);
    {
        const auto sink = create_light_field(path_, grid);
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

TEST_F(Files, creating_says_what_is_in_the_way) {
    const auto creating = [](const fs::path& path, const LightFieldGrid& grid, ErrorCode code,
                             const Metadata& words = {}) -> std::string {
        try {
            create_light_field(path, grid, {SampleType::half, false, words});
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
    // 2^58 samples fit no disk: found out before the first sample.
    const std::size_t many = std::size_t{1} << 14;
    EXPECT_SAYS(creating(path_, grid_of(many, many, many, many, 1), ErrorCode::cannot_write), path_.string());
    EXPECT_SAYS(creating(path_, grid, ErrorCode::usage, {{"format", "mine"}}), "reserved");
    EXPECT_SAYS(creating(path_, grid, ErrorCode::usage, {{"a", "1"}, {"a", "2"}}), "twice");
    EXPECT_SAYS(creating(path_, grid, ErrorCode::usage, {{"a", std::string(70000, 'x')}}), "more than a file holds");
    EXPECT_THROW(create_hologram(path_, {}), Error);
    EXPECT_TRUE(fs::is_empty(directory_));
    // Much metadata, whose header does not fit in one piece, is fine.
    Metadata much;
    for (int i = 0; i < 200; ++i) much.emplace_back("word" + std::to_string(i), std::string(5000, 'y'));
    copy(random_light_field(grid, false), *create_light_field(path_, grid, {SampleType::half, false, much}));
    EXPECT_EQ(refusal(path_), "");
    EXPECT_EQ(std::ranges::count(summarize(path_).text, much[199]), 1);
}

TEST_F(Files, a_full_disk_is_an_error_at_once) {
    const LightFieldGrid grid = grid_of(16, 16, 64, 64, 3);
    for (const rlim_t limit : {rlim_t{0}, rlim_t{1000}, rlim_t{100000}, rlim_t{2} << 20}) {
        const pid_t child = fork();
        if (child == 0) {
            std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files then fails like a full disk does
            const rlimit size{limit, limit};
            setrlimit(RLIMIT_FSIZE, &size);
            int status = 1;
            try {
                create_light_field(path_, grid);
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

TEST_F(Files, missing_foreign_and_truncated_files_are_refused) {
    EXPECT_SAYS(refusal(path_), "No such file");
    EXPECT_SAYS(refusal(directory_), "not a plain file");
    save(path_, "");
    EXPECT_SAYS(refusal(path_), "not an HDF5 file");
    save(path_, std::string(1000, 'x'));
    EXPECT_SAYS(refusal(path_), "not an HDF5 file");
    const LightFieldGrid grid = grid_of(3, 2, 5, 4, 3);
    copy(random_light_field(grid, true), *create_light_field(path_, grid, {SampleType::half, true, {{"a", "b"}}}));
    const std::string whole = text_of(path_);
    for (std::size_t length = 0; length < whole.size(); length += length < 300 ? 1 : 97) {
        save(path_, whole.substr(0, length));
        EXPECT_NE(refusal(path_), "") << length;
    }
    save(path_, whole.substr(0, whole.size() - 1));
    EXPECT_NE(refusal(path_), "");
}

// Damages each byte of a file, but those of the samples, in turn, and reads it: an Error may come out or nothing.
template <class Samples, class Read>
void damage_every_byte(const fs::path& path, const Samples& samples, const Read& read) {
    const std::string whole = text_of(path);
    const std::string_view bytes(reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(samples[0]));
    const std::size_t first_sample = whole.find(bytes);
    ASSERT_NE(first_sample, std::string::npos);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const auto put = [&](std::size_t at, char value) {
        file.seekp(static_cast<std::streamoff>(at)).put(value).flush();
    };
    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        if (at == first_sample) at += bytes.size();
        if (at >= whole.size()) break;
        for (const int change : {0x01, 0x80, 0xff}) {
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
    EXPECT_GT(refused, 1000u) << "checksums cover the headers";
}

TEST_F(Files, a_light_field_damaged_in_any_byte_of_its_header_is_refused_or_unchanged) {
    const LightFieldGrid grid = grid_of(2, 3, 4, 5, 3);
    const LightFieldBuffer field = random_light_field(grid, false);
    copy(field, *create_light_field(path_, grid, {SampleType::single, false, {{"hogel_command", "x"}}}));
    damage_every_byte(path_, field.radiance.elements(), [&] {
        const auto source = open_light_field(path_);
        EXPECT_EQ(source->grid(), grid);
        LightFieldBuffer back(grid);
        copy(*source, back);
        EXPECT_TRUE(same_bits(back.radiance, field.radiance));
        summarize(path_);
    });
}

TEST_F(Files, a_side_face_damaged_in_any_byte_of_its_header_is_refused_or_unchanged) {
    std::vector<LightFieldGrid> grids = hemicube(grid_of(1, 1, 2, 2, 1));
    grids.resize(2);
    auto sinks = create_light_field_faces(path_, grids, {SampleType::single, false, {}});
    const LightFieldBuffer front = random_light_field(grids[0], false), left = random_light_field(grids[1], false);
    copy(front, *sinks[0]);
    copy(left, *sinks[1]);
    damage_every_byte(path_, front.radiance.elements(), [&] {
        const auto faces = open_light_field_faces(path_);
        ASSERT_EQ(faces.size(), 2u);
        for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(faces[i]->grid(), grids[i]);
        LightFieldBuffer back(grids[0]);
        copy(*faces[0], back);
        EXPECT_TRUE(same_bits(back.radiance, front.radiance));
    });
}

TEST_F(Files, a_hologram_damaged_in_any_byte_of_its_header_is_refused_or_unchanged) {
    const FieldGrid grid = plane_of(7, 5);
    Field field = random_field(grid);
    // What halves keep as it is.
    for (auto& sample : field.samples.elements()) {
        const auto kept = [](float part) { return core::float_of(core::half_of(1e-6f * part)); };
        sample = {kept(sample.real()), kept(sample.imag())};
    }
    std::vector<std::uint16_t> halves(2 * field.samples.size());
    core::to_half(reinterpret_cast<const float*>(field.samples.data()), halves.data(), halves.size());
    const auto read = [&] {
        const HologramFile file = open_hologram(path_);
        EXPECT_EQ(file.fields.at(0)->grid(), grid);
        Field back(grid);
        copy(*file.fields[0], back);
        EXPECT_TRUE(same_bits(back.samples, field.samples));
        summarize(path_);
    };
    copy(field, *create_hologram(path_, {&grid, 1}, {SampleType::single, {{"hogel_command", "x"}}})[0]);
    damage_every_byte(path_, field.samples.elements(), read);
    copy(field, *create_hologram(path_, {&grid, 1}, {SampleType::half, {{"hogel_command", "x"}}})[0]);
    damage_every_byte(path_, halves, read);
}

TEST_F(Files, many_threads_open_read_and_write_at_once) {
    const LightFieldGrid grid = grid_of(7, 5, 3, 2, 3);
    const LightFieldBuffer field = random_light_field(grid, true);
    std::atomic<int> good{0};
    core::parallel_for(40, [&](std::size_t i) {
        const fs::path path = directory_ / (std::to_string(i) + ".h5");
        copy(field, *create_light_field(path, grid, {SampleType::half, true, {}}));
        LightFieldBuffer back(grid, true);
        copy(*open_light_field(path), back);
        good += same_bits(back.radiance, field.radiance) && same_bits(back.depth, field.depth);
        // The same target from all threads: each write is whole.
        copy(field, *create_light_field(path_, grid));
    });
    EXPECT_EQ(good, 40);
    EXPECT_EQ(refusal(path_), "");
}

}  // namespace
}  // namespace hogel::io
