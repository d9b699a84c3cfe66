// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/plane_shader.h"

#include "hogel/render/sample_store.h"

namespace hogel::render::epi {
namespace {

// Evaluates the radiance of single samples of one plane, and points of the radiance cache.
class PlaneRadiance final : public RadianceSource {
  public:
    PlaneRadiance(const ShadedScene& scene, const LightFieldGrid& grid, const RowAxes& axes, const PlaneSpans& spans,
                  const FirstSample& first)
        : scene_(scene), grid_(grid), axes_(axes), spans_(spans), first_(first) {}

    Rgb radiance(std::size_t span, float position, std::size_t column, std::size_t k) const override {
        const SpanOrigin& origin = spans_.origins()[span];
        const SpanValues& values = spans_.values()[span];
        const auto [b0, b1, b2] = origin.weights(position);
        const float depth = values.value0[3] + position * values.difference[3];
        const auto sample = axes_.sample(first_.slow_hogel, first_.fast_hogel + column, first_.slow_direction, k);
        const ViewSample view =
            view_sample(grid_, grid_.u(static_cast<double>(sample.u)), grid_.v(static_cast<double>(sample.v)), depth);
        return radiance_at(scene_, origin.triangle, b0, b1, b2, view);
    }

    Grids grids() const override { return {spans_.origins(), scene_.radiance_cache->grids().data()}; }

    shading::RadianceCache::Corners corners(std::size_t span, std::size_t row, std::size_t column) const override {
        return scene_.radiance_cache->corners(scene_, spans_.origins()[span].triangle, row, column);
    }

  private:
    const ShadedScene& scene_;
    const LightFieldGrid& grid_;
    const RowAxes& axes_;
    const PlaneSpans& spans_;
    FirstSample first_;
};

}  // namespace

void PlaneShader::shade(const EpipolarPlane& plane, const FirstSample& first, LightFieldTile& tile) {
    const PlaneOutput out = writer_.begin(tile, plane, first);
    if (spans_.uses_knots())
        shade_between_knots(plane, spans_.values(), spans_.shaded(), PlaneRadiance(scene_, grid_, axes_, spans_, first),
                            out);
    else
        shade_between_ends(plane, spans_.values(), out);
    writer_.finish(tile, plane, first);
}

}  // namespace hogel::render::epi
