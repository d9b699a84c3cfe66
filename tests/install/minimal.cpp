// SPDX-License-Identifier: Apache-2.0
// What a minimal library does: it compresses a light field, reads it back, makes holograms of it and photographs them.
// What it lacks it refuses by name.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
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

// The light field comes back from a stream as it was, and its hologram shows it.
bool works() {
    const LightField field(std::make_shared<const Uniform>());
    CompressionOptions options;
    options.target = Sqnr{40};
    compress(field, "uniform.hgl", options);
    const LightField back = open_light_field("uniform.hgl");
    HologramOptions hologram;
    hologram.channel = mono(633e-9).front();
    hologram.pitch = 2e-6;
    const auto made = make_hologram(back, hologram);
    Camera camera;
    camera.eye = {0, 0, 0.3};
    camera.pupil = 6e-3;
    camera.picture = {4, 4, 128e-6, 128e-6, 0, 0};
    const Image seen = photograph(*made, std::span(&camera, 1)).front();
    std::printf("a pixel of the photograph: %g\n", seen.pixels(2, 2, 0));
    return seen.pixels(2, 2, 0) > 0;
}

bool refuses(const char* option, const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        std::printf("%s\n", error.what());
        return error.code() == ErrorCode::not_built_in && std::string(error.what()).find(option) != std::string::npos;
    }
    return false;
}

int main() {
    const bool none = std::ranges::none_of(parts(), [](const Part& part) { return part.built_in; });
    const LightFieldGrid grid = Uniform().grid();
    return none && works() && refuses("HOGEL_HDF5", [&] { create_light_field("a.h5", std::span(&grid, 1)); }) &&
                   refuses("HOGEL_PICTURES", [] { write_image("a.png", Image(2, 2, 3)); })
               ? 0
               : 1;
}
