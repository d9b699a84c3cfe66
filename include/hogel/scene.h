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

#include "hogel/array.h"
#include "hogel/export.h"
#include "hogel/geometry.h"
#include "hogel/image.h"
#include "hogel/progress.h"
#include "hogel/provenance.h"
#include "hogel/table.h"

namespace hogel {

/// Sampling of a texture between texels and beyond its edges: the samplers of glTF 2.0.
struct TextureSampling {
    /// Continuation beyond the edge of a picture: repeated, mirrored, or with its last texels.
    enum class Wrap : std::uint8_t { repeat, mirror, clamp };
    Wrap wrap_u = Wrap::repeat;  ///< to the left and right
    Wrap wrap_v = Wrap::repeat;  ///< below and above
    bool nearest = false;        ///< no interpolation: texels are squares of one value

    friend bool operator==(const TextureSampling&, const TextureSampling&) = default;
};

/// Meaning of a surface's alpha, 0 to 1.
enum class AlphaMode : std::uint8_t {
    opaque,  ///< none
    mask,    ///< the surface exists only where alpha is at least the cutoff
    blend    ///< fraction of a ray's radiance from the surface; the rest comes from behind it
};

/// Reflection of a surface, with the parameters of glTF 2.0: a base colour, modulated by vertices and a texture, and a
/// glossy lobe. Without the lobe (reflectance and metallic zero) the surface is diffuse.
struct Material {
    Rgb base_color{0.8f, 0.8f, 0.8f};                 ///< linear reflectance
    float reflectance = 0;                            ///< of the lobe at normal incidence; 0.04 for glass and lacquer
    float metallic = 0;                               ///< 1: no diffuse light, and a lobe in the base colour
    float roughness = 1;                              ///< of the lobe, with a width of about its square
    Rgb emission{0, 0, 0};                            ///< emitted radiance
    std::shared_ptr<const Image> base_color_texture;  ///< linear; a fourth channel is alpha; can be null
    TextureSampling base_color_sampling;              ///< of that texture
    /// Multiplies the emission; linear. Null: the base-colour texture multiplies it.
    std::shared_ptr<const Image> emission_texture;
    TextureSampling emission_sampling;  ///< of that texture
    /// Green multiplies the roughness and blue multiplies `metallic`, without a transfer curve; can be null.
    std::shared_ptr<const Image> metallic_roughness_texture;
    TextureSampling metallic_roughness_sampling;  ///< of that texture
    /// Red, green and blue, scaled to −1 … 1, are the components of the normal along growing u, along growing v and
    /// away from the surface. The first two are multiplied by `normal_scale`. Can be null.
    std::shared_ptr<const Image> normal_texture;
    TextureSampling normal_sampling;  ///< of that texture
    float normal_scale = 1;           ///< of the slopes in that texture
    /// Red multiplies the ambient light, weighted with `occlusion_strength`; can be null.
    std::shared_ptr<const Image> occlusion_texture;
    TextureSampling occlusion_sampling;  ///< of that texture
    float occlusion_strength = 1;        ///< 0: no effect
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha = 1;            ///< multiplied by alpha of the vertices and of the base-colour texture
    float alpha_cutoff = 0.5f;  ///< for AlphaMode::mask
    /// Whether the back of a surface shows light that falls on the back; otherwise it shows the light on the front.
    bool double_sided = false;

