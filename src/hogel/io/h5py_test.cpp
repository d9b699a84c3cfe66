// SPDX-License-Identifier: Apache-2.0
// Tests the statements of docs/files.md about h5py: examples run, values are right, files made by h5py are read.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "hogel/io/test_files.h"
#include "hogel/lightfield/channel_source.h"

namespace hogel::io {
namespace {

class H5py : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(directory_);
        for (const char* candidate : {"/usr/bin/python3", "python3"})
            if (std::system((std::string(candidate) + " -c 'import h5py' 2>/dev/null").c_str()) == 0) {
                python_ = candidate;
                return;
            }
        GTEST_SKIP() << "there is no Python with h5py";
    }
    ~H5py() override { fs::remove_all(directory_); }

    // Runs a script with a file as its argument and expects success; returns what it prints.
    std::string run(const std::string& script, const fs::path& argument) {
        std::ofstream(directory_ / "script.py") << script;
        const fs::path output = directory_ / "output.txt";
        const std::string command = python_ + " '" + (directory_ / "script.py").string() + "' '" + argument.string() +
                                    "' >'" + output.string() + "' 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0) << text_of(output);
        return text_of(output);
    }

    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_h5py_" + std::to_string(::getpid()));
    std::string python_;
};

LightFieldGrid small_grid() {
    LightFieldGrid grid;
    grid.hogels_s = 5;
    grid.hogels_t = 4;
    grid.pitch = 0.001;
    grid.directions_u = 3;
    grid.directions_v = 2;
    grid.range().half_u = 0.3;
    grid.range().half_v = 0.2;
    return grid;
}

// Whole numbers below 2048, which are exact as half floats.
LightFieldBuffer numbered(const LightFieldGrid& grid) {
    LightFieldBuffer field(grid, true);
    for (std::size_t i = 0; i < field.radiance.size(); ++i) field.radiance.data()[i] = static_cast<float>(i);
    for (std::size_t i = 0; i < field.depth.size(); ++i) field.depth.data()[i] = -0.5f * static_cast<float>(i);
    return field;
}

Field numbered(const FieldGrid& grid) {
    Field field(grid);
    for (std::size_t i = 0; i < field.samples.size(); ++i)
        field.samples.data()[i] = {static_cast<float>(i), -2 * static_cast<float>(i)};
    return field;
}

void write_hemicube(const fs::path& path, const LightFieldGrid& grid) {
    const std::vector<LightFieldGrid> grids = hemicube(grid);
    const auto sinks = create_light_field(path, grids, {SampleType::half, true, {}});
    for (std::size_t i = 0; i < grids.size(); ++i) copy(numbered(grids[i]), *sinks[i]);
}

std::vector<std::string> examples() {
    const std::string page = text_of(fs::path(__FILE__).parent_path() / "../../../docs/files.md");
    const std::string open = "```python\n", close = "```\n";
    std::vector<std::string> found;
    for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
        at += open.size();
        found.push_back(page.substr(at, page.find(close, at) - at));
    }
    return found;
}

