// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/transform/pyramid.h"

namespace hogel::coding {

/// The three-pass zerotree coder ([K] 4.4.2, fig. 4.17), for the coefficients of a wavelet transform in the layout of
/// `pyramid`, row-major.
///
/// With T the largest magnitude, rounded up to a power of two times the quantiser's step (so step = T_min and
/// b_max = log2(T / T_min)), p_n = ⌊log2(T / |x|)⌋ is the pass of EZW in which a coefficient x would be found, and p_t
/// is the least p_n in its subtree. From the roots to the leaves each coefficient gives
///   Δp_t = p_t − p_t(parent), or −1 if p_t >= b_max: a zerotree, which has no further symbols;
///   Δp_n = p_n − p_t, or −1 if p_n >= b_max: an isolated zero; not for leaves, where it is 0;
///   its sign, and the b_max − p_n − 1 bits of its level below the leading one.
/// Differs from [K]: T may be any number from the largest magnitude up to twice of it, so that the step is arbitrary.
/// Symbols are coded bit by bit in unary, because models of bits adapt faster than those of alphabets: Δp_t with models
/// for each p_t(parent), for leaves and others, and for the two previous coefficients; Δp_n with models for each p_t.
/// That is a sixth smaller than alphabets.
///
/// Stream: the step as a float32, little-endian; b_max, one byte; the arithmetic code.
///
/// Throws Error(usage) if a value is not finite, their number is not the pyramid's, or the step is not positive or is
/// less than 2⁻³⁰ of the largest magnitude. Cost: O(size), two bytes of memory per coefficient.
std::vector<std::uint8_t> three_pass_encode(const transform::Pyramid& pyramid, std::span<const float> values,
                                            double step);

/// Throws Error(bad_input) if the bytes are not a complete stream; every truncation is noticed. Damaged bytes may give
/// other values, so streams need a checksum.
void three_pass_decode(const transform::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values);

/// Replaces values by those that three_pass_decode() would restore from their stream. It reads only the step from the
/// stream and is much faster.
void three_pass_round(std::span<const std::uint8_t> bytes, std::span<float> values);

/// The step for a size by [K]'s histogram rule Σ_{p < b_max} h(p) (b_max − p + c) = bits, which is continuous in the
/// step. c is the overhead of the trees per significant coefficient; with the default the size is within about 20% for
/// smooth values and 0.05 to 4 bits per value. One pass over the values.
double three_pass_step(std::span<const float> values, double bits, double c = 4.8);

/// Encodes in `bits`, or up to 2% less if that is possible, by correcting the step of the rule. Cost: a few times that
/// of three_pass_encode(). Throws Error(usage) for fewer bits than the shortest stream has.
std::vector<std::uint8_t> three_pass_encode_to_bits(const transform::Pyramid& pyramid, std::span<const float> values,
                                                    double bits);

}  // namespace hogel::coding
