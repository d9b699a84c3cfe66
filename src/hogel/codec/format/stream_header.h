// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/companding.h"
#include "hogel/compress.h"

namespace hogel::codec::format {

// As in PNG: not text, and damaged by whatever converts line ends.
constexpr std::array<std::uint8_t, 8> stream_magic{0x89, 'H', 'G', 'L', '\r', '\n', 0x1A, '\n'};

// Filler is a metadata entry, whose name and lengths take min_filler bytes.
constexpr std::size_t min_filler = 14, max_filler = std::size_t{1} << 23;

// The version of the format that is written and read (docs/format.md).
constexpr std::uint32_t stream_version = 1;

// A header as encoder and decoder use it: with the companding itself beside the facts about it.
struct StreamHeader : StreamInfo {
    Companding companding;
};

// The bytes that a stream begins with: magic, version, the length of the fields, the fields and a checksum. Of the
// companding and the facts about it only the former is written.
std::vector<std::uint8_t> header_bytes(const StreamHeader& header);

// Reads the fields. Throws Error(bad_input).
StreamHeader read_header_fields(ByteReader& reader);

}  // namespace hogel::codec::format