TEST_F(H5py, runs_the_examples_of_the_documentation) {
    ASSERT_EQ(examples().size(), 4u);
    copy(numbered(small_grid()), *create_front(directory_ / "l.h5", small_grid(), {SampleType::half, true, {}}));
    // Largest of the view: sample (2, 3, 4, 1, 1) = 358; mean of hogel (0, 0): mean of 0..5, 120..125 and 240..245.
    EXPECT_EQ(run(examples()[0], directory_ / "l.h5"),
              "(3, 4, 5, 2, 3) float16 -0.002 -0.19999999999999998 358.0 122.5\n");
    LightFieldGrid focal = small_grid();
    focal.view = FocalPlane{{0.3, 0.3}, -0.1};
    copy(numbered(focal), *create_front(directory_ / "p.h5", focal, {SampleType::half, false, {}}));
    // u = −0.2, 0, 0.2, and s of the outer hogels −2 and 2 mm.
    EXPECT_EQ(run(examples()[1], directory_ / "p.h5"),
              "-0.1 [ 0.02 -0.   -0.02] [-0.22 -0.02  0.18] [-0.18  0.02  0.22]\n");
    LightFieldGrid even = small_grid();
    even.directions_u = 4;
    write_hemicube(directory_ / "h.h5", even);
    // 4x2 directions in front and 2x2 or 4x1 at the sides; the direction of the last sample of each.
    EXPECT_EQ(run(examples()[2], directory_ / "h.h5"),
              "front (3, 4, 5, 2, 4) [0.75, -0.5, 1.0]\n"
              "left (3, 4, 5, 2, 2) [-1.0, -0.5, 0.75]\n"
              "right (3, 4, 5, 2, 2) [1.0, -0.5, 0.25]\n"
              "top (3, 4, 5, 1, 4) [0.75, 1.0, 0.5]\n"
              "bottom (3, 4, 5, 1, 4) [0.75, -1.0, 0.5]\n");
    const FieldGrid plane{{3, 2, 1e-6, 1e-6, 0, 0}, 5e-7};
    copy(numbered(plane), *create_hologram(directory_ / "f.h5", {&plane, 1})[0]);
    // Mean of 5 i^2 for i = 0..5.
    EXPECT_EQ(run(examples()[3], directory_ / "f.h5").substr(0, 37), "field0 (2, 3) complex64 5e-07 45.8333");
}

TEST_F(H5py, reads_every_value_and_attribute) {
    const LightFieldGrid grid = small_grid();
    for (const SampleType type : {SampleType::half, SampleType::single}) {
        copy(numbered(grid), *create_front(directory_ / "l.h5", grid, {type, true, {{"hogel_note", "ζ = 1"}}}));
        run(std::string("import sys, h5py, numpy as np\n"
                        "f = h5py.File(sys.argv[1], 'r')\n"
                        "r, d = f['radiance'], f['depth']\n"
                        "assert r.dtype == np.") +
                (type == SampleType::half ? "float16" : "float32") +
                "\n"
                "assert (r[...].ravel() == np.arange(360)).all() and r.shape == (3, 4, 5, 2, 3)\n"
                "assert d.dtype == np.float32 and (d[...].ravel() == -0.5 * np.arange(120)).all() and d.shape == (4, "
                "5, 2, 3)\n"
                "a = r.attrs\n"
                "assert a['axis_order'] == b'c,t,s,v,u' and d.attrs['unit'] == b'm' and d.attrs['axis_order'] == "
                "b't,s,v,u'\n"
                "assert a['channels'] == 3 and a['hogels_s'] == 5 and a['hogels_t'] == 4 and a['hogel_pitch_m'] == "
                "0.001\n"
                "assert a['directions_u'] == 3 and a['directions_v'] == 2 and a['tan_half_u'] == 0.3 and "
                "a['tan_half_v'] == 0.2\n"
                "assert f.attrs['hogel_note'].decode() == '\\u03b6 = 1' and f.attrs['format_version'] == 1\n",
            directory_ / "l.h5");
    }
    LightFieldGrid even = grid;
    even.directions_u = 4;
    write_hemicube(directory_ / "h.h5", even);
    run("import sys, h5py, numpy as np\n"
        "f = h5py.File(sys.argv[1], 'r')\n"
        "assert sorted(f) == ['bottom', 'depth', 'left', 'radiance', 'right', 'top']\n"
        "assert f['radiance'].attrs['face'] == b'front' and f['radiance'].attrs['center_u'] == 0\n"
        "for name, shape, center in (('left', (3, 4, 5, 2, 2), (0.5, 0)), ('right', (3, 4, 5, 2, 2), (-0.5, 0)),\n"
        "                            ('top', (3, 4, 5, 1, 4), (0, -0.5)), ('bottom', (3, 4, 5, 1, 4), (0, 0.5))):\n"
        "    r, d = f[name]['radiance'], f[name]['depth']\n"
        "    assert r.shape == shape and (r[...].ravel() == np.arange(r.size)).all()\n"
        "    assert (d[...].ravel() == -0.5 * np.arange(d.size)).all() and d.attrs['unit'] == b'm'\n"
        "    assert r.attrs['face'].decode() == name and (r.attrs['center_u'], r.attrs['center_v']) == center\n"
        "    assert r.attrs['directions_u'] == shape[4] and r.attrs['tan_half_u'] == shape[4] / 4\n",
        directory_ / "h.h5");
    const FieldGrid planes[] = {{{3, 2, 1e-6, 2e-6, 0.25, -0.5}, 5e-7}, {{2, 3, 1e-6, 2e-6, 0, 0}, 6e-7}};
    auto sinks = create_hologram(directory_ / "f.h5", planes);
    for (std::size_t i = 0; i < 2; ++i) copy(numbered(planes[i]), *sinks[i]);
    run("import sys, h5py, numpy as np\n"
        "f = h5py.File(sys.argv[1], 'r')\n"
        "assert f.attrs['format'] == b'hogel hologram' and list(f) == ['field0', 'field1']\n"
        "x, y = f['field0/samples'], f['field1/samples']\n"
        "assert x.dtype == np.complex64 and x.shape == (2, 3) and y.shape == (3, 2)\n"
        "assert (x[...].ravel() == (1 - 2j) * np.arange(6)).all()\n"
        "a = x.attrs\n"
        "assert a['wavelength_m'] == 5e-7 and y.attrs['wavelength_m'] == 6e-7 and a['axis_order'] == b'y,x'\n"
        "assert a['pitch_x_m'] == 1e-6 and a['pitch_y_m'] == 2e-6 and a['center_x_m'] == 0.25 and a['center_y_m'] == "
        "-0.5\n"
        "assert a['z_m'] == 0\n",
        directory_ / "f.h5");
    copy(numbered(planes[0]), *create_hologram(directory_ / "g.h5", {planes, 1}, {.type = SampleType::half})[0]);
    run("import sys, h5py, numpy as np\n"
        "x = h5py.File(sys.argv[1], 'r')['field0/samples']\n"
        "assert x.dtype == np.float16 and x.shape == (2, 3, 2) and x.attrs['axis_order'] == b'y,x,part'\n"
        "assert (x.astype('f4')[...].view('c8').ravel() == (1 - 2j) * np.arange(6)).all()\n",
        directory_ / "g.h5");
}

