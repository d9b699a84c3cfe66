// SPDX-License-Identifier: Apache-2.0
#include "bench/scene.h"

#include <fmt/format.h>

#include "hogel/pipeline.h"
#include "hogel/shading/radiance_cache.h"

namespace hogel::bench {

LightFieldGrid LightFieldOptions::grid() const {
    LightFieldGrid grid;
    grid.hogels_s = hogels.columns;
    grid.hogels_t = hogels.rows;
    grid.pitch = size / static_cast<double>(across > 0 ? across : hogels.columns);
    grid.directions_u = directions.columns;
    grid.directions_v = directions.rows;
    grid.view = hogel::field_of_view(field_of_view.across, field_of_view.down);
    validate(grid, ErrorCode::usage, "light field");
    return grid;
}

namespace {

LightFieldRequest request_of(const LightFieldOptions& options) {
    LightFieldRequest request;
    request.renderer = options.algorithm;
    request.shading.model = options.shading;
    request.cache_spacing = options.cache_spacing;
    request.grid = options.grid();
    return request;
}

}  // namespace

Scene load_scene(const std::string& name, const LightFieldOptions& options) {
    LightFieldRequest request = request_of(options);
    if (options.across > 0) request.grid.hogels_s = options.across;
    return hogel::load_scene(name, request, until_interrupted());
}

std::shared_ptr<const ShadedScene> shade(const Session& session, const Scene& scene, const LightFieldOptions& options) {
    auto shaded = light_scene(scene, request_of(options), until_interrupted());
    if (const auto& cache = shaded->radiance_cache)
        session.detail(fmt::format("radiance cache: at most {}; no room for that of {} of {} triangles",
                                   format_bytes(cache->bytes()), cache->uncached_triangles(),
                                   shaded->triangles.size()));
    return shaded;
}

std::shared_ptr<const LightFieldSource> open_or_render(const Session& session, const std::string& name,
                                                       const LightFieldOptions& options) {
    if (input_kind(name) == InputKind::light_field) return open_light_field(name).faces().front();
    return make_renderer(options.algorithm, shade(session, load_scene(name, options), options), options.grid());
}

}  // namespace hogel::bench
