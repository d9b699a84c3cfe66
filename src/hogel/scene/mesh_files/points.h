// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// A point cloud. Vectors are empty or as long as `positions`.
struct Points {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  ///< unit length
    std::vector<Rgb> colors;    ///< linear
};

/// Reads lines of x y z, optionally followed by r g b (0 to 255, or 0 to 1 with a decimal point), intensity r g b, or
/// nx ny nz. The first line may be a count or a comment (#, //). Throws Error(bad_input), naming the line.
Points read_xyz(const std::string& file, std::string_view bytes);

/// Reads a point cloud of OpenHolo: a count, and per point a line of index, x, y, z, phase and amplitude. Phases are
/// ignored. If amplitudes differ, their square is the grey level. Throws Error(bad_input), naming the line.
Points read_dat(const std::string& file, std::string_view bytes);

/// Normalises normals; clears all if one has no direction, so that they are computed.
void normalize_or_clear(std::vector<Vec3>& normals);

/// Throws Error(bad_input): the file holds Gaussian splats.
[[noreturn]] void reject_splats(const std::string& file);

/// Returns a mesh with a disc (a hexagon) per point, perpendicular to its normal. The radius is `size` times the
/// distance of the sixth neighbour, which leaves no gaps in an evenly sampled surface. Missing normals are those of
/// planes fitted to the neighbours, oriented away from the centroid along the spanning tree of least normal difference
/// (Hoppe et al., "Surface reconstruction from unorganized points", 1992).
Mesh discs(const Points& points, double size);

}  // namespace hogel::scene::mesh_files
