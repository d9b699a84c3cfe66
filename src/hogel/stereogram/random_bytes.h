// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "hogel/stereogram/random_phase.h"

namespace hogel::stereogram {

/// Writes the bytes of Philox draws first_draw, first_draw + 1, … of a series: sixteen per draw, lowest byte of each
/// word first. The plain and the fast version (many draws at once) give the same bytes.
void random_bytes_plain(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes);
extern decltype(random_bytes_plain)& random_bytes;

}  // namespace hogel::stereogram
