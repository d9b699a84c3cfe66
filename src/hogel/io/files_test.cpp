// SPDX-License-Identifier: Apache-2.0
#include "hogel/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "hogel/io/test_files.h"
#include "hogel/lightfield/channel_source.h"
#include "hogel/work/parallel.h"

// Suppressions for leak checkers: HDF5 1.10 leaks data when a checksum is wrong.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace hogel::io {
namespace {

// Writes tiles of a given size in random order from several threads.
void write_tiles(const LightFieldBuffer& from, LightFieldSink& sink, std::size_t ns, std::size_t nt) {
    const LightFieldGrid& g = from.grid();
    std::vector<HogelRange> ranges;
    for (std::size_t t = 0; t < g.hogels_t; t += nt)
        for (std::size_t s = 0; s < g.hogels_s; s += ns)
            ranges.push_back({s, t, std::min(ns, g.hogels_s - s), std::min(nt, g.hogels_t - t)});
    std::ranges::shuffle(ranges, std::mt19937(3));
    work::parallel_for(ranges.size(), [&](std::size_t i) {
        LightFieldTile tile(g, ranges[i], from.has_depth());
        from.read(tile);
        sink.write(tile);
    });
    sink.finish();
}

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
                    write_tiles(from, *create_front(path_, grid, {type, with_depth, {}}), tile_s, tile_t);
                    const LightField source = open_light_field(path_);
                    ASSERT_EQ(source.grid(), grid);
                    ASSERT_EQ(source.has_depth(), with_depth);
                    LightFieldBuffer to(grid, with_depth);
                    write_tiles(from, to, tile_t, tile_s);
                    copy(source.front(), to);
                    ASSERT_TRUE(same_bits(from.radiance, to.radiance));
                    ASSERT_TRUE(same_bits(from.depth, to.depth));
                }
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()), 1);
}

TEST_F(Files, a_sample_that_is_not_finite_is_refused_by_place) {
    constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const FieldGrid grid{{70, 9, 1e-6, 1e-6, 0, 0}, 532e-9};
    struct Case {
        std::complex<float> value;
        SampleType type;
        const char* shown;
    };
    for (const Case& wrong : {Case{{infinity, 1}, SampleType::single, "inf+1i"},
                              {{2, -infinity}, SampleType::single, "2-infi"},
                              {{nan, 1}, SampleType::single, "nan+1i"},
                              {{1, nan}, SampleType::half, "1+nani"}}) {
        const std::vector<FieldGrid> grids{grid, grid};
        const auto sinks = create_hologram(path_, grids, {wrong.type});
        for (const auto& sink : sinks) {
            Field field(grid);
            if (sink == sinks.back()) field.samples(7, 64) = wrong.value;
            sink->write({0, 0, 70, 9}, field.samples);
            sink->finish();
        }
        const Fields fields = open_hologram(path_);
        const auto read = [&](std::size_t field, const Region& region) {
            Array<std::complex<float>, 2> samples({region.height, region.width});
            fields[field]->read(region, 0, samples);
        };
        EXPECT_NO_THROW(read(0, {0, 0, 70, 9}));
        EXPECT_NO_THROW(read(1, {0, 0, 64, 9}));
        for (const Region& region : {Region{0, 0, 70, 9}, {60, 5, 7, 3}, {64, 7, 1, 1}}) {
            try {
                read(1, region);
                ADD_FAILURE() << "took " << wrong.shown;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::bad_input);
                EXPECT_SAYS(std::string(error.what()), "row 7 and column 64 of its field 1, from 0, is ");
                EXPECT_SAYS(std::string(error.what()), wrong.shown);
            }
        }
    }
}