// The same light field as h5py users may store it: compressed, chunked, in another type.
TEST_F(H5py, writes_light_fields_that_are_read) {
    const LightFieldBuffer expected = numbered(small_grid());
    for (const char* storage :
         {"dtype='f2'", "dtype='f4'", "dtype='f8'", "dtype='>f4'",
          "dtype='f2', chunks=(1, 3, 2, 2, 3), compression='gzip'",
          "dtype='f4', chunks=(3, 4, 5, 1, 1), shuffle=True, compression='gzip'", "dtype='f2', chunks=True"}) {
        run(std::string("import sys, h5py, numpy as np\n"
                        "f = h5py.File(sys.argv[1], 'w', libver='v108')\n"
                        "f.attrs['format'] = 'hogel light field'; f.attrs['format_version'] = 1\n"
                        "f.attrs['author'] = 'somebody'\n"
                        "x = np.arange(360).reshape(3, 4, 5, 2, 3)\n"
                        "r = f.create_dataset('radiance', data=x, ") +
                storage +
                ")\n"
                "f.create_dataset('depth', data=-0.5 * np.arange(120).reshape(4, 5, 2, 3), dtype='f4')\n"
                "r.attrs.update(axis_order='c,t,s,v,u', channels=3, hogels_s=5, hogels_t=4, hogel_pitch_m=0.001,\n"
                "               directions_u=3, directions_v=2, tan_half_u=0.3, tan_half_v=0.2)\n",
            directory_ / "l.h5");
        const LightField source = open_light_field(directory_ / "l.h5");
        EXPECT_EQ(source.grid(), small_grid());
        LightFieldBuffer back(small_grid(), true);
        copy(source.front(), back);
        EXPECT_TRUE(std::ranges::equal(back.radiance.elements(), expected.radiance.elements())) << storage;
        EXPECT_TRUE(std::ranges::equal(back.depth.elements(), expected.depth.elements())) << storage;
        LightFieldTile one(small_grid(), {3, 2, 1, 2}, true), same(small_grid(), {3, 2, 1, 2}, true);
        source.front().read(one);
        expected.read(same);
        EXPECT_TRUE(std::ranges::equal(one.radiance.elements(), same.radiance.elements())) << storage;
        EXPECT_EQ(std::ranges::count(summarize(directory_ / "l.h5").text,
                                     std::pair<std::string, std::string>{"author", "somebody"}),
                  1);
    }
}

