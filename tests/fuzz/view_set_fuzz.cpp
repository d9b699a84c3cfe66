// SPDX-License-Identifier: Apache-2.0
// Sets of views: the first byte chooses between an array of views, a quilt, the parameters of a set, one of its
// pictures, the cameras of pictures, and a MAT file.
#include "fuzz_file.h"
#include "hogel/exchange.h"

namespace {

using namespace hogel;

void write(const std::filesystem::path& path, const std::uint8_t* data, std::size_t size) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

// A folder with a set of four tiny views and the bytes under a name of their own, removed afterwards.
struct FuzzSet {
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("hogel_fuzz_set_" + std::to_string(::getpid()));
    FuzzSet() {
        std::filesystem::create_directories(folder);
        const std::string picture = "P5 2 2 255\nabcd";
        for (const char* name : {"input_Cam000.ppm", "input_Cam001.ppm", "input_Cam002.ppm", "input_Cam003.ppm"})
            write(folder / name, reinterpret_cast<const std::uint8_t*>(picture.data()), picture.size());
    }
    ~FuzzSet() { std::filesystem::remove_all(folder); }
};

// Reads everything of a set that is small.
void read_set(const std::filesystem::path& source, const ViewImportOptions& options) {
    const ImportedViews views = import_views(source, options);
    constexpr double max_samples = 1 << 20;
    if (views.light_field.samples() > max_samples) return;
    LightFieldBuffer buffer(views.light_field.grid());
    write_views(views.light_field, buffer);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const FuzzSet set;
    const char* const names[] = {"a.npy",           "a_qs2x1a1.png", "parameters.cfg", "input_Cam003.ppm",
                                 "transforms.json", "a.mat"};
    const std::size_t kind = data[0] % 6;
    write(set.folder / names[kind], data + 1, size - 1);
    ViewImportOptions options;
    options.layout = kind == 0 ? "npy" : kind == 1 ? "quilt" : kind == 4 ? "transforms" : kind == 5 ? "mat" : "hci";
    fuzz::expect_bad_input([&] { read_set(kind < 2 || kind == 5 ? set.folder / names[kind] : set.folder, options); });
    return 0;
}
