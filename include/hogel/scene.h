// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/export.h"
#include "hogel/geometry.h"
#include "hogel/image.h"
#include "hogel/progress.h"
#include "hogel/provenance.h"
#include "hogel/table.h"

namespace hogel {

/// How a texture is read between its texels and beyond its picture: the samplers of glTF 2.0.
struct TextureSampling {
    /// What follows at the edge of a picture: the picture again, its mirror image, or its last texels.
    enum class Wrap : std::uint8_t { repeat, mirror, clamp };
    Wrap wrap_u = Wrap::repeat;  ///< to the left and right
    Wrap wrap_v = Wrap::repeat;  ///< below and above
    bool nearest = false;        ///< texels are squares of one value instead of being interpolated

    friend bool operator==(const TextureSampling&, const TextureSampling&) = default;
};

/// What the alpha of a surface, from 0 to 1, means.
enum class AlphaMode : std::uint8_t {
    opaque,  ///< nothing
    mask,    ///< the surface is there where alpha is at least the cutoff, and nowhere else
    blend    ///< the share of a ray's radiance that the surface gives; what is behind it gives the rest
};

/// How a surface reflects, with the parameters of glTF 2.0: a base colour, which vertices and a texture modulate, and a
/// glossy lobe. Without the lobe (reflectance and metallic zero) a surface is matt.
struct Material {
    Rgb base_color{0.8f, 0.8f, 0.8f};                 ///< linear reflectance
    float reflectance = 0;                            ///< of the lobe at normal incidence; 0.04 for glass and lacquer
    float metallic = 0;                               ///< 1: no diffuse light, and a lobe in the base colour
    float roughness = 1;                              ///< of the lobe, whose width is about the square of this
    Rgb emission{0, 0, 0};                            ///< radiance that the surface emits
    std::shared_ptr<const Image> base_color_texture;  ///< linear; a fourth channel is alpha; may be null
    TextureSampling base_color_sampling;              ///< of that texture
    /// Multiplies the emission; linear. Null: the base-colour texture multiplies it, as it does all light.
    std::shared_ptr<const Image> emission_texture;
    TextureSampling emission_sampling;  ///< of that texture
    /// Its green multiplies the roughness and its blue `metallic`, as numbers without a transfer curve; may be null.
    std::shared_ptr<const Image> metallic_roughness_texture;
    TextureSampling metallic_roughness_sampling;  ///< of that texture
    /// Its red, green and blue, as numbers from −1 to 1, are the normal's parts along growing u, along growing v and
    /// away from the surface, the first two times `normal_scale`; may be null.
    std::shared_ptr<const Image> normal_texture;
    TextureSampling normal_sampling;  ///< of that texture
    float normal_scale = 1;           ///< of the slopes of that texture
    /// Its red multiplies the ambient light, by the part `occlusion_strength` of it; may be null.
    std::shared_ptr<const Image> occlusion_texture;
    TextureSampling occlusion_sampling;        ///< of that texture
    float occlusion_strength = 1;              ///< 0: the texture does nothing
    AlphaMode alpha_mode = AlphaMode::opaque;  ///< what alpha means
    float alpha = 1;                           ///< multiplied by that of vertices and of the base-colour texture
    float alpha_cutoff = 0.5f;                 ///< of AlphaMode::mask
    /// Whether the back of a surface shows the light that falls on the back; otherwise it shows that on the front.
    bool double_sided = false;

