// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace hogel::io::arrays {

/// Largest accepted ratio of decompressed to compressed size: deflated data expand at most 1032-fold.
constexpr std::size_t max_expansion = 1040;

/// Part of the data that inflate() produces.
enum class Extent {
    first,  ///< the beginning; more may follow, and the final checksum is not checked
    all,    ///< everything; the checksum must be right
};

/// Decompresses zlib's format (RFC 1950) into `plain`. Extent::first fills `plain` with the beginning of the data;
/// Extent::all requires data of exactly plain.size() bytes with the right checksum. Returns false for other or damaged
/// data. Throws Error(not_built_in), naming `path`, in a build without zlib, and Error(cancelled) for Extent::all.
bool inflate(const std::filesystem::path& path, std::span<const unsigned char> packed, std::span<unsigned char> plain,
             Extent extent);

/// As inflate() with Extent::all, for raw deflated data (RFC 1951) without a checksum, as in ZIP files.
bool inflate_bare(const std::filesystem::path& path, std::span<const unsigned char> packed,
                  std::span<unsigned char> plain);

}  // namespace hogel::io::arrays