TEST_F(Files, every_range_of_a_light_field_file_is_read_alone) {
    const LightFieldGrid g = grid_of(5, 4, 3, 2, 3);
    const LightFieldBuffer field = random_light_field(g, true);
    for (const SampleType type : {SampleType::half, SampleType::single}) {
        copy(field, *create_front(path_, g, {type, true, {}}));
        const LightField source = open_light_field(path_);
        for (std::size_t t0 = 0; t0 < g.hogels_t; ++t0)
            for (std::size_t s0 = 0; s0 < g.hogels_s; ++s0)
                for (std::size_t nt = 1; nt <= g.hogels_t - t0; ++nt)
                    for (std::size_t ns = 1; ns <= g.hogels_s - s0; ++ns) {
                        LightFieldTile a(g, {s0, t0, ns, nt}, true), b(g, {s0, t0, ns, nt}, true);
                        field.read(a);
                        source.front().read(b);
                        ASSERT_TRUE(same_bits(a.radiance, b.radiance));
                        ASSERT_TRUE(same_bits(a.depth, b.depth));
                        for (std::size_t channel = 0; channel < g.channels; ++channel) {
                            Array<float, 4> one({nt, ns, g.directions_v, g.directions_u});
                            dynamic_cast<const lightfield::ChannelSource&>(source.front())
                                .read_channel(channel, a.range, one);
                            ASSERT_TRUE(std::ranges::equal(one.elements(), a.radiance.view()[channel].elements()));
                        }
                    }
        LightFieldTile outside(g, {0, 0, 1, 1}, false);
        outside.range.s0 = g.hogels_s;
        EXPECT_THROW(source.front().read(outside), Error);
    }
}

TEST_F(Files, directions_uniform_in_sines_come_back_as_such) {
    LightFieldGrid grid = grid_of(2, 2, 3, 5, 1);
    grid.view = Frequencies{grid.range()};
    LightFieldGrid tangents = grid;
    tangents.view = Perspective{tangents.range()};
    for (const LightFieldGrid& one : {grid, tangents}) {
        const LightFieldBuffer field = random_light_field(one, false);
        copy(field, *create_front(path_, one, {SampleType::single, false, {}}));
        EXPECT_EQ(open_light_field(path_).grid(), one);
    }
}

TEST_F(Files, a_fixed_focal_plane_comes_back_and_is_no_perspective_to_who_does_not_know_it) {
    LightFieldGrid grid = grid_of(2, 3, 3, 5, 1);
    grid.view = FocalPlane{{0.4, 0.3, 0.1, -0.2}, -0.5};
    const LightFieldBuffer field = random_light_field(grid, true);
    copy(field, *create_front(path_, grid, {SampleType::single, true, {}}));
    EXPECT_EQ(open_light_field(path_).grid(), grid);
    LightFieldBuffer back(grid, true);
    copy(open_light_field(path_).front(), back);
    EXPECT_TRUE(same_bits(back.radiance, field.radiance));
    EXPECT_TRUE(same_bits(back.depth, field.depth));
    const auto number = [&](const std::string& name) {
        for (const auto& [key, value] : summarize(path_).numbers)
            if (key == name) return value;
        return std::nan("");
    };
    EXPECT_EQ(number("focal_plane_m"), -0.5);
    EXPECT_EQ(number("focal_half_u"), 0.4);
    EXPECT_TRUE(std::isnan(number("tan_half_u")));
}