// Also if only the faulty channel is read.
TEST_F(H5py, writes_radiances_that_are_no_numbers_which_are_refused) {
    for (const char* storage : {"dtype='f2'", "dtype='f4'", "dtype='f4', chunks=True"}) {
        run(std::string("import sys, h5py, numpy as np\n"
                        "f = h5py.File(sys.argv[1], 'w', libver='v108')\n"
                        "f.attrs['format'] = 'hogel light field'; f.attrs['format_version'] = 1\n"
                        "x = np.ones((3, 4, 5, 2, 3))\n"
                        "x[1, 3, 2, 0, 1] = np.nan\n"
                        "r = f.create_dataset('radiance', data=x, ") +
                storage +
                ")\n"
                "r.attrs.update(axis_order='c,t,s,v,u', channels=3, hogels_s=5, hogels_t=4, hogel_pitch_m=0.001,\n"
                "               directions_u=3, directions_v=2, tan_half_u=0.3, tan_half_v=0.2)\n",
            directory_ / "n.h5");
        const LightField source = open_light_field(directory_ / "n.h5");
        const auto refusal = [](const auto& read) -> std::string {
            try {
                read();
            } catch (const Error& error) {
                return error.what();
            }
            return "";
        };
        const std::string expected = "the radiance of its hogel (2, 3) in direction (1, 0), channel 1, is nan";
        LightFieldTile tile(small_grid(), {1, 2, 3, 2}, false);
        EXPECT_NE(refusal([&] { source.front().read(tile); }).find(expected), std::string::npos) << storage;
        Array<float, 4> one({2, 3, 2, 3});
        const auto& channels = dynamic_cast<const lightfield::ChannelSource&>(source.front());
        for (std::size_t channel : {0, 1, 2}) {
            const std::string said = refusal([&] { channels.read_channel(channel, tile.range, one); });
            if (channel == 1) {
                EXPECT_NE(said.find(expected), std::string::npos) << said;
            } else {
                EXPECT_EQ(said, "") << storage;
            }
        }
    }
}

TEST_F(H5py, writes_holograms_that_are_read) {
    const FieldGrid plane{{3, 2, 1e-6, 2e-6, 0.25, -0.5}, 5e-7};
    const std::string whole = "x, ", parts = "np.stack((x.real, x.imag), axis=-1), ";
    for (const std::string& storage :
         {whole + "dtype='c8'", whole + "dtype='c16'", whole + "dtype='c8', chunks=(2, 2), compression='gzip'",
          parts + "dtype='f2'", parts + "dtype='f4'", parts + "dtype='f2', chunks=(1, 2, 2), compression='gzip'"}) {
        run(std::string("import sys, h5py, numpy as np\n"
                        "f = h5py.File(sys.argv[1], 'w', libver='v108')\n"
                        "f.attrs['format'] = 'hogel hologram'; f.attrs['format_version'] = 1\n"
                        "x = ((1 - 2j) * np.arange(6)).reshape(2, 3)\n"
                        "d = f.create_group('field0').create_dataset('samples', data=") +
                storage +
                ")\n"
                "d.attrs.update(wavelength_m=5e-7, pitch_x_m=1e-6, pitch_y_m=2e-6, center_x_m=0.25, center_y_m=-0.5, "
                "z_m=0)\n",
            directory_ / "f.h5");
        const Fields fields = open_hologram(directory_ / "f.h5");
        ASSERT_EQ(fields.size(), 1u);
        EXPECT_EQ(fields[0]->grid(), plane);
        Field back(plane);
        copy(*fields[0], back);
        EXPECT_TRUE(std::ranges::equal(back.samples.elements(), numbered(plane).samples.elements())) << storage;
    }
}

