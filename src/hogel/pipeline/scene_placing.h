// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hogel/pipeline.h"

namespace hogel::pipeline {

/// Throws unless a file of this name exists. A name that looks like a path is reported as a missing file, any other as
/// an unknown scene.
void require_scene_file(const std::string& name);

/// Turns and places a built-in scene that was made for the request's hologram.
Scene place_built_in(Scene scene, const LightFieldRequest& request);

}  // namespace hogel::pipeline
