// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace hogel::exchange {

/// Tiles of a quilt, as its name says: "x_qs8x6a0.75.png".
struct QuiltTiling {
    std::size_t columns = 0, rows = 0;
    double aspect = 0;  ///< width/height of a view; 0: not in the name
};

/// Parses the tiling after the last "_qs" of a name, in any case; the aspect and any suffix are optional.
std::optional<QuiltTiling> quilt_tiling(const std::filesystem::path& path);

/// Returns whether two aspects are equal but for the rounding of names.
bool is_same_aspect(double aspect, double other);

}  // namespace hogel::exchange
