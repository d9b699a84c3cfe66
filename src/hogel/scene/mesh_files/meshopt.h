// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/scene/mesh_files/gltf.h"

namespace hogel::scene::mesh_files {

/// What EXT_meshopt_compression packs into one buffer view.
struct PackedView {
    enum class Mode { attributes, triangles, indices };
    enum class Filter { none, octahedral, quaternion, exponential };
    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
    std::uint64_t count = 0;   ///< of elements
    std::uint64_t stride = 0;  ///< bytes of an element, as the mode and the filter allow
    std::string_view packed;

    std::uint64_t bytes() const { return count * stride; }
};

/// Decodes a view by libmeshoptimizer. Returns false if the stream is damaged. Called in a child process.
/// @param to  of view.bytes() bytes
bool unpack(const PackedView& view, std::vector<unsigned char>& to);

/// Replaces each buffer view with EXT_meshopt_compression by one of what is packed there, in a buffer of its own.
/// Throws Error(bad_input) for streams and numbers that are not as the extension has them, and Error(not_built_in)
/// where the build lacks the decoder and the file holds nothing in place of what is packed.
void unpack_views(Gltf& gltf);

}  // namespace hogel::scene::mesh_files
