// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "hogel/scene.h"

namespace hogel::scene {

/// Surface over the pixels of a grid. Pixel (x, y) is the element y · width + x; row 0 is at the top.
struct Relief {
    std::size_t width = 0, height = 0;
    std::vector<float> nearness;   ///< 0: farthest, 1: nearest
    std::vector<char> is_present;  ///< pixels with a surface; empty: all
    std::vector<Rgb> colors;       ///< radiances; empty: those of a texture over the whole grid
};

/// Difference of nearness above which neighbouring pixels belong to different surfaces. In the default depth range,
/// seen 8 degrees from the axis, a step of this height opens by 1/600 of the picture's width. 8-bit maps have steps of
/// 1/255, and gently sloped surfaces must not be cut.
constexpr float edge_step = 0.05f;

/// Returns the surface as a mesh with x from −1/2 to 1/2, y upwards in the same unit about 0, and z the nearness. Each
/// pixel is two triangles. Corners are shared with the neighbours within `edge_step`, at their mean nearness.
Mesh relief_mesh(const Relief& relief, double height);

/// Returns the continuation of farther surfaces behind the edges of nearer ones. It begins at the last pixel of the
/// farther surface, and extends by 1/12 of the grid's width times the step of nearness. Its colours come from the
/// farther surface.
/// @param picture  stretched over the grid
Relief continuation_behind_edges(const Relief& front, const Image& picture);

/// Returns whether import_scene() reads a file as a picture, by its extension.
bool is_picture(const std::filesystem::path& path);

/// Returns whether import_scene() reads a file as layers, by its extension.
bool is_layers(const std::filesystem::path& path);

/// Implements import_scene() for pictures, layers and mesh files.
Scene import_picture(const std::filesystem::path& path, const ImportOptions& options);
Scene import_layers(const std::filesystem::path& path);
Scene import_mesh(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace hogel::scene
