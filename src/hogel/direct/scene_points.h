// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "hogel/scene_hologram.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::direct {

struct ScenePoint {
    Vec3 position;    ///< centre of its wave
    Vec3 surface;     ///< the surface point; differs from `position` if that was moved away from the hologram plane
    Vec3 normal;      ///< of a diffuse surface (intensity ∝ cosine); zero: equal in all directions
    float amplitude;  ///< √(L A), A the area of radiance L that the point represents
    double cycles;    ///< phase, [0, 1)
};

/// Samples the triangles of a scene by points with random phases. Cuts each triangle into n² equal triangles with sides
/// of at most options.spacing metres, and puts a point at the centre of each. Drops triangles without area and points
/// without radiance. Moves points nearer to the hologram plane than nearest_depth() to that depth. Throws Error(usage)
/// for more than 10⁸ points.
std::vector<ScenePoint> surface_points(const ShadedScene& scene, const FieldGrid& grid,
                                       const SceneHologramOptions& options);

/// Line along which a surface ends, creases by more than 30 degrees, or meets another mesh.
struct SceneEdge {
    Vec3 a, b;
    float radiance;
};
std::vector<SceneEdge> scene_edges(const ShadedScene& scene, const SceneHologramOptions& options);

/// Samples the edges of a scene by points with random phases. Divides each edge into equal parts of about
/// options.spacing metres, at least one, and puts a point at the middle of each. A point represents a strip as long as
/// its part and options.spacing wide. Moves points as surface_points() does. Throws Error(usage) for more than 10⁸
/// points.
std::vector<ScenePoint> edge_points(const ShadedScene& scene, const FieldGrid& grid,
                                    const SceneHologramOptions& options);

/// Returns the minimum depth of a point, metres. The pitch undersamples the waves of nearer points.
double nearest_depth(const FieldGrid& grid);

/// Returns a random phase in cycles, [0, 1), that depends only on the arguments, the seed and the channel.
double random_cycles(const SceneHologramOptions& options, std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// Ray between a point and a position on the hologram, towards the viewer: from a point behind it, to a point in front.
struct Passage {
    double path;     ///< signed path from the point, metres; negative before the light reaches the point
    Vec3 direction;  ///< unit length, towards the viewer
};

inline Passage unlimited_passage(Vec3 point, Vec3 position) {
    const Vec3 path = point.z < 0 ? position - point : point - position;
    const double distance = length(path);
    return {point.z < 0 ? distance : -distance, (1 / distance) * path};
}

/// Returns whether the ray is steeper than the hologram's pitch can sample.
inline bool too_steep(const Passage& passage, const FieldGrid& grid) {
    return std::abs(passage.direction.x) * 2 * grid.plane.pitch_x > grid.wavelength ||
           std::abs(passage.direction.y) * 2 * grid.plane.pitch_y > grid.wavelength;
}

/// Returns the ray of `point` at `position`, or nothing if it is too steep.
inline std::optional<Passage> passage(Vec3 point, Vec3 position, const FieldGrid& grid) {
    const Passage passage = unlimited_passage(point, position);
    if (too_steep(passage, grid)) return {};
    return passage;
}

double modulus(const ScenePoint& point, const Passage& passage);  ///< of the point's wave along the ray

/// Tests by rays whether a distant viewer sees points of a scene.
class Visibility {
  public:
    explicit Visibility(const ShadedScene& scene);
    /// Returns whether no surface lies between the point and a distant viewer in that direction.
    bool is_visible(Vec3 point, Vec3 direction) const { return !caster_.occluded(point, direction, margin_, far_); }
    /// As is_visible() for an array of directions: sets hidden[i] if the point is not visible in direction i.
    void hide(Vec3 point, std::span<const Vec3> directions, std::span<bool> hidden) const {
        caster_.occluded(point, directions, margin_, far_, hidden);
    }
    const trace::RayCaster& caster() const { return caster_; }

  private:
    trace::RayCaster caster_;
    double margin_ = 0, far_ = 0;
};

inline constexpr std::size_t tile_side = 32;  ///< of sum_over_tiles(), samples

/// Computes a field tile by tile on all threads; add(region, values of the region) fills a tile.
Field sum_over_tiles(const FieldGrid& grid, const Progress& progress,
                     const std::function<void(const Region&, View<std::complex<float>, 2>)>& add);

/// Computes a field sample by sample on all threads; wave(position) returns its value at a position on the hologram.
Field sum_over_samples(const FieldGrid& grid, const Progress& progress,
                       const std::function<std::complex<double>(Vec3 position)>& wave);

// The methods that scene_hologram_methods() lists by name.
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
