// SPDX-License-Identifier: Apache-2.0
// Resampling of light fields with a fixed focal plane to directions common to all hogels.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/light_field.h"
#include "hogel/lightfield/interpolation.h"
#include "hogel/units.h"

namespace hogel {
namespace {

using lightfield::Interpolation;
using lightfield::mix;

class WithCommonDirections final : public LightFieldSource {
  public:
    WithCommonDirections(LightField::Source source, const LightFieldGrid& grid)
        : source_(std::move(source)), grid_(grid) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }

    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        LightFieldTile from(source_->grid(), tile.range, tile.depth.size() > 0 && has_depth());
        source_->read(from);
        for (std::size_t t = 0; t < tile.range.nt; ++t) {
            core::throw_if_stopped();
            for (std::size_t s = 0; s < tile.range.ns; ++s) resample(from, tile, t, s);
        }
    }

  private:
    void resample(const LightFieldTile& from, LightFieldTile& tile, std::size_t t, std::size_t s) const {
        const LightFieldGrid hogel_grid =
            source_->grid().of_hogel(static_cast<double>(tile.range.s0 + s), static_cast<double>(tile.range.t0 + t));
        std::vector<Interpolation> u, v;
        for (std::size_t k = 0; k < grid_.directions_u; ++k)
            u.emplace_back(keeps_u() ? 0 : hogel_grid.column(grid_.u(static_cast<double>(k))), hogel_grid.directions_u);
        for (std::size_t l = 0; l < grid_.directions_v; ++l)
            v.emplace_back(keeps_v() ? 0 : hogel_grid.row(grid_.v(static_cast<double>(l))), hogel_grid.directions_v);
        for (std::size_t c = 0; c < grid_.channels; ++c)
            interpolate(from.radiance.view()[c][t][s], u, v, tile.radiance.view()[c][t][s]);
        if (from.depth.size() > 0) choose_nearest(from.depth.view()[t][s], u, v, tile.depth.view()[t][s]);
    }

    // A single column or row of directions applies to all: there is no parallax in that direction.
    bool keeps_u() const { return source_->grid().directions_u == 1 && grid_.directions_u == 1; }
    bool keeps_v() const { return source_->grid().directions_v == 1 && grid_.directions_v == 1; }

    static void interpolate(View<const float, 2> from, const std::vector<Interpolation>& u,
                            const std::vector<Interpolation>& v, View<float, 2> to) {
        for (std::size_t l = 0; l < v.size(); ++l)
            for (std::size_t k = 0; k < u.size(); ++k) {
                if (u[k].outside || v[l].outside) {
                    to(l, k) = 0;
                    continue;
                }
                const std::size_t u0 = u[k].low, u1 = u[k].high(from.extent(1)), v0 = v[l].low,
                                  v1 = v[l].high(from.extent(0));
                to(l, k) = mix(mix(from(v0, u0), from(v0, u1), u[k].high_weight),
                               mix(from(v1, u0), from(v1, u1), u[k].high_weight), v[l].high_weight);
            }
    }

    static void choose_nearest(View<const float, 2> from, const std::vector<Interpolation>& u,
                               const std::vector<Interpolation>& v, View<float, 2> to) {
        for (std::size_t l = 0; l < v.size(); ++l)
            for (std::size_t k = 0; k < u.size(); ++k)
                to(l, k) = u[k].outside || v[l].outside ? std::numeric_limits<float>::infinity()
                                                        : from(v[l].nearest(), u[k].nearest());
    }

    LightField::Source source_;
    LightFieldGrid grid_;
};

// Returns the number of directions of the union of hogels with centres up to `shift` steps apart.
std::size_t joint_count(std::size_t count, double shift) {
    return count == 1 ? 1 : count + static_cast<std::size_t>(std::ceil(std::min(shift, 1e15) - 1e-9));
}

}  // namespace

LightFieldGrid common_directions(const LightFieldGrid& grid) {
    const FocalPlane* plane = grid.focal_plane();
    if (plane == nullptr) return grid;
    LightFieldGrid common = grid;
    DirectionRange range = *plane;
    const double step_u = grid.step_u(), step_v = grid.step_v(), per_hogel = grid.pitch / std::abs(plane->depth);
    common.directions_u = joint_count(grid.directions_u, static_cast<double>(grid.hogels_s - 1) * per_hogel / step_u);
    common.directions_v = joint_count(grid.directions_v, static_cast<double>(grid.hogels_t - 1) * per_hogel / step_v);
    range.half_u = 0.5 * step_u * static_cast<double>(common.directions_u);
    range.half_v = 0.5 * step_v * static_cast<double>(common.directions_v);
    common.view = Perspective{range};
    validate(common, ErrorCode::usage, "directions in common of a light field with a fixed focal plane");
    return common;
}

LightField with_common_directions(const LightField& light_field) {
    if (light_field.grid().focal_plane() == nullptr) return light_field;
    return with_common_directions(light_field, common_directions(light_field.grid()));
}

LightField with_common_directions(const LightField& light_field, const LightFieldGrid& grid) {
    validate(grid, ErrorCode::usage, "directions in common");
    const FocalPlane* plane = light_field.grid().focal_plane();
    if (plane == nullptr || !grid.is_perspective() || !same_hogels(light_field.grid(), grid))
        throw Error(ErrorCode::usage,
                    "directions in common are a perspective with the hogels and channels of a light "
                    "field that has a fixed focal plane");
    Provenance provenance = light_field.provenance();
    provenance.entries.emplace_back("directions", fmt::format("interpolated linearly from those through a fixed focal "
                                                              "plane at a depth of {}",
                                                              format_length(plane->depth)));
    return LightField(
        std::vector<LightField::Source>{std::make_shared<WithCommonDirections>(light_field.faces().front(), grid)},
        std::move(provenance));
}

}  // namespace hogel