// Python functions that write a light field with modifications.
const std::string make_light_field =
    "import sys, h5py, numpy as np\n"
    "A = dict(axis_order='c,t,s,v,u', channels=1, hogels_s=2, hogels_t=2, hogel_pitch_m=0.001,\n"
    "         directions_u=2, directions_v=2, tan_half_u=0.3, tan_half_v=0.2)\n"
    "def make(libver='v108', format='hogel light field', version=1, name='radiance', **change):\n"
    "    global f\n"
    "    f = h5py.File(sys.argv[1], 'w', libver=libver)\n"
    "    if format: f.attrs['format'] = format\n"
    "    f.attrs['format_version'] = version\n"
    "    storage = {k: v for k, v in change.items() if k not in A}\n"
    "    if 'shape' not in storage: storage = dict(shape=(1, 2, 2, 2, 2), data=np.ones((1, 2, 2, 2, 2)), "
    "**storage) if 'data' not in storage else dict(shape=(1, 2, 2, 2, 2), **storage)\n"
    "    r = f.create_dataset(name, **dict(dict(dtype='f4'), **storage))\n"
    "    r.attrs.update({**A, **{k: v for k, v in change.items() if k in A}})\n"
    "    return r\n"
    "def make_side(face, **change):\n"
    "    r = f.create_dataset(face + '/radiance', data=np.ones((1, 2, 2, 2, 2), 'f4'))\n"
    "    r.attrs.update({**A, 'face': face, **change})\n";

// Faults: a modification of a complete light field, and its error message.
const std::pair<const char*, const char*> faults[] = {
    {"make()", ""},
    {"make(libver='earliest')", "superblock has version 0"},
    {"make(format=None)", "not a hogel light field"},
    {"make(format='other')", "'other'"},
    {"make(format=3)", "not a text"},
    {"make(version=2)", "format_version is 2, but this program reads version 1"},
    {"make(version='1')", "not a whole number"},
    {"make(name='radiant')", "no dataset 'radiance'"},
    {"make(axis_order='u,v,s,t,c')", "axis_order is 'u,v,s,t,c'"},
    {"make(hogels_s=3)", "shape"},
    {"make(hogels_s=2.0)", "'hogels_s' is not a whole number"},
    {"make(hogels_s=[2, 2])", "'hogels_s' is not a single value"},
    {"make(hogels_s=-2)", "0x2 hogels"},
    {"make(hogels_s=2**62, hogels_t=2**62)", "addressed"},
    {"make(hogel_pitch_m=float('nan'))", "pitch"},
    {"make(tan_half_v=-1.0)", "tan_half_v"},
    {"make(tan_half_v='wide')", "not a number"},
    {"del make().attrs['tan_half_u']", "'tan_half_u' is missing"},
    {"make().attrs['face'] = 'left'", "says that it is the face 'left'"},
    {"make().attrs['center_u'] = float('inf')", "center_u"},
    {"make(); make_side('left', center_u=0.3)", ""},
    {"make(); make_side('left', center_u=0.2)", "reaches beyond the hologram plane"},
    {"make(); make_side('right', center_u=-0.3, hogel_pitch_m=0.002)", "other hogels or channels"},
    {"make(); make_side('top', center_v=-0.2); del f['top/radiance'].attrs['face']", "says that it is the face"},
    {"make(); f.create_group('left')", "no dataset 'left/radiance'"},
    {"make(); f['left'] = 1", "damaged"},
    {"make(data=None)", "not wholly written"},
    {"make(data=None, chunks=(1, 1, 1, 2, 2))[0, 0, 0] = 1", "not wholly written"},
    {"make(dtype='i4')", "floating point"},
    {"make(data=np.ones((1, 2, 2, 4)), shape=(1, 2, 2, 4))", "shape"},
    {"make(); f.create_dataset('depth', data=np.ones(3))", "'depth' does not have the shape"},
    {"make(name='other'); f['radiance'] = h5py.ExternalLink('elsewhere.h5', 'x')", "no dataset 'radiance'"},
    {"make(name='other'); f.create_group('radiance')", "damaged"},
    // 16 TB in a few bytes must be refused before memory is allocated.
    {"make(shape=(1, 2**20, 2**20, 2, 2), hogels_s=2**20, hogels_t=2**20, chunks=(1, 1, 1, 2, 2))",
     "not wholly written"},
    {"make(shape=(1, 2, 2, 2**14, 2**14), directions_u=2**14, directions_v=2**14, chunks=(1, 1, 1, 2**14, 2**14))",
     "chunks of more than"},
};

