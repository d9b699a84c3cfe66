// SPDX-License-Identifier: Apache-2.0
// Fields of other programs. The first byte chooses the name; the bytes themselves say the format.
#include "fuzz_file.h"
#include "hogel/files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace hogel;
    if (size == 0) return 0;
    static constexpr const char* endings[] = {".npy", ".mat", ".npz", ".ohc", ".exr"};
    const fuzz::FuzzFile file(data + 1, size - 1, endings[data[0] % 5]);
    fuzz::expect_bad_input([&] {
        ExternalField description;
        description.pitch_x = description.pitch_y = 8e-6;
        description.wavelength = 532e-9;
        const auto field = open_external_field(file.path(), description);
        const std::size_t width = field->grid().plane.width;
        if (width > 1 << 20) return;
        Array<std::complex<float>, 2> row({1, width});
        field->read({0, 0, width, 1}, 0, row);
    });
    return 0;
}
