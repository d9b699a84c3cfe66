// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/scene/mesh_files/gltf.h"

namespace hogel::scene::mesh_files {

/// A buffer view compressed by EXT_meshopt_compression.
struct PackedView {
    enum class Mode { attributes, triangles, indices };
    enum class Filter { none, octahedral, quaternion, exponential };
    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
    std::uint64_t count = 0;   ///< of elements
    std::uint64_t stride = 0;  ///< bytes of an element, valid for the mode and the filter
    std::string_view packed;

    std::uint64_t bytes() const { return count * stride; }
};

/// Decodes into `to`, of view.bytes() bytes. Returns false for damage. Called in a child process.
bool unpack(const PackedView& view, std::vector<unsigned char>& to);

/// Decodes each view with EXT_meshopt_compression into a new buffer. Throws Error(bad_input) for violations of the
/// extension, and Error(not_built_in) if neither decoder nor uncompressed fallback exists.
void unpack_views(Gltf& gltf);

}  // namespace hogel::scene::mesh_files