TEST_F(Files, the_faces_of_a_hemicube_come_back_from_one_file) {
    const std::vector<LightFieldGrid> grids = hemicube(grid_of(3, 2, 6, 4, 3));
    for (const bool with_depth : {false, true}) {
        auto sinks = create_light_field(path_, grids, {SampleType::half, with_depth, {{"hogel_note", "cube"}}});
        ASSERT_EQ(sinks.size(), 5u);
        std::vector<LightFieldBuffer> faces;
        for (const LightFieldGrid& grid : grids) faces.push_back(random_light_field(grid, with_depth));
        for (std::size_t i = 0; i < 5; ++i) {
            EXPECT_EQ(fs::exists(path_), with_depth) << "has its name before the last face";
            copy(faces[i], *sinks[i]);
        }
        const LightField light_field = open_light_field(path_);
        const auto sources = light_field.faces();
        ASSERT_EQ(sources.size(), 5u);
        for (std::size_t i = 0; i < 5; ++i) {
            ASSERT_EQ(sources[i]->grid(), grids[i]);
            ASSERT_EQ(sources[i]->has_depth(), with_depth);
            LightFieldBuffer back(grids[i], with_depth);
            copy(*sources[i], back);
            EXPECT_TRUE(same_bits(back.radiance, faces[i].radiance));
            EXPECT_TRUE(same_bits(back.depth, faces[i].depth));
        }
        EXPECT_EQ(open_light_field(path_).grid(), grids[0]);
        EXPECT_EQ(std::ranges::count(summarize(path_).text,
                                     std::pair<std::string, std::string>("faces", "front left right top bottom")),
                  1);
    }
    const auto refused = [&](std::vector<LightFieldGrid> wrong) {
        try {
            create_light_field(path_, wrong);
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
    copy(random_light_field(aside, false), *create_front(path_, aside));
    EXPECT_EQ(open_light_field(path_).grid(), aside);
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
        const Fields fields = open_hologram(path_);
        ASSERT_EQ(fields.size(), 2u);
        EXPECT_EQ(fields[0]->grid(), grids[0]);
        EXPECT_EQ(fields[1]->grid(), grids[1]);
        EXPECT_EQ(fields.front()->provenance().entries, (Metadata{{"hogel_command", "hologram a.h5"}}));
        Field back_first(grids[0]), back_second(grids[1]);
        copy(*fields[0], back_first);
        copy(*fields[1], back_second);
        EXPECT_TRUE(same_bits(first.samples, back_first.samples));
        EXPECT_TRUE(same_bits(second.samples, back_second.samples));
        Array<std::complex<float>, 2> one({1, 1});
        EXPECT_THROW(fields[0]->read({width, 0, 1, 1}, 0, one), Error);
        EXPECT_THROW(fields[0]->read({0, 0, 1, 1}, 1, one), Error);
    }
}

TEST_F(Files, a_hologram_of_halves_comes_back_to_eleven_bits) {
    const FieldGrid grid = plane_of(1301, 1030);
    Field field = random_field(grid);
    for (auto& sample : field.samples.elements()) sample *= 1e-6f;
    copy(field, *create_hologram(path_, {&grid, 1}, {.type = SampleType::half})[0]);
    const Fields fields = open_hologram(path_);
    EXPECT_EQ(fields.at(0)->grid(), grid);
    EXPECT_LT(fs::file_size(path_), 4 * grid.plane.samples() + 8192);
    EXPECT_EQ(std::ranges::count(summarize(path_).text, std::pair<std::string, std::string>{"samples", "half"}), 1);
    Field back(grid);
    copy(*fields[0], back);
    const auto same = [](float value, float kept) {
        return std::abs(kept - value) <= std::max(std::abs(value) * 0x1p-11f, 0x1p-25f);
    };
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        ASSERT_TRUE(same(field.samples.data()[i].real(), back.samples.data()[i].real())) << i;
        ASSERT_TRUE(same(field.samples.data()[i].imag(), back.samples.data()[i].imag())) << i;
    }
    Array<std::complex<float>, 2> part({3, 5});
    fields[0]->read({1290, 1020, 5, 3}, 0, part);
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

TEST_F(Files, say_what_they_are) {
    const LightFieldGrid grid = grid_of(3, 2, 5, 4, 3);
    const Metadata metadata{{"hogel_command", "render 'ünïcode'\twith tab"}, {"hogel_version", "0.1.0"}, {"empty", ""}};
    copy(random_light_field(grid, true), *create_front(path_, grid, {SampleType::half, true, metadata}));
    EXPECT_EQ(file_kind(path_), FileKind::light_field);
    const FileSummary summary = summarize(path_);
    EXPECT_EQ(summary.kind, FileKind::light_field);
    for (const auto& entry : metadata) EXPECT_EQ(std::ranges::count(summary.text, entry), 1) << entry.first;
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
    // A hologram is refused as a light field, and the reverse.
    EXPECT_SAYS(refusal(hologram), "'hogel hologram', but a 'hogel light field'");
    EXPECT_THROW(open_hologram(path_), Error);
}

TEST_F(Files, formats_name_every_extension_once_and_pictures_and_meshes_are_known_by_it) {
    std::vector<std::string> extensions;
    for (const FileFormat& format : file_formats().rows()) {
        EXPECT_FALSE(format.text.empty()) << format.name;
        const std::vector<FileKind>& kinds = format.reads.empty() ? format.writes : format.reads;
        ASSERT_FALSE(kinds.empty()) << format.name;
        for (const std::string& extension : format.extensions) {
            extensions.push_back(extension);
            save(directory_ / ("x" + extension), "nothing that HDF5 or a compressed light field begins with");
            const FileKind kind = file_kind(directory_ / ("x" + extension));
            const bool by_name = kinds == std::vector{FileKind::picture} || kinds == std::vector{FileKind::mesh};
            EXPECT_EQ(kind, by_name ? kinds[0] : FileKind::unknown) << extension;
        }
        for (const FileKind kind : format.writes)
            if (kind == FileKind::picture) {
                EXPECT_NO_THROW(format.name == "bmp" ? require_raw_pixels_name("x.bmp")
                                                     : require_picture_name("x" + format.extensions.front()));
            }
    }
    std::ranges::sort(extensions);
    EXPECT_TRUE(std::ranges::adjacent_find(extensions) == extensions.end());
}

// The extension of a file must match its format.
TEST_F(Files, names_of_other_formats_are_refused) {
    const auto refused = [&](const char* name, const char* format) {
        try {
            require_name(directory_ / name, format);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage) << name;
            return true;
        }
        return false;
    };
    for (const char* name : {"x.npy", "x.hgl", "x.PNG", "x.exr", "x.mat", "x.glb", "x.tif", "y.h5.jpg"})
        EXPECT_TRUE(refused(name, "hdf5")) << name;
    for (const char* name : {"x.h5", "x.H5", "x.hdf5", "x", "x.field", "x.png.h5"})
        EXPECT_FALSE(refused(name, "hdf5")) << name;
    EXPECT_TRUE(refused("x.h5", "hgl"));
    EXPECT_FALSE(refused("x.hgl", "hgl"));
    const LightFieldGrid grid = grid_of(1, 1, 1, 1, 1);
    EXPECT_THROW(create_light_field(directory_ / "x.npy", {&grid, 1}), Error);
    const FieldGrid field{{2, 2, 1e-6, 1e-6, 0, 0}, 5e-7};
    EXPECT_THROW(create_hologram(directory_ / "x.npy", {&field, 1}), Error);
    EXPECT_THROW(require_folder_name(directory_ / "x.png"), Error);
    EXPECT_NO_THROW(require_folder_name(directory_ / "x.2"));
    fs::create_directory(directory_ / "y.png");
    EXPECT_NO_THROW(require_folder_name(directory_ / "y.png"));
    fs::remove(directory_ / "y.png");
    EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(Files, many_threads_open_read_and_write_at_once) {
    const LightFieldGrid grid = grid_of(7, 5, 3, 2, 3);
    const LightFieldBuffer field = random_light_field(grid, true);
    std::atomic<int> good{0};
    work::parallel_for(40, [&](std::size_t i) {
        const fs::path path = directory_ / (std::to_string(i) + ".h5");
        copy(field, *create_front(path, grid, {SampleType::half, true, {}}));
        LightFieldBuffer back(grid, true);
        copy(open_light_field(path).front(), back);
        good += same_bits(back.radiance, field.radiance) && same_bits(back.depth, field.depth);
        // All threads write the same file, which must be complete in the end.
        copy(field, *create_front(path_, grid));
    });
    EXPECT_EQ(good, 40);
    EXPECT_EQ(refusal(path_), "");
}

}  // namespace
}  // namespace hogel::io
