// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/geometry.h"
#include "hogel/image.h"

namespace hogel {

/// How a surface reflects, by the words of glTF 2.0: a base colour, which vertices and a texture modulate, and a glossy
/// lobe. Without the lobe (reflectance and metallic zero) a surface is matt.
struct Material {
    Rgb base_color{0.8f, 0.8f, 0.8f};                 ///< linear reflectance
    float reflectance = 0;                            ///< of the lobe at normal incidence; 0.04 for glass and lacquer
    float metallic = 0;                               ///< 1: no diffuse light, and a lobe in the base colour
    float roughness = 1;                              ///< of the lobe: its width is about the square of this
    Rgb emission{0, 0, 0};                            ///< radiance that it sends out by itself
    std::shared_ptr<const Image> base_color_texture;  ///< linear, repeats; null without one

    bool is_glossy() const { return reflectance > 0 || metallic > 0; }
};

struct TextureCoordinate {
    float u = 0, v = 0;  ///< u to the right, v up: (0,0) is the bottom left of the picture
};

/// Triangles of one material. The vectors of vertex attributes are empty or as long as `positions`.
struct Mesh {
    std::vector<Vec3> positions;  ///< metres, world frame: the hologram is the plane z = 0, the viewer at z > 0
    std::vector<Vec3> normals;    ///< unit length
    std::vector<Rgb> colors;      ///< linear, multiplies the base colour
    std::vector<Rgb> radiance;    ///< given: what the surface shows whatever the lights (the texture multiplies it)
    std::vector<TextureCoordinate> texture_coordinates;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
    Material material;
    std::string name;
};

/// A lamp. Point lights fall off with the square of the distance, directional ones do not.
struct Light {
    enum class Kind { point, directional } kind = Kind::directional;
    Vec3 position;   ///< point: where it is
    Vec3 direction;  ///< directional: where its light travels to, unit length
    Rgb intensity;   ///< point: radiant intensity; directional: irradiance at normal incidence
    bool casts_shadows = true;
};

/// What is to be seen: surfaces, lamps, and the radiance of rays that meet nothing.
struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Light> lights;
    Rgb ambient{0, 0, 0};     ///< radiance from all directions, unshadowed
    Rgb background{0, 0, 0};  ///< radiance of rays that meet nothing
};

struct Bounds {
    Vec3 low, high;
};

/// The box around all vertices that triangles use. Throws Error(bad_input) for a scene without triangles.
HOGEL_API Bounds bounds(const Scene& scene);

HOGEL_API std::size_t triangle_count(const Scene& scene);

/// A number that tells scenes apart by all that is to be seen of them: surfaces, materials, the pixels of textures,
/// lamps. Names do not matter.
HOGEL_API std::uint32_t checksum(const Scene& scene);

/// Gives every mesh without normals smooth ones (area-weighted averages over triangles that share a vertex position,
/// split where faces meet at more than `crease` radians).
HOGEL_API void add_missing_normals(Scene& scene, double crease);

/// Throws Error(bad_input) naming the mesh, the element and what was expected: an index out of range, a coordinate that
/// is not finite, an attribute list of the wrong length, no triangles at all.
HOGEL_API void validate(const Scene& scene);

}  // namespace hogel
