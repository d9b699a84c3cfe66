// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "thesis/wavelets/pyramid.h"

namespace hogel::zerotrees {

/// The steps of the frequencies of a block.
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
/// give (z_max, 0) first, which stands for z_max zeros, and (0, 0) means that the rest of the block is zero. The
/// frequencies of the tuples are adaptive. Differs: [K] has no tuple for the end of a block; without one the zeros at
/// its end would cost most of the stream.
///
/// With JPEG's table, steps are its entries times `scale`, and values are rounded to the nearest level. With a table of
/// its own, each frequency has a step of scale · 2^(e/4), e = 0 … 24, found as in Ratnakar and Livny, "An efficient
/// algorithm for optimizing DCT quantization", IEEE Trans. Image Processing 9 (2000): e minimises distortion + λ · rate
/// of its coefficients with λ = 0.12 scale², the rate estimated from the tuples of such levels. Levels are rounded up
/// from 0.6 on, because smaller levels cost less.
///
/// Stream: the scale as a float32, little-endian; b_max, one byte, its highest bit set if the stream has a table of its
/// own; the arithmetic code, first of such a table, then of the blocks.
///
/// Throws Error(usage) if a value is not finite, their number is not the pyramid's, more than four axes are
/// transformed, or the scale is not positive or so small that a level has more than 30 bits. Cost: O(size).
std::vector<std::uint8_t> jpeg4d_encode(const wavelets::Pyramid& pyramid, std::span<const float> values, double scale,
                                        QuantisationTable table = QuantisationTable::own);

/// Throws Error(bad_input) if the bytes are not a complete stream; every truncation is noticed.
void jpeg4d_decode(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values);

}  // namespace hogel::zerotrees
