// SPDX-License-Identifier: Apache-2.0
// Light fields at another scale.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hogel/error.h"
#include "hogel/light_field.h"
#include "hogel/units.h"

namespace hogel {
namespace {

LightFieldGrid scaled_grid(const LightFieldGrid& grid, double pitch, double factor) {
    LightFieldGrid scaled = grid;
    DirectionRange range = grid.range();
    for (double* value : {&range.half_u, &range.half_v, &range.center_u, &range.center_v}) *value *= factor;
    scaled.pitch = pitch;
    if (grid.has_frequencies())
        scaled.view = Frequencies{range};
    else
        scaled.view = Perspective{range, grid.face()};
    validate(scaled, ErrorCode::usage, "light field at another scale");
    return scaled;
}

class Scaled final : public LightFieldSource {
  public:
    Scaled(LightField::Source source, double pitch, double factor)
        : source_(std::move(source)),
          grid_(scaled_grid(source_->grid(), pitch, factor)),
          depth_factor_(pitch / (source_->grid().pitch * factor)) {
        if (const FocalPlane* plane = source_->grid().focal_plane()) curvature_ = 1 / plane->depth;
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }
    View<const float, 5> in_memory() const override { return source_->in_memory(); }
    void read(LightFieldTile& tile) const override {
        source_->read(tile);
        for (float& depth : tile.depth.elements()) depth = scaled_depth(depth);
    }

  private:
    // Neighbouring directions see a point of depth ζ moved by ζΔU/(1 − ζ/D), for the depth D of a fixed focal plane.
    float scaled_depth(float depth) const {
        if (!std::isfinite(depth)) return depth;
        const double behind = 1 - depth * curvature_;
        return behind > 0 ? static_cast<float>(depth * depth_factor_ / behind) : std::numeric_limits<float>::infinity();
    }

    LightField::Source source_;
    LightFieldGrid grid_;
    double depth_factor_, curvature_ = 0;
};

}  // namespace

LightField with_scale(const LightField& light_field, double pitch, double factor) {
    if (!(pitch > 0) || !(factor > 0))
        throw Error(ErrorCode::usage,
                    fmt::format("a light field at another scale needs a positive pitch and factor, not {} and {}",
                                format_length(pitch), factor));
    if (light_field.has_sides()) throw Error(ErrorCode::usage, "a hemicube has one scale only");
    return light_field.wrapped(
        [&](const LightField::Source& face) { return std::make_shared<Scaled>(face, pitch, factor); });
}

}  // namespace hogel
