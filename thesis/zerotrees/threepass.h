// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "thesis/wavelets/pyramid.h"

namespace hogel::zerotrees {

/// Coding of the symbols of a three-pass stream, named in every stream.
enum class ThreePassSymbols {
    bits,       ///< bit by bit in contexts
    alphabets,  ///< from [K]'s alphabets, one for Δp_t and one for Δp_n
};

/// The three-pass zerotree coder ([K] 4.4.2, fig. 4.17), for the coefficients of a wavelet transform in the layout of
/// `pyramid`, row-major.
///
/// T is the largest magnitude, rounded up to a power of two times the quantiser's step: step = T_min and b_max =
/// log2(T / T_min). p_n = ⌊log2(T / |x|)⌋ is the pass of EZW in which a coefficient x would be found, and p_t is the
/// least p_n in its subtree. From the roots to the leaves each coefficient has the symbols
///   Δp_t = p_t − p_t(parent), or −1 if p_t >= b_max: a zerotree, which has no further symbols;
///   Δp_n = p_n − p_t, or −1 if p_n >= b_max: an isolated zero; not for leaves, where it is 0;
///   its sign, and the b_max − p_n − 1 bits of its level below the leading one.
/// Differs from [K]: T may be any number from the largest magnitude up to twice of it, so that the step is arbitrary.
/// With ThreePassSymbols::bits symbols are coded bit by bit in unary, because models of bits adapt faster than those of
/// alphabets: Δp_t with models for each p_t(parent), for leaves and others, and for the two previous coefficients; Δp_n
/// with models for each p_t. With ThreePassSymbols::alphabets they are [K]'s: the numbers −1 to b_max − 1.
///
/// Stream: the step as a float32, little-endian; b_max, one byte, plus 128 with alphabets; the arithmetic code.
///
/// Throws Error(usage) if a value is not finite, if their number differs from the pyramid's, or if the step is not
/// positive or less than 2⁻³⁰ of the largest magnitude. Cost: O(size), two bytes of memory per coefficient.
std::vector<std::uint8_t> three_pass_encode(const wavelets::Pyramid& pyramid, std::span<const float> values,
                                            double step, ThreePassSymbols symbols = ThreePassSymbols::bits);

/// Decodes a stream. Throws Error(bad_input) if the bytes are not a complete stream; detects every truncation. Damaged
/// bytes may yield other values, so streams need a checksum.
void three_pass_decode(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values);

/// Replaces values by the result of three_pass_decode() for their stream, but reads only the step from the stream,
/// which is much faster.
void three_pass_round(std::span<const std::uint8_t> bytes, std::span<float> values);

}  // namespace hogel::zerotrees
