// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/scene/mesh_files/gltf.h"

namespace hogel::scene::mesh_files {

/// A primitive compressed by KHR_draco_mesh_compression.
struct DracoMesh {
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

/// Decodes a stream by libdraco into the bytes of each attribute, followed by those of the indices. Returns nothing if
/// the stream is damaged or its numbers of elements differ. Called in a child process.
std::optional<std::vector<std::string>> decode(const DracoMesh& mesh);

/// Decodes KHR_draco_mesh_compression into new buffers for accessors without data. Throws Error(bad_input) for
/// violations of the extension, and Error(not_built_in) in a build without the decoder.
void unpack_draco(Gltf& gltf);

}  // namespace hogel::scene::mesh_files
