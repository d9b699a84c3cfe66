#include "hogel/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "hogel/error.h"
#include "hogel/scene/analytic_scenes.h"

namespace hogel {
namespace {

constexpr std::array scenes{
    BuiltinScene{"pumpkin", "a jack-o'-lantern with a candle inside, by moonlight"},
    BuiltinScene{"tower", "a bell tower with clock, open belfry and bell, in evening sun"},
    BuiltinScene{"church", "the nave of a church, cut open along its length, in the light of 30 lamps"},
    BuiltinScene{"chandelier", "sixteen candles, brass and crystal"},
    BuiltinScene{"billiards", "a pool table under its lamps, just after the break"},
    BuiltinScene{"plane", "a picture parallel to the hologram, behind it (has a closed form)"},
    BuiltinScene{"two-planes", "a small picture in front of the hologram, a large one behind it (has a closed form)"},
    BuiltinScene{"sphere", "a diffuse ball about the centre of the hologram (has a closed form)"},
    BuiltinScene{"point", "a tiny bright disc behind the hologram (has a closed form)"},
};
constexpr std::array makers{&make_pumpkin, &make_tower,      &make_church, &make_chandelier, &make_billiards,
                            &make_plane,   &make_two_planes, &make_sphere, &make_point};
static_assert(scenes.size() == makers.size());

}  // namespace

std::span<const BuiltinScene> builtin_scenes() { return scenes; }

Scene make_builtin_scene(std::string_view name, double hologram_size) {
    if (!(hologram_size > 0 && std::isfinite(hologram_size)))
        throw Error(ErrorCode::usage,
                    fmt::format("scene '{}': hologram size {} m; expected a positive length", name, hologram_size));
    for (std::size_t i = 0; i < scenes.size(); ++i)
        if (scenes[i].name == name) {
            Scene scene = makers[i](hologram_size);
            scene.name = name;
            return scene;
        }
    std::string names;
    for (const BuiltinScene& scene : scenes) names += fmt::format("{}{}", names.empty() ? "" : ", ", scene.name);
    throw Error(ErrorCode::usage, fmt::format("no built-in scene '{}'; expected one of {}", name, names));
}

}  // namespace hogel
