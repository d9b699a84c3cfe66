// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "hogel/scene_hologram.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::direct {

/// A luminous point of a scene.
struct ScenePoint {
    Vec3 position;    ///< the centre of its wave
    Vec3 surface;     ///< the point of the surface: the same, unless it was moved away from the hologram plane
    Vec3 normal;      ///< of the surface, whose light falls off with the cosine; zero: equal in all directions
    float amplitude;  ///< √(L A) for an area A of radiance L
    double cycles;    ///< its phase, [0, 1)
};

/// Samples the triangles of a scene by points with random phases, at most `spacing` apart and at least one per
/// triangle. Points nearer to the hologram plane than nearest_depth() are moved to that depth.
std::vector<ScenePoint> surface_points(const ShadedScene& scene, const FieldGrid& grid,
                                       const SceneHologramOptions& options);

/// Lines along which surfaces end, meet at more than 30 degrees, or touch another mesh.
struct SceneEdge {
    Vec3 a, b;
    float radiance;
};
std::vector<SceneEdge> scene_edges(const ShadedScene& scene, const SceneHologramOptions& options);

/// Points along the edges of a scene, `spacing` apart, each of which represents an area of spacing².
std::vector<ScenePoint> edge_points(const ShadedScene& scene, const FieldGrid& grid,
                                    const SceneHologramOptions& options);

/// The least depth of a point. Nearer points would have wrong brightness, because the zone of the hologram that the
/// pitch can sample is only a few samples wide.
double nearest_depth(const FieldGrid& grid);

/// A random number in [0, 1) that depends only on the arguments.
double random_cycles(const SceneHologramOptions& options, std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// The light of a point at a position on the hologram. It travels towards the viewer: away from a point behind the
/// hologram, towards a point in front of it.
struct Passage {
    double path;     ///< metres travelled since the point; negative before it reaches the point
    Vec3 direction;  ///< unit length, towards the viewer
};

inline Passage unlimited_passage(Vec3 point, Vec3 place) {
    const Vec3 path = point.z < 0 ? place - point : point - place;
    const double distance = length(path);
    return {point.z < 0 ? distance : -distance, (1 / distance) * path};
}

/// Whether the light is steeper than the hologram's pitch can sample.
inline bool too_steep(const Passage& passage, const FieldGrid& grid) {
    return std::abs(passage.direction.x) * 2 * grid.plane.pitch_x > grid.wavelength ||
           std::abs(passage.direction.y) * 2 * grid.plane.pitch_y > grid.wavelength;
}

/// The light of `point` at `place`; nothing if it is too steep.
inline std::optional<Passage> passage(Vec3 point, Vec3 place, const FieldGrid& grid) {
    const Passage passage = unlimited_passage(point, place);
    if (too_steep(passage, grid)) return {};
    return passage;
}

/// The modulus of a point's wave at that position.
double modulus(const ScenePoint& point, const Passage& passage);

/// Tests whether a viewer sees points of a scene.
class Visibility {
  public:
    explicit Visibility(const ShadedScene& scene);
    /// Whether nothing is between the point and a distant viewer in that direction.
    bool is_visible(Vec3 point, Vec3 direction) const { return !caster_.occluded(point, direction, margin_, far_); }
    /// As is_visible(), for many directions: sets hidden[i] if the point is not visible in direction i.
    void hide(Vec3 point, std::span<const Vec3> directions, std::span<bool> hidden) const {
        caster_.occluded(point, directions, margin_, far_, hidden);
    }
    const trace::RayCaster& caster() const { return caster_; }

  private:
    trace::RayCaster caster_;
    double margin_ = 0, far_ = 0;
};

/// The side of the tiles of sum_over_tiles(), samples.
inline constexpr std::size_t tile_side = 32;

/// Computes a field tile by tile on all threads; add(region, values of the region) fills a tile.
Field sum_over_tiles(const FieldGrid& grid, const Progress& progress,
                     const std::function<void(const Region&, View<std::complex<float>, 2>)>& add);

/// Computes a field sample by sample on all threads; wave(position) is its value at a position on the hologram.
Field sum_over_samples(const FieldGrid& grid, const Progress& progress,
                       const std::function<std::complex<double>(Vec3 place)>& wave);

// The methods, which scene_hologram_methods() lists by name.
Field exact_points(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field exact_visible_points(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field tiled_points(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field horizontal_lines(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field points_along_edges(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field line_sources(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field fraunhofer_plane(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field fresnel_planes(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field occluding_planes(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field tilted_polygons(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);
Field occluding_polygons(const ShadedScene&, const FieldGrid&, const SceneHologramOptions&, const Progress&);

}  // namespace hogel::direct
