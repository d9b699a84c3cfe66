// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/layers.h"
#include "hogel/render/thesis_renderers.h"
#include "thesis/simplex/interpolated.h"
#include "thesis/simplex/simplex.h"
#include "thesis/simplex/simplex3d.h"
#include "thesis/simplex/simploid.h"

namespace hogel {

std::vector<RendererInfo> render::thesis_renderers() {
    return {simplex::simplex_renderer(), simplex::simplex_strips_renderer(), simplex::simploid_renderer(),
            simplex::simplex3d_renderer()};
}

std::unique_ptr<Renderer> make_interpolating_renderer(std::shared_ptr<const ShadedScene> scene,
                                                      const LightFieldGrid& grid, std::size_t region) {
    validate(grid, ErrorCode::usage, "light field to render");
    return render::with_layers(simplex::interpolating_renderer(scene, grid, region), scene);
}

}  // namespace hogel
