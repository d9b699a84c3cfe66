// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "hogel/error.h"
#include "hogel/parameters.h"
#include "hogel/units.h"
#include "outputs.h"

namespace hogel::cli {

Scene load_scene(const Session& session, const std::string& name, LightFieldParameters& options) {
    const LightFieldRequest request = options.scene_request();
    Stage stage(session, "scene");
    Scene scene = hogel::load_scene(name, request, stage.progress());
    options.scene.resolve(scene, scenes().look_up(name) == nullptr);
    for (const std::string& note : scene.notes) session.say(fmt::format("{}: note: {}", name, note));
    return scene;
}

std::shared_ptr<const ShadedScene> light_scene(const Session& session, const Scene& scene,
                                               LightFieldParameters& options) {
    const LightFieldRequest request = options.request();
    options.resolve(scene);
    if (request.shading.model == "auto" && options.shading == "direct")
        session.detail(fmt::format("shading: direct, because {}", scene.has_large_triangles
                                                                      ? "its triangles are large"
                                                                      : "of its maps of gloss or relief"));
    if (options.has_shadow_maps)
        session.detail(fmt::format("shadow maps: {}", format_bytes(shadow_map_bytes(scene, request.shading))));
    Stage stage(session, "lighting");
    return hogel::light_scene(scene, request, stage.progress());
}

LightField render_light_field(const Session& session, const Scene& scene, LightFieldParameters& options) {
    const LightFieldRequest request = options.request();
    const auto shaded_scene = light_scene(session, scene, options);
    options.resolve(*shaded_scene);
    return with_parameter(options.frequencies > 0 ? "algorithm, frequencies" : "algorithm",
                          [&] { return hogel::render_light_field(shaded_scene, request); });
}

void require_memory(const Session& session, const LightField& rendered, const LightFieldParameters& options,
                    const Scene& scene) {
    const Plan plan = plan_light_field(rendered, options.request(scene), triangle_count(scene));
    with_parameter("hogels, directions", [&] { check_plan(session, plan, "rendering by " + options.algorithm); });
}

LightField open_or_render(const Session& session, const std::string& name, LightFieldParameters& options) {
    if (input_kind(name) == InputKind::light_field) return open_light_field_or_views(name);
    const Scene scene = load_scene(session, name, options);
    LightField rendered = render_light_field(session, scene, options);
    require_memory(session, rendered, options, scene);
    return rendered;
}

LightField fitted(const Session& session, const LightField& light_field, const HologramParameters& hologram,
                  const Modulator& modulator, bool smooth) {
    LightField fitted = hologram.fitted(light_field, modulator, smooth);
    const LightFieldGrid &before = light_field.grid(), &after = fitted.grid();
    if (after == before) return fitted;
    const auto degrees = [](double half) { return 2 * std::atan(half) * 180 / std::numbers::pi; };
    session.say(
        fmt::format("the light field is {} by {} with {:.3g} degrees for {}, instead of {} by {} with {:.3g} "
                    "degrees; its depth keeps the disparity",
                    format_length(after.width()), format_length(after.height()), degrees(after.half_u()),
                    modulator.name.empty() ? "these pixels" : modulator.name, format_length(before.width()),
                    format_length(before.height()), degrees(before.half_u())));
    return fitted;
}

Fields open_and_reconstruct(const Session& session, const std::string& name, FieldParameters& options) {
    Stage stage(session, "opening the hologram");
    OpenedFields opened = options.open_and_reconstruct(name, *session.command, stage.progress());
    for (const std::string& note : opened.notes) session.say(note);
    return std::move(opened.fields);
}

LightField prepare_for_reading(const Session& session, const LightField& light_field, std::size_t times,
                               bool with_depth) {
    Stage stage(session, "rendering");
    return hogel::prepare_for_reading(light_field, times, with_depth, stage.progress());
}

}  // namespace hogel::cli
