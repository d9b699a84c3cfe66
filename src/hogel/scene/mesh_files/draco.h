// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/scene/mesh_files/gltf.h"

namespace hogel::scene::mesh_files {

/// What KHR_draco_mesh_compression packs of one primitive.
struct DracoMesh {
    /// The numbers of an accessor.
    struct Values {
        unsigned component_type = 0;  ///< as in glTF
        std::size_t components = 1;   ///< of an element
        std::uint64_t count = 0;      ///< of elements
        std::uint32_t id = 0;         ///< of an attribute in the stream
    };
    std::string_view packed;
    std::vector<Values> attributes;
    std::optional<Values> indices;
};

/// Decodes a stream by libdraco: the bytes of each attribute, and behind these those of the indices. Returns none for a
/// stream that is damaged or holds other numbers of elements. Called in a child process.
std::optional<std::vector<std::string>> decode(const DracoMesh& mesh);

/// Gives the accessors of each primitive with KHR_draco_mesh_compression what is packed there, in a buffer of their
/// own; accessors that have data keep them. Throws Error(bad_input) for streams and numbers that are not as the
/// extension has them, and Error(not_built_in) where the build lacks the decoder and accessors have no data.
void unpack_draco(Gltf& gltf);

}  // namespace hogel::scene::mesh_files
