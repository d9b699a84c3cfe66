// SPDX-License-Identifier: Apache-2.0
// A light field that is a function of the ray, with no scene behind it, written to a file and photographed by rays.
#include <cmath>
#include <cstdio>

#include "hogel/hogel.h"

using namespace hogel;
using namespace hogel::literals;

// A picture on a plane behind the hologram. read() may be called by several threads at once.
class Rings final : public LightFieldSource {
  public:
    explicit Rings(const LightFieldGrid& grid) : grid_(grid) {}
    const LightFieldGrid& grid() const override { return grid_; }
    void read(LightFieldTile& tile) const override {
        const HogelRange& range = tile.range;
        for (std::size_t t = 0; t < range.nt; ++t)
            for (std::size_t s = 0; s < range.ns; ++s)
                for (std::size_t v = 0; v < grid_.directions_v; ++v)
                    for (std::size_t u = 0; u < grid_.directions_u; ++u) {
                        const double x = grid_.s(double(range.s0 + s)) + grid_.u(double(u)) * depth;
                        const double y = grid_.t(double(range.t0 + t)) + grid_.v(double(v)) * depth;
                        tile.radiance(0, t, s, v, u) = float(0.5 + 0.5 * std::cos(9e3 * std::hypot(x, y)));
                    }
    }

  private:
    static constexpr double depth = 8_mm;
    LightFieldGrid grid_;
};

int main() {
    const LightFieldGrid grid{80, 80, 50_um, 24, 24, field_of_view(14_deg), 1};
    const LightField rings(std::make_shared<const Rings>(grid));
    write_light_field("rings.h5", rings, {});

    const LightField from_file = open_light_field("rings.h5");  // as any light field: renderers, files, streams
    Camera camera = camera_for(grid.width(), grid.height(), 200);
    camera.focus_depth = 8_mm;
    const Image picture = photograph(from_file, {&camera, 1}).front();
    write_image("rings.png", picture);
    std::printf("rings.h5: %zu hogels of %zu directions\n", grid.hogels(), grid.directions());
}
