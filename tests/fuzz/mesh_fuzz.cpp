// SPDX-License-Identifier: Apache-2.0
// Mesh files. The first byte chooses the format.
#include <array>

#include "fuzz_file.h"
#include "hogel/scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace hogel;
    constexpr std::array extensions{".gltf", ".glb", ".obj", ".ply", ".stl", ".off", ".fbx", ".xyz", ".dat", ".layers"};
    if (size == 0) return 0;
    const fuzz::FuzzFile file(data + 1, size - 1, extensions[data[0] % extensions.size()]);
    fuzz::expect_bad_input([&] { import_scene(file.path()); });
    return 0;
}
