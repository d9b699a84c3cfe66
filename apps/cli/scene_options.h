// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "hogel/scene.h"

namespace hogel::cli {

/// The options of a person's own scene, which every command that takes a scene shares: how it is turned, placed,
/// coloured and lit.
struct SceneOptions {
    ScenePose pose;  ///< without `lights` and `texture`
    std::vector<std::string> lights;
    std::string texture;  ///< name of a picture
    double point_size = 1;

    /// With the lights and the picture. Throws Error(usage) for a light that is not one, and what read_image() throws.
    ScenePose complete_pose() const;

    // What decides which options act, known once a scene is loaded.
    bool is_loaded = false;
    bool is_file = false;  ///< no built-in scene
    bool is_lit = false, has_points = false;
    bool has_background = true;
};

void add_scene_options(Command& command, SceneOptions& options);

}  // namespace hogel::cli
