// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "hogel/direct/scene_points.h"
#include "hogel/error.h"

namespace hogel {

using namespace direct;

namespace {

// Restricts methods to opaque scenes: they support neither masks nor blended surfaces.
std::vector<SceneHologramMethod> of_opaque_scenes(std::vector<SceneHologramMethod> methods) {
    for (SceneHologramMethod& method : methods)
        method.make = [make = method.make, name = method.name](const ShadedScene& scene, const FieldGrid& grid,
                                                               const SceneHologramOptions& options,
                                                               const Progress& progress) {
            if (scene.layers)
                throw Error(
                    ErrorCode::usage, "method",
                    fmt::format("{} shows no masks and no surfaces that blend; expected a scene without them, or "
                                "a method that works on light fields",
                                name));
            return make(scene, grid, options, progress);
        };
    return methods;
}

}  // namespace

Table<SceneHologramMethod>& scene_hologram_methods() {
    static Table<SceneHologramMethod> methods(
        "method from a scene to a hologram",
        of_opaque_scenes({
            {"points", "spherical waves of points on all surfaces, exact, without occlusion", exact_points, true},
            {"points-visible", "spherical waves of points, with occlusion by a ray for each point and sample",
             exact_visible_points, true},
            {"points-tiled", "points with occlusion, by tiles and a table", tiled_points, true},
            {"points-hpo", "horizontal parallax only: each line of the hologram shows the points at its height",
             horizontal_lines, true},
            {"edges", "points along edges, without occlusion", points_along_edges, true},
            {"segments", "edges as line segments, in closed form, without occlusion", line_sources, true},
            {"fraunhofer", "one plane in the far field, one transform", fraunhofer_plane},
            {"fresnel", "depth planes, one transform each, without occlusion", fresnel_planes, false, true},
            {"planes", "depth planes from back to front, with occlusion", occluding_planes, false, true},
            {"polygons", "tilted polygons, rotated in frequency space, without occlusion", tilted_polygons},
            {"polygons-visible", "tilted polygons from back to front, with occlusion", occluding_polygons},
        }),
        "method");
    return methods;
}

}  // namespace hogel