    /// Returns whether there is a lobe.
    bool is_glossy() const { return reflectance > 0 || metallic > 0; }
};

/// A point of a texture: u to the right, v up, (0, 0) at the bottom left of the picture.
struct TextureCoordinate {
    float u = 0;  ///< 0 to 1 across the picture
    float v = 0;  ///< 0 to 1 up the picture
};

/// Triangles with one material. Vectors of vertex attributes are empty or as long as `positions`.
struct Mesh {
    std::vector<Vec3> positions;  ///< metres, world frame: the hologram is the plane z = 0, the viewer at z > 0
    std::vector<Vec3> normals;    ///< unit length
    std::vector<Rgb> colors;      ///< linear, multiplied by the base colour
    std::vector<Rgb> radiance;    ///< given radiance, which replaces all lighting; the texture multiplies it
    std::vector<float> alphas;    ///< multiplied by the material's alpha, if its mode uses alpha
    std::vector<TextureCoordinate> texture_coordinates;  ///< of the material's textures
    /// Coordinates of the emission texture; empty: `texture_coordinates`.
    std::vector<TextureCoordinate> emission_coordinates;
    /// Coordinates of the metallic-roughness texture; empty: `texture_coordinates`.
    std::vector<TextureCoordinate> metallic_roughness_coordinates;
    std::vector<TextureCoordinate> normal_coordinates;     ///< of the normal texture; empty: `texture_coordinates`
    std::vector<TextureCoordinate> occlusion_coordinates;  ///< of the occlusion texture; empty: `texture_coordinates`
    std::vector<std::array<std::uint32_t, 3>> triangles;   ///< counterclockwise from outside
    Material material;                                     ///< of all triangles
    std::string name;                                      ///< for messages
};

/// A light. Only point lights fall off with the squared distance. A point light with a cone is a spot light.
struct Light {
    /// A point light has a position, a directional light a direction.
    enum class Kind { point, directional };
    Kind kind = Kind::directional;
    Vec3 position;              ///< of a point light, metres
    Vec3 direction;             ///< of travel, for a directional or spot light; unit length
    Rgb intensity;              ///< point: radiant intensity; directional: irradiance at normal incidence
    bool casts_shadows = true;  ///< false: surfaces do not block it
    /// Half-angles of a spot light's cone about its direction, radians: full light up to the inner one, none beyond the
    /// outer one. With c the cosine of the angle to the direction, light between them is multiplied by ((c − cos outer)
    /// / (cos inner − cos outer))², as in glTF. An outer angle of π or more means no cone.
    double outer_cone = std::numbers::pi;
    double inner_cone = 0;  ///< at most outer_cone
};

/// A camera of a scene's file, in the frame of the scene.
struct SceneCamera {
    std::string name;     ///< can be empty
    Vec3 position;        ///< of the viewpoint
    Vec3 right{1, 0, 0};  ///< unit length
    Vec3 up{0, 1, 0};     ///< unit length, perpendicular to `right`
    double angle = 0;     ///< vertical angle of view, radians; 0: parallel rays
    double height = 0;    ///< of the picture, for parallel rays
    double nearest = 0;   ///< near clipping distance
};

/// Units of a scene's coordinates until prepare_scene() places the scene at a hologram.
enum class SceneUnits : std::uint8_t {
    any,             ///< of a shape, which is moved and scaled as a whole
    picture_widths,  ///< of a picture, which fills the hologram; z is scaled as x and y are
    depths           ///< of a picture; z is in metres from the hologram plane, and only x and y are scaled
};

/// Surfaces, lights and background of a scene.
struct Scene {
    std::string name;                    ///< for messages and files
    std::vector<Mesh> meshes;            ///< in any order
    std::vector<Light> lights;           ///< in any order
    Rgb ambient{0, 0, 0};                ///< radiance from all directions, unshadowed
    Rgb background{0, 0, 0};             ///< radiance of rays that meet nothing
    std::vector<SceneCamera> cameras;    ///< of its file; see frame_scene()
    Vec3 up{0, 1, 0};                    ///< upward axis in its file, for turn_scene()
    SceneUnits units = SceneUnits::any;  ///< of the coordinates
    /// Whether most of the surface is triangles so large that shadows fall between their corners; set by
    /// prepare_scene(). The shading model `auto` then selects `direct`.
    bool has_large_triangles = false;
    Metadata provenance;  ///< origin in the file, if it has one: write_baked_scene()
    /// Remarks about contents of the file that are not shown, or shown differently; one line each.
    std::vector<std::string> notes;
};

/// A box with edges along the axes.
struct Bounds {
    Vec3 low;   ///< smallest coordinates
    Vec3 high;  ///< largest coordinates
};

/// Returns the box around the vertices of all triangles, metres. Throws Error(bad_input) without triangles.
HOGEL_API Bounds bounds(const Scene& scene);

/// Returns the number of triangles of all meshes.
HOGEL_API std::size_t triangle_count(const Scene& scene);

/// Returns a checksum of all visible contents: surfaces, materials, pixels of textures, lights. Excludes names.
HOGEL_API std::uint32_t checksum(const Scene& scene);

/// Adds smooth normals to every mesh without normals: area-weighted means over the triangles that share a vertex
/// position. Vertices are split if faces meet at more than `crease` radians.
HOGEL_API void add_missing_normals(Scene& scene, double crease);

/// Throws Error(bad_input) for an index out of range, a coordinate that is not finite, an attribute list of the wrong
/// length, and a scene without triangles. The message names the mesh, the element and the expected value.
HOGEL_API void validate(const Scene& scene);

/// A generated scene.
struct SceneInfo {
    std::string name;  ///< for make_scene()
    std::string text;  ///< one line
    /// Makes the scene for a square hologram of this side (metres). Size and depths scale with the side.
    std::function<Scene(double hologram_size, const Progress& progress)> make;
};

/// Returns the built-in scenes by name.
HOGEL_API Table<SceneInfo>& scenes();

/// Makes the scene of this name for a square hologram of this side (metres). Throws Error(usage) for an unknown name or
/// a size that is not positive.
HOGEL_API Scene make_scene(std::string_view name, double hologram_size, const Progress& progress = {});

/// Name of the mesh of discs that represents a point cloud.
inline constexpr std::string_view points_name = "points";

/// Meaning of the values of a depth map.
enum class DepthValues : std::uint8_t {
    automatic,  ///< `distance` for a depth channel of the picture's own file, otherwise `nearness`
    nearness,   ///< the largest value is the nearest; depth is linear in the value
    distance,   ///< the largest value is the farthest; depth is linear in the value
    disparity   ///< the largest value is the nearest; the reciprocal of the distance from the viewpoint is linear in it
};

/// Depths of a depth map. Depth is positive behind the hologram (docs/notation.md).
struct DepthMapOptions {
    DepthValues values = DepthValues::automatic;
    /// Depths of the nearest and the farthest value in the map, metres; both or none. Without them the depth range is a
    /// quarter of the picture's width, and LightFieldRequest::front places it.
    std::optional<double> near = {}, far = {};
    double viewpoint = 0.3;  ///< distance of the viewpoint in front of the hologram for disparities, metres
};

/// Returns the scene of a picture: a rectangle whose radiance is the picture, one unit wide at z = 0. The picture has
/// one, three or, with alpha, four channels. Radiances that are negative or not finite become 0. Throws
/// Error(bad_input) for an empty picture.
HOGEL_API Scene scene_of_picture(Image picture);

/// Returns the scene of a picture with a depth map of any size: a surface whose picture, seen from infinity, is the
/// picture. Values that are not finite or at least 10⁹ are farthest. The surface is cut where neighbouring values
/// differ by more than 1/20 of the map's range; behind such an edge the farther surface continues. The map is read at
/// no more than 2^20 points. Throws Error(bad_input) for an empty picture, and for a map that is empty or of another
/// aspect ratio (by more than 5 %), and Error(usage) for invalid options.
HOGEL_API Scene scene_of_picture(Image picture, View<const float, 2> depth_map, const DepthMapOptions& options = {});

/// Options of import_scene().
struct ImportOptions {
    /// Size of the discs of a point cloud, relative to discs that just close the surface.
    double point_size = 1;
    std::filesystem::path depth_map = {};  ///< picture of the depths of a picture file; empty: none
    DepthMapOptions depths = {};           ///< of that map
};

/// Reads a picture file (read_image()) as scene_of_picture() does, with its alpha (PNG, TGA, WebP) and the channel Z or
/// depth of an EXR file as depth map; a file of layers (.layers, docs/pictures.md); or a mesh file. Throws Error(usage)
/// for a depth map with another file than a picture, and for depths of a picture without a depth map, and
/// Error(bad_input) for a coloured depth map.
///
/// Reads mesh files with assimp (OBJ, PLY, STL, glTF/GLB and more): positions, normals, vertex colours, base colours
/// and base-colour textures, and glTF's materials and lights. All node transforms are applied; units and axes are those
/// of the file. Points of a point cloud (PLY without faces, XYZ) become discs. The colour of an unlit material becomes
/// given radiance. Missing normals are added. Scene::notes lists contents that are not shown. For a scene without
/// lights see add_default_lights().
///
/// Files outside the mesh's own folder are not opened. assimp runs in a child process with memory and time limits in
/// proportion to the files (docs/files.md, "Meshes"), so a damaged file cannot harm this process. Throws
/// Error(bad_input) with one line: the file, and what is missing, damaged or out of range; Error(cancelled); and
/// Error(not_built_in) in builds without assimp.
HOGEL_API Scene import_scene(const std::filesystem::path& path, const Progress& progress = {},
                             const ImportOptions& options = {});

/// Size and position of a scene for fit_scene().
struct Fit {
    double width = 0;    ///< of the hologram, metres
    double height = 0;   ///< of the hologram, metres
    double fill = 0.85;  ///< fraction of the hologram's width or height that the scene fills, seen head-on
    /// Fraction of the scene's depth in front of the hologram plane: 0 none (the scene begins at the plane), 0.5 half,
    /// 1 all; −1: the scene begins behind the plane, at a distance equal to its depth.
    double front = 0;
};

/// Scales a scene uniformly and moves it to the centre of the hologram and the depth in `fit`. Lights move with it.
/// Intensities of point lights scale with the square of the length, which keeps irradiances. Throws Error(usage) for
/// sizes that are not positive, and Error(bad_input) for a scene without width and height.
HOGEL_API void fit_scene(Scene& scene, const Fit& fit);

/// Orientation, position, colours and lights of a scene, applied in the order of the members.
struct ScenePose {
    // Before fitting the scene to the hologram.
    std::optional<Vec3> up = {};  ///< axis of the scene, or its opposite, to turn upwards; empty: Scene::up
    Vec3 rotation = {};           ///< after that: radians about x, then y, then z, as the viewer sees them
    /// Name or number of a camera in the scene's file with the hologram as its picture (frame_scene()), in place of
    /// turning and fitting; empty: none.
    std::string camera = {};
    // After fitting.
    double scale = 1;                           ///< about the centre of the hologram
    Vec3 shift = {};                            ///< metres
    std::optional<Rgb> color = {};              ///< base colour of all surfaces, in place of their colours and textures
    std::shared_ptr<const Image> texture = {};  ///< the same as a picture, for meshes with texture coordinates
    std::vector<Light> lights = {};             ///< in place of all others, unless empty
    std::optional<Rgb> background = {};         ///< radiance of rays that meet nothing
    std::optional<Rgb> ground = {};             ///< colour of a level ground under the scene; empty: no ground
};

/// Returns the camera of a scene by name or by number, from 1. Throws Error(usage) with the existing cameras.
HOGEL_API const SceneCamera& find_camera(const Scene& scene, const std::string& name);

/// Turns, scales and moves a scene to make the hologram the picture of one of its cameras. A viewpoint on the
/// hologram's axis, at the returned distance, sees the camera's picture; the picture's height becomes the hologram's.
/// `fit.front` places the hologram plane: it divides the disparity range (seen from that viewpoint) of everything in
/// the picture, so a far background moves the plane little. Surfaces nearer than the camera's near plane, and behind
/// the viewpoint, are cut off. Lights move with the scene; `fit.fill` is ignored. Throws Error(bad_input) if the camera
/// sees nothing, and Error(usage) for sizes that are not positive.
/// @return  distance, metres; infinite for a camera with parallel rays
HOGEL_API double frame_scene(Scene& scene, const SceneCamera& camera, const Fit& fit);

/// Turns a scene and its lights about the centre of the hologram. Throws Error(usage) if `up` is not an axis.
HOGEL_API void turn_scene(Scene& scene, const ScenePose& pose);

/// Scales, moves, colours and lights a scene, and adds the ground. The ground is as wide as the hologram or the scene,
/// and divided finely enough to show shadows. Throws Error(usage) for a scale that is not positive, and for a texture
/// if no mesh has texture coordinates.
/// @param hologram_width  metres
HOGEL_API void place_scene(Scene& scene, const ScenePose& pose, double hologram_width);

/// Adds a key light from the upper left in front, a weaker fill light from the right and a little ambient light, for
/// scenes without lights. Both are directional, hence independent of the scene's size.
HOGEL_API void add_default_lights(Scene& scene);

/// Writes a scene with given radiance as a binary glTF file (.glb), in metres and in the world frame. The radiance of a
/// vertex is its colour (linear 32-bit floats, which can exceed 1). Materials are unlit (KHR_materials_unlit). A
/// texture that multiplies the radiance is embedded as PNG. `metadata`, followed by the scene's name and provenance, is
/// the object "hogel" in asset.extras of the document. import_scene() reads all of it. Throws Error(bad_input) for a
/// mesh without radiance, Error(usage) for a name without the extension .glb, Error(cannot_write).
HOGEL_API void write_baked_scene(const std::filesystem::path& path, const Scene& scene, const Metadata& metadata = {});

/// Throws Error(usage) if write_baked_scene() would refuse this name. Call it before baking a scene.
HOGEL_API void require_baked_scene_name(const std::filesystem::path& path);

}  // namespace hogel
