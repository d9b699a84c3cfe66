// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hogel/pipeline.h"

namespace hogel::pipeline {

/// Throws if no file of this name exists. The error of a name like a path reports a missing file, of another name
/// an unknown scene.
void require_scene_file(const std::string& name);

/// Returns the built-in scene, rotated and placed for the request's hologram.
Scene place_built_in(Scene scene, const LightFieldRequest& request);

}  // namespace hogel::pipeline
