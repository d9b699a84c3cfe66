// SPDX-License-Identifier: Apache-2.0
// Pictures and their metadata. The first byte chooses the format.
#include <array>

#include "fuzz_file.h"
#include "hogel/image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace hogel;
    constexpr std::array<const char*, 9> extensions{".png", ".exr", ".bmp", ".jpg", ".tga",
                                                    ".gif", ".hdr", ".ppm", ".pfm"};
    if (size == 0) return 0;
    const fuzz::FuzzFile file(data + 1, size - 1, extensions[data[0] % extensions.size()]);
    fuzz::expect_bad_input([&] { read_image(file.path(), 1 << 22); });
    fuzz::expect_bad_input([&] { read_metadata(file.path()); });
    return 0;
}
