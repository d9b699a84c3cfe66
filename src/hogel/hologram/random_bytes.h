// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "hogel/hologram/random_phase.h"

namespace hogel::hologram {

/// The bytes of Philox's draws number first_draw, first_draw + 1, … of a series, sixteen a draw, each word's lowest
/// byte first; plain, and with many draws at once. The twins give the same bytes.
void random_bytes_plain(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes);
void random_bytes(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes);

}  // namespace hogel::hologram
