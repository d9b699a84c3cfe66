// SPDX-License-Identifier: Apache-2.0
#include "hogel/renderer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

#include "hogel/render/baselines/mvr.h"
#include "hogel/render/baselines/oblique.h"
#include "hogel/render/baselines/raytrace.h"
#include "hogel/render/baselines/zbuffer.h"
#include "hogel/render/epi/epi.h"
#include "hogel/render/simplex/simplex.h"
#include "hogel/render/simplex/simplex3d.h"
#include "hogel/render/simplex/simploid.h"

namespace hogel {

using namespace render;

namespace {

constexpr std::array infos{
    RendererInfo{"raytrace", "one ray a sample through a bounding volume hierarchy (Embree)"},
    RendererInfo{"zbuffer", "an ordinary depth buffer for each hogel in turn"},
    RendererInfo{"simplex", "a four-dimensional depth buffer for all hogels of a tile at once", false},
    RendererInfo{"simploid", "the same in slices of whole simploids, one row of directions after the other"},
    RendererInfo{"simplex3d", "the same as simplex in three dimensions, for one row of hogels after the other", false},
    RendererInfo{"oblique", "for each direction a parallel projection over all hogels of a tile"},
    RendererInfo{"mvr", "multiple viewpoint rendering: slices of triangles for each row of hogels and of directions"},
    RendererInfo{"epi", "epipolar planes: each triangle is set up once for a whole row of hogels"},
};

}  // namespace

std::span<const RendererInfo> renderers() { return infos; }

std::unique_ptr<LightFieldSource> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                const LightFieldGrid& grid) {
    validate(grid, ErrorCode::usage, "light field to render");
    if (name == "raytrace") return baselines::make_raytrace_renderer(std::move(scene), grid);
    require_perspective(grid, ErrorCode::usage, fmt::format("the renderer '{}' (but not raytrace)", name));
    if (name == "zbuffer") return baselines::make_zbuffer_renderer(std::move(scene), grid);
    if (name == "simplex") return simplex::make_simplex_renderer(std::move(scene), grid);
    if (name == "simploid") return simplex::make_simploid_renderer(std::move(scene), grid);
    if (name == "simplex3d") return simplex::make_simplex3d_renderer(std::move(scene), grid);
    if (name == "oblique") return baselines::make_oblique_renderer(std::move(scene), grid);
    if (name == "mvr") return baselines::make_mvr_renderer(std::move(scene), grid);
    if (name == "epi") return epi::make_epi_renderer(std::move(scene), grid);
    std::vector<std::string_view> known;
    for (const RendererInfo& info : infos) known.push_back(info.name);
    throw Error(ErrorCode::usage, fmt::format("unknown renderer '{}'; known: {}", name, fmt::join(known, ", ")));
}

}  // namespace hogel
