// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/light_field.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/plane_spans.h"
#include "hogel/render/epi/tile_writer.h"
#include "hogel/render/row_axes.h"
#include "hogel/shading.h"

namespace hogel::render::epi {

/// Writes the radiance and depth of the samples of an epipolar plane from their visible spans.
class PlaneShader {
  public:
    /// Scene and spans must outlive this object.
    PlaneShader(const ShadedScene& scene, const LightFieldGrid& grid, PlaneSpans& spans)
        : scene_(scene), grid_(grid), axes_(grid), spans_(spans), writer_(grid, axes_) {}

    /// Shades a plane whose spans have been drawn, and empties it.
    void shade(const EpipolarPlane& plane, const FirstSample& first, LightFieldTile& tile);

  private:
    const ShadedScene& scene_;
    LightFieldGrid grid_;
    RowAxes axes_;
    PlaneSpans& spans_;
    TileWriter writer_;
};

}  // namespace hogel::render::epi
