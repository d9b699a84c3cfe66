// SPDX-License-Identifier: Apache-2.0
// Compressed light fields.
#include "fuzz_file.h"
#include "hogel/compress.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace hogel;
    const fuzz::FuzzFile file(data, size, ".hgl");
    fuzz::expect_bad_input([&] { read_stream_info(file.path()); });
    fuzz::expect_bad_input([&] {
        const LightField light_field = open_stream(file.path());
        for (const LightField::Source& face : light_field.faces()) {
            if (face->grid().directions() * face->grid().channels > 1 << 20) continue;
            LightFieldTile tile(face->grid(), {0, 0, 1, 1}, face->has_depth());
            face->read(tile);
        }
    });
    return 0;
}
