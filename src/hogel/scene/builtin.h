#pragma once

#include <span>
#include <string>
#include <string_view>

#include "hogel/scene/scene.h"

namespace hogel {

struct BuiltinScene {
    std::string_view name;
    std::string_view description;  ///< one line
};

/// All built-in scenes, in the order in which to show them.
std::span<const BuiltinScene> builtin_scenes();

/// Makes a built-in scene for a square hologram with the given side (metres): its size and its depths scale with it.
/// Throws Error(usage) for an unknown name, with the names that exist.
Scene make_builtin_scene(std::string_view name, double hologram_size);

}  // namespace hogel