TEST_F(H5py, what_is_wrong_with_a_file_is_named) {
    for (const auto& [change, part] : faults) {
        run(make_light_field + change + "\n", directory_ / "l.h5");
        std::string message;
        try {
            open_light_field(directory_ / "l.h5");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            message = error.what();
        }
        EXPECT_NE(message.find(part), std::string::npos) << change << ": " << message;
        EXPECT_EQ(message.empty(), std::string(part).empty()) << change << ": " << message;
    }
}

// Arrays of MATLAB 7.3 as Python packages write them: in chunks that do not divide them, shuffled, compressed, and with
// checksums, beside objects that are not numeric arrays. The same array is written plain for NumPy.
TEST_F(H5py, arrays_of_matlab_in_chunks_are_those_of_numpy) {
    run(R"(
import sys, h5py, numpy as np
random = np.random.default_rng(1)
field = (random.standard_normal((131, 77)) + 1j * random.standard_normal((131, 77))).astype(np.complex64)
np.save(sys.argv[1] + ".npy", field)
pairs = np.zeros((77, 131), [("real", "f4"), ("imag", "f4")])
pairs["real"], pairs["imag"] = field.T.real, field.T.imag
packed = dict(chunks=(20, 30), compression="gzip", shuffle=True, fletcher32=True)
with h5py.File(sys.argv[1], "w", userblock_size=512) as f:
    f.create_dataset("plain", data=pairs).attrs["MATLAB_class"] = np.bytes_("single")
    f.create_dataset("packed", data=pairs, **packed).attrs["MATLAB_class"] = np.bytes_("single")
    for i in range(40):
        f["number%d" % i] = 0.0
    f.create_group("struct").attrs["MATLAB_class"] = np.bytes_("struct")
    f.create_dataset("text", data=np.zeros((5, 1), "u2")).attrs["MATLAB_class"] = np.bytes_("char")
    f.create_dataset("double", data=np.arange(6.0).reshape(2, 3)).attrs["MATLAB_class"] = np.bytes_("double")
with open(sys.argv[1], "r+b") as f:
    f.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\0\2IM")
)",
        directory_ / "a.mat");
    ExternalField what;
    what.pitch_x = what.pitch_y = 1e-6;
    what.wavelength = 633e-9;
    const Region all{0, 0, 77, 131};
    const auto samples = [&](const fs::path& path, const std::string& variable) {
        what.variable = variable;
        Array<std::complex<float>, 2> values({all.height, all.width});
        open_external_field(path, what)->read(all, 0, values);
        return values;
    };
    const auto expected = samples(directory_ / "a.mat.npy", "");
    for (const char* variable : {"plain", "packed"})
        EXPECT_TRUE(std::ranges::equal(samples(directory_ / "a.mat", variable).elements(), expected.elements()))
            << variable;
    what.variable = "text";
    EXPECT_THROW(open_external_field(directory_ / "a.mat", what), Error);
    what.variable = "double";
    what.values = ExternalField::Values::amplitude;
    const auto real = open_external_field(directory_ / "a.mat", what);
    Array<std::complex<float>, 2> one({1, 1});
    real->read({1, 2, 1, 1}, 0, one);
    EXPECT_EQ(one(0, 0), std::complex<float>(5));
}

}  // namespace
}  // namespace hogel::io
