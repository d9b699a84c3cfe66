// SPDX-License-Identifier: Apache-2.0
// Compresses a light field to a given quality, and decodes a single hogel of it.
#include <cstdio>

#include "hogel/hogel.h"

using namespace hogel;
using namespace hogel::literals;

int main() {
    LightFieldRequest request;
    request.grid = {48, 48, 100_um, 32, 32, field_of_view(16_deg)};
    const LightField light_field = render_light_field(load_scene("pumpkin", request), request);

    CompressionOptions options;
    options.target = Sqnr{30};  // decibels; or PixelsPerBit, Step, MaxError, Lossless
    const CompressionResult result = compress(light_field, "pumpkin.hgl", options);
    std::printf("%llu bytes, %.2f dB, %.1f pixels per bit\n", static_cast<unsigned long long>(result.bytes),
                result.sqnr, result.pixels_per_bit);

    const LightField decoded = open_stream("pumpkin.hgl");
    LightFieldTile hogel(decoded.grid(), {24, 24, 1, 1}, false);  // the hogel in the middle
    decoded.front().read(hogel);
    std::printf("its middle ray has radiance %.4f %.4f %.4f\n", double(hogel.radiance(0, 0, 0, 16, 16)),
                double(hogel.radiance(1, 0, 0, 16, 16)), double(hogel.radiance(2, 0, 0, 16, 16)));
}
