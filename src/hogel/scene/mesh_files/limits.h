// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/core/child_process.h"

namespace hogel::scene::mesh_files {

// Resource limits of reading a mesh, by the bytes of all its files. The factors are several times the needs of ordinary
// files of any format (docs/decisions/0060-mesh-files-in-a-child-process.md); the constants suffice for small files.

/// Returns the memory and time of the child process that reads the files.
inline core::ChildLimits child_limits(std::uint64_t bytes) {
    return {.memory = (std::uint64_t{512} << 20) + 128 * bytes, .cpu_seconds = 60 + static_cast<unsigned>(bytes >> 16)};
}

/// Returns the increment for a further file.
inline core::ChildLimits further_limits(std::uint64_t bytes) {
    return {.memory = 128 * bytes, .cpu_seconds = static_cast<unsigned>(bytes >> 16)};
}

/// Returns the maximum size of the resulting scene, counting every copy of a mesh.
inline std::uint64_t max_scene_bytes(std::uint64_t bytes) { return (std::uint64_t{256} << 20) + 1000 * bytes; }

}  // namespace hogel::scene::mesh_files
