// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/coding/arithmetic.h"
#include "thesis/zerotrees/jpeg4d_blocks.h"

namespace hogel::zerotrees {

// Quantisation table of a stream: [index_in_block()] an exponent e for each frequency of a full block, with a step of
// scale · 2^(e/4).
using Exponents = std::vector<std::uint8_t>;
constexpr int max_exponent = 24;

Quantisation own_quantisation(double scale, const Exponents& exponents);

// Returns the table with the least distortion + 0.12 scale² · bits, including the bits of the table.
Exponents choose_exponents(const Blocks& blocks, std::span<const float> values, double scale);

void write_exponents(coding::ArithmeticEncoder& encoder, const Blocks& blocks, const Exponents& exponents);
// Reads a table. Returns false for exponents out of range and for a code that ends too early.
bool read_exponents(coding::ArithmeticDecoder& decoder, const Blocks& blocks, Exponents& exponents);

}  // namespace hogel::zerotrees
