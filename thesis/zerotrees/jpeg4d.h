// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "thesis/wavelets/pyramid.h"

namespace hogel::zerotrees {

/// Steps of the frequencies of a block.
enum class QuantisationTable {
    jpeg,  ///< [K] fig. 4.13 and its outer product with itself, times a scale
    own,   ///< optimised for the rate and distortion of the values, and part of the stream
};

/// JPEG in up to four dimensions ([K] 4.4.1), for the coefficients of the windowed 8-point DCT (transform "dct8") along
/// the axes of the pyramid's groups, row-major.
///
/// Each block of 8 along each of these axes (shorter at the end of an axis) is divided by a quantisation table,
/// rounded, and scanned in order of rising frequency; a non-zero level after z zeros gives the tuple (z, b) with
/// b the number of bits of its magnitude, then its sign and the b − 1 bits below the leading one. Longer runs of zeros
/// start with (z_max, 0), which means z_max zeros; (0, 0) means that the rest of the block is zero. The frequencies of
/// the tuples are adaptive. Differs: [K] has no tuple for the end of a block; without it the zeros at the end would
/// take most of the stream.
///
/// With JPEG's table, steps are its entries times `scale`, and values are rounded to the nearest level. With an
/// optimised table, each frequency has a step of scale · 2^(e/4), e = 0 … 24, found as in Ratnakar and Livny, "An
/// efficient algorithm for optimizing DCT quantization", IEEE Trans. Image Processing 9 (2000): e minimises distortion
/// + λ · rate of its coefficients with λ = 0.12 scale²; the rate is estimated from the tuples of such levels. Fractions
/// of 0.6 or more are rounded up, because smaller levels cost less.
///
/// Stream: the scale as a float32, little-endian; b_max, one byte, with the highest bit set if the stream has an
/// optimised table; the arithmetic code of this table, if any, then of the blocks.
///
/// Throws Error(usage) if a value is not finite, if their number differs from the pyramid's, if more than four axes are
/// transformed, or if the scale is not positive or so small that a level has more than 30 bits. Cost: O(size).
std::vector<std::uint8_t> jpeg4d_encode(const wavelets::Pyramid& pyramid, std::span<const float> values, double scale,
                                        QuantisationTable table = QuantisationTable::own);

/// Decodes a stream. Throws Error(bad_input) if the bytes are not a complete stream; detects every truncation.
void jpeg4d_decode(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values);

}  // namespace hogel::zerotrees
