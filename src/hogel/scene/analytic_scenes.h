// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene.h"

namespace hogel::scene {

// Built-in scenes with closed forms. The parameter is the hologram's side in metres.
Scene make_plane(double hologram_size);
Scene make_two_planes(double hologram_size);
Scene make_sphere(double hologram_size);
Scene make_point(double hologram_size);

}  // namespace hogel::scene
