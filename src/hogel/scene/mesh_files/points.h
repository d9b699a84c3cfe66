// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// A point cloud. The lists are empty or as long as `positions`.
struct Points {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  ///< unit length
    std::vector<Rgb> colors;    ///< linear
};

/// A text of lines with x y z, and behind them r g b (0 to 255, or 0 to 1 with a decimal point), intensity r g b, or
/// nx ny nz; the first line may be a count or a comment (#, //). Throws Error(bad_input), which names the line.
Points read_xyz(const std::string& file, std::string_view bytes);

/// A point cloud of OpenHolo: a count, and a line of index, x, y, z, phase and amplitude for each point. Phases are
/// left out; points whose amplitudes differ are grey with the square of theirs. Throws Error(bad_input), which names
/// the line.
Points read_dat(const std::string& file, std::string_view bytes);

/// Makes normals unit vectors; without a direction of each, removes them all, so that they are made anew.
void normalize_or_clear(std::vector<Vec3>& normals);

/// Throws Error(bad_input): the file holds Gaussian splats.
[[noreturn]] void reject_splats(const std::string& file);

/// A mesh with a disc (a hexagon) for each point, across its normal. A disc's radius is `size` times the distance of
/// the point's sixth neighbour, with which the discs of an evenly sampled surface leave no gap. Missing normals are
/// those of the planes through the neighbours, turned away from the middle of the cloud along the spanning tree in
/// which neighbours differ least (Hoppe et al., "Surface reconstruction from unorganized points", 1992).
Mesh discs(const Points& points, double size);

}  // namespace hogel::scene::mesh_files
