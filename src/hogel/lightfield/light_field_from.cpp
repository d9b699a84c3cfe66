// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include "hogel/light_field.h"

namespace hogel {
namespace {

using Radiance = std::function<Rgb(double s, double t, double u, double v)>;

class FunctionSource final : public LightFieldSource {
  public:
    FunctionSource(const LightFieldGrid& grid, Radiance radiance) : grid_(grid), radiance_(std::move(radiance)) {}
    const LightFieldGrid& grid() const override { return grid_; }
    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        for (std::size_t t = 0; t < tile.range.nt; ++t)
            for (std::size_t s = 0; s < tile.range.ns; ++s) read_hogel(s, t, tile);
    }

  private:
    void read_hogel(std::size_t s, std::size_t t, LightFieldTile& tile) const {
        const auto i = static_cast<double>(tile.range.s0 + s), j = static_cast<double>(tile.range.t0 + t);
        const LightFieldGrid directions = grid_.of_hogel(i, j);
        for (std::size_t v = 0; v < grid_.directions_v; ++v)
            for (std::size_t u = 0; u < grid_.directions_u; ++u) {
                const Rgb radiance = radiance_(grid_.s(i), grid_.t(j), directions.u(static_cast<double>(u)),
                                               directions.v(static_cast<double>(v)));
                const std::array<float, 3> channels{radiance.r, radiance.g, radiance.b};
                for (std::size_t c = 0; c < grid_.channels; ++c) tile.radiance(c, t, s, v, u) = channels[c];
            }
    }

    LightFieldGrid grid_;
    Radiance radiance_;
};

}  // namespace

LightField light_field_from(const LightFieldGrid& grid, Radiance radiance) {
    validate(grid, ErrorCode::usage, "light field");
    return LightField(std::make_shared<const FunctionSource>(grid, std::move(radiance)));
}

}  // namespace hogel
