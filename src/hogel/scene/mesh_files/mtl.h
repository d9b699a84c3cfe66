// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/geometry.h"

namespace hogel::scene::mesh_files {

/// A picture of a material library with its options.
struct MtlTexture {
    std::string name;    ///< empty: none
    bool clamp = false;  ///< -clamp on
    /// -s and -o: u' = scale u + offset.
    std::array<double, 2> scale{1, 1}, offset{0, 0};

    bool is_moved() const { return scale != MtlTexture().scale || offset != MtlTexture().offset; }
};

/// Statements of a material in a Wavefront library (.mtl) that assimp 5.2 does not read or misreads.
struct MtlMaterial {
    std::string name;
    std::optional<double> dissolve;           ///< d: the opacity
    std::optional<double> transparency;       ///< Tr: 1 − opacity
    std::optional<Rgb> emission;              ///< Ke
    MtlTexture color, opacity, emission_map;  ///< map_Kd, map_d, map_Ke
    std::set<std::string> left_out;           ///< unsupported statements, in words for a note

    /// Returns the opacity, 0 to 1; d takes precedence over Tr.
    double alpha() const;
};

/// Parses a library. Skips invalid statements, as assimp does.
std::vector<MtlMaterial> parse_mtl(std::string_view text);

/// Returns a note for each unsupported feature of the materials, with the number of materials.
std::vector<std::string> notes_of(const std::vector<MtlMaterial>& materials);

/// Returns notes: free-form curves and surfaces, libraries that are missing in `folder` (canonical).
std::vector<std::string> notes_of_obj(std::string_view text, const std::filesystem::path& folder);

}  // namespace hogel::scene::mesh_files
