// SPDX-License-Identifier: Apache-2.0
// Replaces inflate.cpp in a build without zlib.
#include <fmt/format.h>

#include "hogel/core/part.h"
#include "hogel/io/arrays/inflate.h"

namespace hogel::io::arrays {

bool inflate(const std::filesystem::path& path, std::span<const unsigned char>, std::span<unsigned char>, Extent) {
    core::refuse_without("zlib", fmt::format("cannot read '{}', which is compressed", path.string()));
}

bool inflate_bare(const std::filesystem::path& path, std::span<const unsigned char>, std::span<unsigned char>) {
    core::refuse_without("zlib", fmt::format("cannot read '{}', which is compressed", path.string()));
}

}  // namespace hogel::io::arrays
