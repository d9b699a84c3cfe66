// SPDX-License-Identifier: Apache-2.0
// Light fields and holograms in HDF5 files.
#include <vector>

#include "fuzz_file.h"
#include "hdf5_checksums.h"
#include "hogel/files.h"

namespace {

using namespace hogel;

constexpr std::size_t max_samples = 1 << 22;

void read_light_field(const std::filesystem::path& path) {
    const LightField light_field = open_light_field(path);
    for (const LightField::Source& face : light_field.faces()) {
        if (face->grid().directions() * face->grid().channels > max_samples) continue;
        LightFieldTile tile(face->grid(), {0, 0, 1, 1}, face->has_depth());
        face->read(tile);
    }
}

void read_hologram(const std::filesystem::path& path) {
    for (const auto& field : open_hologram(path)) {
        if (field->grid().plane.width > max_samples) continue;
        Array<std::complex<float>, 2> row({1, field->grid().plane.width});
        field->read({0, 0, field->grid().plane.width, 1}, 0, row);
    }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

// Most changes of metadata are seen by their checksums. So these are put right, except in one case of sixteen.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    const fuzz::Hdf5Checksums checksums({data, size});
    const std::size_t changed = LLVMFuzzerMutate(data, size, max_size);
    if (seed % 16 != 0 && changed == size) checksums.repair({data, size});
    return changed;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::FuzzFile file(data, size, ".h5");
    fuzz::expect_bad_input([&] { summarize(file.path()); });
    fuzz::expect_bad_input([&] { read_light_field(file.path()); });
    fuzz::expect_bad_input([&] { read_hologram(file.path()); });
    return 0;
}
