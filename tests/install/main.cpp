// SPDX-License-Identifier: Apache-2.0
// Tests that exceptions, tables extended by a program, and values cross the boundary of the library.
#include <cstdio>
#include <memory>
#include <stop_token>
#include <string>

#include "hogel/hogel.h"

using namespace hogel;

// A light field of one colour.
class Uniform final : public LightFieldSource {
  public:
    const LightFieldGrid& grid() const override { return grid_; }
    void read(LightFieldTile& tile) const override {
        for (float& value : tile.radiance.elements()) value = 1;
    }

  private:
    LightFieldGrid grid_{8, 8, 64e-6, 16, 16, field_of_view(0.2), 1};
};

int exceptions() {
    try {
        parse_length("16", "size");
    } catch (const Error& error) {
        return error.code() == ErrorCode::usage ? 0 : 1;
    }
    return 1;
}

// The whole chain in one expression of temporaries, because each object shares ownership of its sources.
int temporaries() {
    const Camera camera = camera_for(8 * 64e-6, 8 * 64e-6, 4);
    const auto field = make_holograms(LightField(std::make_shared<const Uniform>()), {.channels = mono(633e-9)});
    const Image seen = photograph_colours(field, {&camera, 1}).front();
    return seen.width() == 4 && seen.pixels(2, 2, 0) > 0 ? 0 : 2;
}

int stops() {
    std::stop_source stop;
    stop.request_stop();
    LightFieldBuffer buffer(Uniform().grid());
    try {
        copy(Uniform(), buffer, Progress(stop.get_token()));
    } catch (const Error& error) {
        return error.code() == ErrorCode::cancelled ? 0 : 4;
    }
    return 4;
}

int main() {
    std::printf("hogel %s, a %s hologram\n", HOGEL_VERSION, format_length(633e-9).c_str());
    return exceptions() | temporaries() | stops();
}
