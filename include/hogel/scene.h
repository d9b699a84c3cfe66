// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/geometry.h"
#include "hogel/image.h"
#include "hogel/provenance.h"

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

}  // namespace hogel
