#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "hogel/lightfield/light_field.h"
#include "hogel/shading/shaded_scene.h"

namespace hogel {

struct RendererInfo {
    std::string_view name;
    std::string_view description;  ///< one line
    bool straddles = true;         ///< whether it renders scenes that are not wholly behind the hologram plane
};

/// The renderers that make_renderer knows.
std::span<const RendererInfo> renderers();

/// A light field that is rendered where it is read, by the algorithm of that name. Offers depth per ray. The scene is
/// shared, never copied. Throws Error(usage) for an unknown name, listing the known ones, and for
/// a scene that is not wholly behind the hologram plane where the renderer does not straddle.
std::unique_ptr<LightFieldSource> make_renderer(std::string_view name, std::shared_ptr<const ShadedScene> scene,
                                                const LightFieldGrid& grid);

}  // namespace hogel
