// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/codec/format/bytes.h"
#include "hogel/compress.h"

namespace hogel::codec::format {

// As in PNG: not text, and damaged by what damages line ends.
constexpr std::array<std::uint8_t, 8> stream_magic{0x89, 'H', 'G', 'L', '\r', '\n', 0x1A, '\n'};

// What fills up a stream is a word of its metadata, whose name and lengths take so many bytes.
constexpr std::size_t min_filler = 14, max_filler = std::size_t{1} << 23;

// What a stream begins with: magic, version, the length of the fields, the fields and a checksum.
std::vector<std::uint8_t> header_of(const StreamInfo& info);

// The fields alone. Throws Error(bad_input).
StreamInfo read_header_fields(ByteReader& reader, std::uint32_t version);

}  // namespace hogel::codec::format
