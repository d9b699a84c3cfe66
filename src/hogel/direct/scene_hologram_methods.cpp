// SPDX-License-Identifier: Apache-2.0
#include "hogel/direct/scene_points.h"

namespace hogel {

using namespace direct;

Table<SceneHologramMethod>& scene_hologram_methods() {
    static Table<SceneHologramMethod> methods(
        "method from a scene to a hologram",
        {
            {"points", "spherical waves of points on all surfaces, exact, without occlusion", exact_points, true},
            {"points-visible", "spherical waves of points, with occlusion by a ray for each point and sample",
             exact_visible_points, true},
            {"points-tiled", "points with occlusion, by tiles and a table", tiled_points, true},
            {"points-hpo", "horizontal parallax only: lines of the hologram, each of its own height", horizontal_lines,
             true},
            {"edges", "points along edges, without occlusion", points_along_edges, true},
            {"segments", "edges as line segments, in closed form, without occlusion", line_sources, true},
            {"fraunhofer", "one far plane, one transform", fraunhofer_plane},
            {"fresnel", "depth planes, one transform each, without occlusion", fresnel_planes, false, true},
            {"planes", "depth planes from back to front, each hiding those behind it", occluding_planes, false, true},
            {"polygons", "tilted polygons, rotated in frequency space, without occlusion", tilted_polygons},
            {"polygons-visible", "tilted polygons from back to front, each hiding those behind it", occluding_polygons},
        });
    return methods;
}

}  // namespace hogel
