// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene.h"

#include <fmt/format.h>

#include <cmath>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/scene/analytic_scenes.h"
#include "showpieces/showpieces.h"

namespace hogel {
namespace {

// Returns the table row of a scene without progress reports.
SceneInfo row(std::string name, std::string text, Scene (*make)(double)) {
    return {std::move(name), std::move(text),
            [make](double hologram_size, const Progress&) { return make(hologram_size); }};
}

}  // namespace

Table<SceneInfo>& scenes() {
    static Table<SceneInfo> table(
        "built-in scene",
        {
            row("pumpkin", "a jack-o'-lantern with a candle inside, by moonlight", &showpieces::make_pumpkin),
            row("tower", "a bell tower with clock, open belfry and bell, in evening sun", &showpieces::make_tower),
            row("church", "the nave of a church, cut open along its length, in the light of 30 lamps",
                &showpieces::make_church),
            row("chandelier", "sixteen candles, brass and crystal", &showpieces::make_chandelier),
            row("billiards", "a pool table under its lamps, just after the break", &showpieces::make_billiards),
            row("plane", "a picture parallel to the hologram, behind it (has a closed form)", &scene::make_plane),
            row("two-planes", "a small picture in front of the hologram, a large one behind it (has a closed form)",
                &scene::make_two_planes),
            row("sphere", "a diffuse ball about the centre of the hologram (has a closed form)", &scene::make_sphere),
            row("point", "a tiny bright disc behind the hologram (has a closed form)", &scene::make_point),
            {"church-radiance", "the church with all its reflected light, 3.4 million triangles",
             &showpieces::make_church_radiance},
        });
    return table;
}

Scene make_scene(std::string_view name, double hologram_size, const Progress& progress) {
    const core::StopScope scope(progress);
    const SceneInfo& info = scenes().find(name);
    if (!(hologram_size > 0 && std::isfinite(hologram_size)))
        throw Error(ErrorCode::usage,
                    fmt::format("scene '{}': hologram size {} m; expected a positive length", name, hologram_size));
    Scene scene = info.make(hologram_size, progress);
    scene.name = name;
    return scene;
}

}  // namespace hogel
