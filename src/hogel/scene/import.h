#pragma once

#include <filesystem>

#include "hogel/scene/scene.h"

namespace hogel {

/// Reads any mesh file that assimp reads (OBJ, PLY, STL, glTF/GLB and more): positions, normals, vertex colours, base
/// colours and base-colour textures, glTF's metallic-roughness materials, with all node transforms applied, in the
/// file's own units and axes. What an unlit material shows becomes given radiance. Adds missing normals. Files outside
/// the mesh's own folder are not opened. The scene has no lights: see add_default_lights. Throws Error(bad_input) with
/// one line: the file, and what is missing, damaged or out of range.
Scene import_scene(const std::filesystem::path& path);

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
void fit_scene(Scene& scene, const Fit& fit);

/// A key light from the upper left in front, a weaker fill light from the right and a little ambient light, for scenes
/// that bring no lights. Directional, so independent of the scene's size.
void add_default_lights(Scene& scene);

}  // namespace hogel
