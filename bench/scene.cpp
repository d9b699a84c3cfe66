// SPDX-License-Identifier: Apache-2.0
#include "bench/scene.h"

#include <fmt/format.h>

#include "hogel/error.h"
#include "hogel/files.h"
#include "hogel/render/cache_spacing.h"
#include "hogel/renderer.h"
#include "hogel/scenes.h"
#include "hogel/shading/radiance_cache.h"

namespace hogel::bench {

LightFieldGrid LightFieldOptions::grid() const {
    LightFieldGrid grid;
    grid.hogels_s = hogels.columns;
    grid.hogels_t = hogels.rows;
    grid.pitch = size / static_cast<double>(hogels.columns);
    grid.directions_u = directions.columns;
    grid.directions_v = directions.rows;
    grid.view = hogel::field_of_view(field_of_view.across, field_of_view.down);
    validate(grid, ErrorCode::usage, "light field");
    return grid;
}

Scene load_scene(const std::string& name, const LightFieldOptions& options) {
    std::error_code none;
    if (scenes().look_up(name) || !std::filesystem::exists(name, none))
        return make_scene(name, options.size, until_interrupted());  // throws for an unknown name
    Scene scene = import_scene(name);
    Fit fit;
    fit.width = options.size;
    fit.height = options.size * static_cast<double>(options.hogels.rows) / static_cast<double>(options.hogels.columns);
    fit.front = 0.3;
    fit_scene(scene, fit);
    if (scene.lights.empty()) add_default_lights(scene);
    return scene;
}

std::shared_ptr<const ShadedScene> shade(const Session& session, const Scene& scene, const LightFieldOptions& options) {
    ShadingOptions shading;
    shading.model = options.shading;
    auto shaded = std::make_shared<ShadedScene>(shade_scene(scene, shading, until_interrupted()));
    if (options.cache_spacing > 0)
        shading::add_radiance_cache(*shaded, render::cache_spacing(*shaded, options.grid(), options.cache_spacing));
    if (const auto& cache = shaded->radiance_cache)
        session.detail(fmt::format("light on surfaces: at most {}; no room for that of {} of {} triangles",
                                   format_bytes(cache->bytes()), cache->triangles_without_room(),
                                   shaded->triangles.size()));
    return shaded;
}

std::unique_ptr<LightFieldSource> open_or_render(const Session& session, const std::string& name,
                                                 const LightFieldOptions& options) {
    std::error_code none;
    if (!scenes().look_up(name) && std::filesystem::exists(name, none) && file_kind(name) == FileKind::light_field)
        return open_light_field(name);
    return make_renderer(options.algorithm, shade(session, load_scene(name, options), options), options.grid());
}

}  // namespace hogel::bench