    /// Whether there is a lobe.
    bool is_glossy() const { return reflectance > 0 || metallic > 0; }
};

/// A point of a texture: u to the right, v up, (0, 0) at the bottom left of the picture.
struct TextureCoordinate {
    float u = 0;  ///< 0 to 1 across the picture
    float v = 0;  ///< 0 to 1 up the picture
};

/// Triangles of one material. The vectors of vertex attributes are empty or as long as `positions`.
struct Mesh {
    std::vector<Vec3> positions;  ///< metres, world frame: the hologram is the plane z = 0, the viewer at z > 0
    std::vector<Vec3> normals;    ///< unit length
    std::vector<Rgb> colors;      ///< linear, multiplied by the base colour
    std::vector<Rgb> radiance;    ///< given radiance, which replaces all lighting (the texture multiplies it)
    std::vector<float> alphas;    ///< multiplied by the material's alpha, where that means something
    std::vector<TextureCoordinate> texture_coordinates;  ///< of the material's textures
    /// Those of the emission texture; empty: `texture_coordinates`.
    std::vector<TextureCoordinate> emission_coordinates;
    /// Those of the metallic-roughness texture; empty: `texture_coordinates`.
    std::vector<TextureCoordinate> metallic_roughness_coordinates;
    std::vector<TextureCoordinate> normal_coordinates;     ///< of the normal texture; empty: `texture_coordinates`
    std::vector<TextureCoordinate> occlusion_coordinates;  ///< of the occlusion texture; empty: `texture_coordinates`
    std::vector<std::array<std::uint32_t, 3>> triangles;   ///< counterclockwise from outside
    Material material;                                     ///< of all triangles
    std::string name;                                      ///< for messages
};

/// A light. Point lights fall off with the square of the distance, directional ones do not. A point light with a cone
/// is a spot light.
struct Light {
    /// A point light has a position, a directional one a direction.
    enum class Kind { point, directional };
    Kind kind = Kind::directional;  ///< decides which of the members below are used
    Vec3 position;                  ///< of a point light, metres
    Vec3 direction;                 ///< in which the light of a directional or spot light travels, unit length
    Rgb intensity;                  ///< point: radiant intensity; directional: irradiance at normal incidence
    bool casts_shadows = true;      ///< false: surfaces do not block it
    /// Half-angles of a point light's cone about its direction, radians: the light is full up to the inner one and none
    /// from the outer one on. With c the cosine of the angle from the direction, it is between them by the factor
    /// ((c − cos outer) / (cos inner − cos outer))², as in glTF. From π on there is no cone.
    double outer_cone = std::numbers::pi;
    double inner_cone = 0;  ///< at most outer_cone
};

/// A camera that a scene's file holds, in the frame of the scene.
struct SceneCamera {
    std::string name;     ///< may be empty
    Vec3 position;        ///< of its eye
    Vec3 right{1, 0, 0};  ///< unit length
    Vec3 up{0, 1, 0};     ///< unit length, across `right`
    double angle = 0;     ///< from the lower to the upper edge of its picture, radians; 0: its rays are parallel
    double height = 0;    ///< of its picture where rays are parallel
    double nearest = 0;   ///< what lies nearer than this is not in its picture
};

/// Surfaces, lights, and the radiance of rays that meet nothing.
struct Scene {
    std::string name;                  ///< for messages and files
    std::vector<Mesh> meshes;          ///< in any order
    std::vector<Light> lights;         ///< in any order
    Rgb ambient{0, 0, 0};              ///< radiance from all directions, unshadowed
    Rgb background{0, 0, 0};           ///< radiance of rays that meet nothing
    std::vector<SceneCamera> cameras;  ///< of its file; see frame_scene()
    Vec3 up{0, 1, 0};                  ///< the axis that points upwards in its file, by which turn_scene() turns it
    /// Whether most of its surface are triangles so large that shadows lie between their corners; prepare_scene() finds
    /// it out. The shading model `auto` is then `direct`.
    bool has_large_triangles = false;
    Metadata provenance;  ///< what made it, if its file says so: write_baked_scene()
    /// What the file of a scene holds that is not shown, or is shown otherwise: a line each, for people.
    std::vector<std::string> notes;
};

/// A box with edges along the axes.
struct Bounds {
    Vec3 low;   ///< smallest coordinates
    Vec3 high;  ///< largest coordinates
};

/// The box around all vertices that triangles use. Throws Error(bad_input) for a scene without triangles.
HOGEL_API Bounds bounds(const Scene& scene);

/// The number of triangles of all meshes.
HOGEL_API std::size_t triangle_count(const Scene& scene);

/// A checksum of everything visible: surfaces, materials, the pixels of textures, lights. Names are not included.
HOGEL_API std::uint32_t checksum(const Scene& scene);

/// Adds smooth normals to every mesh without normals: area-weighted means over the triangles that share a vertex
/// position. Vertices are split where faces meet at more than `crease` radians.
HOGEL_API void add_missing_normals(Scene& scene, double crease);

/// Throws Error(bad_input), which names the mesh, the element and what was expected, for an index out of range, a
/// coordinate that is not finite, an attribute list of the wrong length, and a scene without triangles.
HOGEL_API void validate(const Scene& scene);

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
