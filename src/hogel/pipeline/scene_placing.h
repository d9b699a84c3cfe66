// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hogel/pipeline.h"

namespace hogel::pipeline {

/// Throws unless a file or a built-in scene of this name exists. If the name contains "." or "/", throws
/// Error(bad_input) for a missing file; otherwise Error(usage), with the nearest name of a built-in scene.
void require_scene_file(const std::string& name);

/// Returns the built-in scene, rotated and placed for the request's hologram.
Scene place_built_in(Scene scene, const LightFieldRequest& request);

}  // namespace hogel::pipeline
