#pragma once

#include <filesystem>

#include "hogel/scene/scene.h"

namespace hogel {

/// Writes a scene with given radiance as a binary glTF file (.glb), in metres and in the world frame: the radiance of a
/// vertex is its colour (linear, 32-bit floats, above 1 where it is), the materials are unlit (KHR_materials_unlit),
/// and a texture that multiplies the radiance travels inside as PNG. import_scene() reads it back. Throws
/// Error(bad_input) for a mesh without radiance, Error(usage) for another kind of name, Error(cannot_write).
void write_radiance(const std::filesystem::path& path, const Scene& scene);

/// Throws Error(usage) for a name that write_radiance() would refuse, before there is a scene to lose.
void require_radiance_name(const std::filesystem::path& path);

}  // namespace hogel
