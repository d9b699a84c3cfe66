// SPDX-License-Identifier: Apache-2.0
// Encodes the hologram of a light field as the drive levels of a phase-only modulator.
#include <cstdio>

#include "hogel/hogel.h"

using namespace hogel;
using namespace hogel::literals;

int main() {
    Modulator modulator = find_modulator("leto");  // or define a Modulator
    modulator.width = 480;                         // use a part of it, to save time
    modulator.height = 270;

    LightFieldRequest request;
    request.grid = {30, 17, 16 * modulator.pitch, 16, 16, field_of_view(2.5_deg)};
    const LightField light_field = render_light_field(load_scene("sphere", request), request);

    HologramOptions options;
    options.channel = {532_nm};
    options.pitch = modulator.pitch;
    const auto field = make_hologram(light_field, options);

    const Pattern pattern = encode_pattern(*field, {.encoding = Encoding::double_phase, .modulator = modulator});
    write_levels("pattern.png", joined_levels({&pattern, 1}));
    std::printf("pattern.png: %zu x %zu levels, efficiency %.1f %%\n", modulator.width, modulator.height,
                100 * pattern.efficiency);
}
