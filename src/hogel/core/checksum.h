// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace hogel::core {

/// CRC-32 as in PNG and zlib (ISO 3309, polynomial 0xEDB88320).
std::uint32_t checksum(std::span<const std::uint8_t> bytes);

}  // namespace hogel::core
