#pragma once

#include <string_view>

#include "hogel/scene.h"

namespace hogel {

// One maker a scene; all take the hologram's side in metres.
Scene make_pumpkin(double hologram_size);
Scene make_tower(double hologram_size);
Scene make_church(double hologram_size);
Scene make_chandelier(double hologram_size);
Scene make_billiards(double hologram_size);
Scene make_plane(double hologram_size);
Scene make_two_planes(double hologram_size);
Scene make_sphere(double hologram_size);
Scene make_point(double hologram_size);

}  // namespace hogel
