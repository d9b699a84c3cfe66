// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// The name of the mesh of discs that a point cloud becomes.
inline constexpr std::string_view points_name = "points";

/// How import_scene() reads a file.
struct ImportOptions {
    /// Size of the discs that the points of a point cloud become, relative to discs that just close the surface.
    double point_size = 1;
};

/// Reads any mesh file that assimp reads (OBJ, PLY, STL, glTF/GLB and more): positions, normals, vertex colours, base
/// colours and base-colour textures, glTF's materials and lights, with all node transforms applied, in the file's own
/// units and axes. The points of a point cloud (PLY without faces, XYZ) become discs. The colour of an unlit material
/// becomes given radiance. Missing normals are added. Files outside the mesh's own folder are not opened. What of the
/// file is not shown is said in Scene::notes. A scene without lights: see add_default_lights(). assimp works in a
/// child process whose memory and time are limited in proportion to the files (docs/files.md, "Meshes"), so that a
/// damaged file cannot harm this one. Throws Error(bad_input) with one line: the file, and what is missing, damaged or
/// out of range; Error(cancelled); and Error(not_built_in) in a build without assimp.
HOGEL_API Scene import_scene(const std::filesystem::path& path, const Progress& progress = {},
                             const ImportOptions& options = {});

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

/// How a person turns, places and lights a scene of their own. Applied in the order of the members.
struct ScenePose {
    // Before a scene is fitted to the hologram.
    std::optional<Vec3> up = {};  ///< the axis of the scene, or its opposite, that is turned upwards; none: Scene::up
    Vec3 rotation = {};           ///< radians about x, then y, then z, as the viewer sees them, after that
    /// The name or number of a camera of the scene's file whose picture the hologram is: see frame_scene(). In place of
    /// turning and fitting; empty: none.
    std::string camera = {};
    // After it.
    double scale = 1;                           ///< about the middle of the hologram
    Vec3 shift = {};                            ///< metres
    std::optional<Rgb> color = {};              ///< base colour of all surfaces, in place of their colours and textures
    std::shared_ptr<const Image> texture = {};  ///< the same as a picture, for meshes that have texture coordinates
    std::vector<Light> lights = {};             ///< in place of all others, unless empty
    std::optional<Rgb> background = {};         ///< radiance of rays that meet nothing
    std::optional<Rgb> ground = {};             ///< colour of a level ground under the scene; none: there is none
};

/// The camera of a scene by its name or its number, from 1. Throws Error(usage), which names those that there are.
HOGEL_API const SceneCamera& find_camera(const Scene& scene, const std::string& name);

/// Turns, scales and moves a scene so that the hologram is the picture of one of its cameras: an eye on the hologram's
/// axis at the distance that is returned sees what the camera sees. The picture's height becomes that of the hologram.
/// The hologram's plane lies where its disparity from that eye divides that of what the picture shows as `fit.front`
/// says, so that a far background moves it little. What lies behind the eye, and touches what lies there, is removed.
/// Lights move along; `fit.fill` means nothing. Throws Error(bad_input) where the camera sees nothing.
/// @return  metres; infinite for a camera with parallel rays
HOGEL_API double frame_scene(Scene& scene, const SceneCamera& camera, const Fit& fit);

/// Turns a scene about the middle of the hologram, with its lights. Throws Error(usage) for an `up` that is no axis.
HOGEL_API void turn_scene(Scene& scene, const ScenePose& pose);

/// Scales, moves, colours and lights a scene, and adds the ground, which is as wide as the hologram or the scene and
/// cut finely enough to show shadows. Throws Error(usage) for a scale that is not positive, and for a texture where no
/// mesh has texture coordinates.
/// @param hologram_width  metres
HOGEL_API void place_scene(Scene& scene, const ScenePose& pose, double hologram_width);

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
