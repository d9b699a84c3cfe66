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

/// A picture that a material library names, with what its options say.
struct MtlTexture {
    std::string name;    ///< empty: none
    bool clamp = false;  ///< -clamp on
    /// -s and -o: u' = scale u + offset.
    std::array<double, 2> scale{1, 1}, offset{0, 0};

    bool is_moved() const { return scale != MtlTexture().scale || offset != MtlTexture().offset; }
};

/// A material of a Wavefront material library (.mtl), as far as assimp 5.2 does not read it or misreads it.
struct MtlMaterial {
    std::string name;
    std::optional<double> dissolve;           ///< d: the opacity
    std::optional<double> transparency;       ///< Tr: 1 − opacity
    std::optional<Rgb> emission;              ///< Ke
    MtlTexture color, opacity, emission_map;  ///< map_Kd, map_d, map_Ke
    std::set<std::string> left_out;           ///< what else it says, in words for a note

    /// d before Tr; between 0 and 1.
    double alpha() const;
};

/// What cannot be parsed is passed over, as assimp does.
std::vector<MtlMaterial> parse_mtl(std::string_view text);

/// What of the materials is left out, and of how many of them; a note each.
std::vector<std::string> notes_of(const std::vector<MtlMaterial>& materials);

/// What an OBJ file says that is not shown: curves and free-form surfaces, and material libraries that are missing.
/// @param folder  of the file, canonical
std::vector<std::string> notes_of_obj(std::string_view text, const std::filesystem::path& folder);

}  // namespace hogel::scene::mesh_files
