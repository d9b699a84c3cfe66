// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/core/child_process.h"

namespace hogel::scene::mesh_files {

// What reading a mesh may use, given the bytes of all files that are read for it. The factors are several times what
// ordinary files of any format need (docs/decisions/0060-mesh-files-in-a-child-process.md); the constants let small
// files be what they are.

/// Memory and time of the child process that reads the files.
inline core::ChildLimits child_limits(std::uint64_t bytes) {
    return {.memory = (std::uint64_t{512} << 20) + 128 * bytes, .cpu_seconds = 60 + static_cast<unsigned>(bytes >> 16)};
}

/// What a further file adds to them.
inline core::ChildLimits further_limits(std::uint64_t bytes) {
    return {.memory = 128 * bytes, .cpu_seconds = static_cast<unsigned>(bytes >> 16)};
}

/// What the scene may need that comes out of it, with every copy of a mesh counted.
inline std::uint64_t max_scene_bytes(std::uint64_t bytes) { return (std::uint64_t{256} << 20) + 1000 * bytes; }

}  // namespace hogel::scene::mesh_files
