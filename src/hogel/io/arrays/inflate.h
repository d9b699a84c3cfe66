// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace hogel::io::arrays {

/// Deflated data expand at most 1032-fold; with some reserve.
constexpr std::size_t max_expansion = 1040;

/// Part of the data that inflate() produces.
enum class Extent {
    first,  ///< the beginning; more may follow, and the final checksum is not checked
    all,    ///< everything; the checksum must be right
};

/// Decompresses zlib's format (RFC 1950) until `plain` is full. Returns false for damaged or too short data. Throws
/// Error(not_built_in), naming `path`, in a build without zlib.
bool inflate(const std::filesystem::path& path, std::span<const unsigned char> packed, std::span<unsigned char> plain,
             Extent extent);

/// As inflate(), for raw deflated data (RFC 1951), as in ZIP files, of exactly `plain.size()` bytes.
bool inflate_bare(const std::filesystem::path& path, std::span<const unsigned char> packed,
                  std::span<unsigned char> plain);

}  // namespace hogel::io::arrays
