// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/companding.h"
#include "hogel/compress.h"

namespace hogel::codec::format {

// As in PNG, the magic number is not text and is damaged by programs that convert line ends.
constexpr std::array<std::uint8_t, 8> stream_magic{0x89, 'H', 'G', 'L', '\r', '\n', 0x1A, '\n'};

// Filler is a metadata entry; its name and lengths take min_filler bytes.
constexpr std::size_t min_filler = 14, max_filler = std::size_t{1} << 23;

// Version of the format that is written and read (docs/format.md).
constexpr std::uint32_t stream_version = 1;

// Header as used by encoder and decoder: StreamInfo plus the companding.
struct StreamHeader : StreamInfo {
    Companding companding;
};

// Returns the first bytes of a stream: magic, version, length of the fields, fields, and a checksum. Writes the
// companding, but not its facts in StreamInfo.
std::vector<std::uint8_t> header_bytes(const StreamHeader& header);

// Reads the fields. Throws Error(bad_input).
StreamHeader read_header_fields(ByteReader& reader);

}  // namespace hogel::codec::format
