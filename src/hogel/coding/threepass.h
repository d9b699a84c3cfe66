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
/// b_max = log2(T / T_min)), p_n = ⌊log2(T / |x|)⌋ says in which pass of EZW a coefficient x would be found, and p_t is
/// the least p_n in its subtree. From the roots to the leaves each coefficient gives
///   Δp_t = p_t − p_t(parent), or −1 when p_t >= b_max: a zerotree, of which nothing more is said;
///   Δp_n = p_n − p_t, or −1 when p_n >= b_max: an isolated zero; not for leaves, where it is 0;
///   its sign, and the b_max − p_n − 1 bits of its level below the leading one.
/// Differs: here T may be any number from the largest magnitude up to twice of it, so that the step and not its power
/// of two is free; symbols are told to the arithmetic coder bit by bit, in unary, as a bit is learnt faster than an
/// alphabet: those of Δp_t apart for each p_t(parent), leaves or not, and by what the two coefficients before were, and
/// those of Δp_n for each p_t. In place of an alphabet for each that takes a sixth off the size.
///
/// Stream: the step as a float32, little-endian; b_max, one byte; the arithmetic code.
///
/// Throws Error(usage) when a value is not finite, their number is not the pyramid's, or the step is not positive or is
/// less than 2⁻³⁰ of the largest magnitude. Cost: O(size), two bytes of memory a coefficient.
std::vector<std::uint8_t> three_pass_encode(const transform::Pyramid& pyramid, std::span<const float> values,
                                            double step);

/// Throws Error(bad_input) when the bytes are not a whole stream; every truncated one is found out. Bytes that were
/// changed may give other values, as only a checksum around the stream can tell.
void three_pass_decode(const transform::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values);

/// Makes of values what three_pass_decode() makes of their stream, which is looked at for its step alone: much sooner.
void three_pass_round(std::span<const std::uint8_t> bytes, std::span<float> values);

/// The step for a size, by [K]'s histogram rule Σ_{p < b_max} h(p) (b_max − p + c) = bits, made continuous in the step.
/// c is the overhead of the tree for each significant coefficient; with the default the size comes out within some 20%
/// for smooth values, from 0.05 to 4 bits each. One pass over the values.
double three_pass_step(std::span<const float> values, double bits, double c = 4.8);

/// Encodes in `bits` or up to 2% less where that is possible, by correcting the rule's step with what it gave: a few
/// times the cost of three_pass_encode. Fewer bits than the shortest stream has throw Error(usage).
std::vector<std::uint8_t> three_pass_encode_to_bits(const transform::Pyramid& pyramid, std::span<const float> values,
                                                    double bits);

}  // namespace hogel::coding
