// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace hogel::io::arrays {

/// Data expand to at most 1032 times their deflated size; with some reserve.
constexpr std::size_t max_expansion = 1040;

/// How much of the data inflate() is to fill.
enum class Extent {
    first,  ///< more may follow, and the checksum at the end is not looked at
    all,    ///< nothing may follow, and the checksum must be right
};

/// Decompresses zlib's format (RFC 1950) until `plain` is full. Returns false for damaged data and for less than that.
/// Throws Error(not_built_in) in a build without zlib.
/// @param path  of the file, for that message
bool inflate(const std::filesystem::path& path, std::span<const unsigned char> packed, std::span<unsigned char> plain,
             Extent extent);

/// Decompresses bare deflated data (RFC 1951), as in ZIP files, to exactly `plain.size()` bytes. Otherwise as above.
bool inflate_bare(const std::filesystem::path& path, std::span<const unsigned char> packed,
                  std::span<unsigned char> plain);

}  // namespace hogel::io::arrays
