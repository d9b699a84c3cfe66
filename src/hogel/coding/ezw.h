// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "hogel/transform/pyramid.h"

namespace hogel::coding {

/// When an embedded stream is long enough; by default when every bit plane is in it.
struct EzwLimit {
    std::size_t bytes = std::numeric_limits<std::size_t>::max();  ///< exactly so many, if there is so much to say
    std::optional<double> sqnr;                                   ///< of the coefficients, in decibels
};

/// Shapiro's embedded zerotree coder ([K] 4.4.2, fig. 4.16), for the coefficients of a wavelet transform in the layout
/// of `pyramid`, row-major.
///
/// For thresholds T = T_max/2, T_max/4, … from the roots to the leaves, each coefficient not yet found gives POS or NEG
/// when its magnitude is above T, ZT when nothing in its subtree is, else IZ; below a ZT nothing is said. A second pass
/// then halves the interval of each coefficient found so far. Everything is arithmetic-coded, given whether the parent
/// and the previous coefficient of the pass are significant. Differs: as in [K] a subtree is not a zerotree while it
/// holds something above T found in an earlier pass; Shapiro sets those to zero first. There is no END symbol: the end
/// of the bytes is the end.
///
/// Stream: T_max as a float32, little-endian; the arithmetic code. Any prefix decodes to a valid coarser result.
/// 30 thresholds: magnitudes below 2⁻³⁰ T_max are zeros.
///
/// Throws Error(usage) when a value is not finite, their number is not the pyramid's, or sqnr is not positive.
/// Cost: a scan of all coefficients for each threshold, nine bytes of memory a coefficient.
std::vector<std::uint8_t> ezw_encode(const transform::Pyramid& pyramid, std::span<const float> values,
                                     const EzwLimit& limit = {});

/// Decodes a stream or a prefix of one, even an empty one, each coefficient to the middle of the interval that is known
/// of it. Throws Error(bad_input) only when the stream's T_max is not a magnitude; changed bytes give other values.
void ezw_decode(const transform::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values);

}  // namespace hogel::coding
