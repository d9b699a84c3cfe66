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

/// A scene that is generated, not read from a file.
struct SceneInfo {
    std::string name;  ///< by which make_scene() finds it
    std::string text;  ///< one line
    /// Makes the scene for a square hologram with the given side (metres). Its size and its depths scale with the side.
    std::function<Scene(double hologram_size, const Progress& progress)> make;
};

/// The built-in scenes by name.
HOGEL_API Table<SceneInfo>& scenes();

/// Makes the scene of that name for a square hologram with the given side (metres). Throws Error(usage) for an unknown
/// name and for a size that is not positive.
HOGEL_API Scene make_scene(std::string_view name, double hologram_size, const Progress& progress = {});

/// Reads any mesh file that assimp reads (OBJ, PLY, STL, glTF/GLB and more): positions, normals, vertex colours, base
/// colours and base-colour textures, glTF's metallic-roughness materials, with all node transforms applied, in the
/// file's own units and axes. The colour of an unlit material becomes given radiance. Missing normals are added. Files
/// outside the mesh's own folder are not opened. The scene has no lights: see add_default_lights(). assimp works in a
/// child process whose memory and time are limited in proportion to the files (docs/files.md, "Meshes"), so that a
/// damaged file cannot harm this one. Throws Error(bad_input) with one line: the file, and what is missing, damaged or
/// out of range; Error(cancelled); and Error(not_built_in) in a build without assimp.
HOGEL_API Scene import_scene(const std::filesystem::path& path, const Progress& progress = {});

/// The size and position of a scene that fit_scene() fits to a hologram.
struct Fit {
    double width = 0;    ///< of the hologram, metres
    double height = 0;   ///< of the hologram, metres
    double fill = 0.85;  ///< share of the hologram's width or height that the scene fills, seen head-on
    double front = 0;    ///< share of the scene's depth that lies in front of the hologram plane: 0 none (the scene
                       ///< begins at the plane), 0.5 half of it, 1 all of it; −1: the scene begins behind the plane, at
                       ///< a distance equal to its depth
};

/// Scales a scene uniformly and moves it so that it is centred on the hologram, at the depth that `fit` says. Lights
/// move along; the intensities of point lights scale with the square of the length, which keeps irradiances. Throws
/// Error(usage) for sizes that are not positive, and Error(bad_input) for a scene without width and height.
HOGEL_API void fit_scene(Scene& scene, const Fit& fit);

/// Adds a key light from the upper left in front, a weaker fill light from the right and a little ambient light, for
/// scenes without lights. Both are directional, hence independent of the scene's size.
HOGEL_API void add_default_lights(Scene& scene);

/// Writes a scene with given radiance as a binary glTF file (.glb), in metres and in the world frame. The radiance of a
/// vertex is its colour (linear 32-bit floats, which may exceed 1), the materials are unlit (KHR_materials_unlit), and
/// a texture that multiplies the radiance is embedded as PNG. What made the file, `metadata` with the scene's name and
/// provenance behind it, is the object "hogel" of the document's asset.extras. import_scene() reads all that back.
/// Throws Error(bad_input) for a mesh without radiance, Error(usage) for a name that does not end in .glb,
/// Error(cannot_write).
HOGEL_API void write_baked_scene(const std::filesystem::path& path, const Scene& scene, const Metadata& metadata = {});

/// Throws Error(usage) for a name that write_baked_scene() would refuse. To be called before a scene is baked.
HOGEL_API void require_baked_scene_name(const std::filesystem::path& path);

}  // namespace hogel
