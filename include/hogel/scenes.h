// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "hogel/export.h"
#include "hogel/progress.h"
#include "hogel/scene.h"
#include "hogel/table.h"

namespace hogel {

/// A scene that is made by a program rather than read from a file.
struct SceneInfo {
    std::string name;
    std::string text;  ///< one line
    /// For a square hologram with the given side (metres): the scene's size and its depths scale with it.
    std::function<Scene(double hologram_size, const Progress& progress)> make;
};

/// The built-in scenes.
HOGEL_API Table<SceneInfo>& scenes();

/// Makes the scene of that name. Throws Error(usage) for an unknown name, with the names that exist, and for a size
/// that is not positive.
HOGEL_API Scene make_scene(std::string_view name, double hologram_size, const Progress& progress = {});

/// Reads any mesh file that assimp reads (OBJ, PLY, STL, glTF/GLB and more): positions, normals, vertex colours, base
/// colours and base-colour textures, glTF's metallic-roughness materials, with all node transforms applied, in the
/// file's own units and axes. What an unlit material shows becomes given radiance. Adds missing normals. Files outside
/// the mesh's own folder are not opened. The scene has no lights: see add_default_lights. Throws Error(bad_input) with
/// one line: the file, and what is missing, damaged or out of range.
HOGEL_API Scene import_scene(const std::filesystem::path& path);

/// Where a fitted scene goes.
struct Fit {
    double width = 0, height = 0;  ///< the hologram's size, metres: the scene fills `fill` of it when seen head-on
    double fill = 0.85;
    double front = 0;  ///< how much of the scene's depth stands in front of the plane: 0 none (it begins at the
                       ///< plane), 1 all of it, 0.5 the plane cuts through its middle, −1 it begins as far behind
                       ///< the plane as it is deep
};

/// Scales a scene uniformly and moves it so that it is centred on the hologram and lies about the plane as `fit` says.
/// Lights move along (point lights keep the look: intensities scale with the square of the length).
HOGEL_API void fit_scene(Scene& scene, const Fit& fit);

/// A key light from the upper left in front, a weaker fill light from the right and a little ambient light, for scenes
/// that bring no lights. Directional, so independent of the scene's size.
HOGEL_API void add_default_lights(Scene& scene);

/// Writes a scene with given radiance as a binary glTF file (.glb), in metres and in the world frame: the radiance of a
/// vertex is its colour (linear, 32-bit floats, above 1 where it is), the materials are unlit (KHR_materials_unlit),
/// and a texture that multiplies the radiance travels inside as PNG. import_scene() reads it back. Throws
/// Error(bad_input) for a mesh without radiance, Error(usage) for another kind of name, Error(cannot_write).
HOGEL_API void write_baked_scene(const std::filesystem::path& path, const Scene& scene);

/// Throws Error(usage) for a name that write_baked_scene() would refuse, before there is a scene to lose.
HOGEL_API void require_baked_scene_name(const std::filesystem::path& path);

}  // namespace hogel
