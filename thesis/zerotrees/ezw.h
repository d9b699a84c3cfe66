// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "thesis/wavelets/pyramid.h"

namespace hogel::zerotrees {

/// Limits at which encoding stops; by default after the last bit plane.
struct EzwLimit {
    std::size_t bytes = std::numeric_limits<std::size_t>::max();  ///< maximum length of the stream
    std::optional<double> sqnr;                                   ///< SQNR of the coefficients, decibels
};

/// Shapiro's embedded zerotree coder ([K] 4.4.2, fig. 4.16), for the coefficients of a wavelet transform in the layout
/// of `pyramid`, row-major.
///
/// For thresholds T = T_max/2, T_max/4, … from the roots to the leaves, each coefficient not yet found gives POS or NEG
/// if its magnitude is above T, ZT if no magnitude in its subtree is, otherwise IZ; below a ZT there are no symbols. A
/// second pass then halves the interval of each found coefficient. All symbols are arithmetic-coded with the
/// significance of the parent and of the previous coefficient of the pass as context. Differs from Shapiro as [K] does:
/// a subtree is not a zerotree if it has a coefficient above T from an earlier pass; Shapiro sets such coefficients to
/// zero first. There is no END symbol; the code ends with its bytes.
///
/// Stream: T_max as a float32, little-endian; the arithmetic code. Any prefix decodes to a valid coarser result. There
/// are 30 thresholds: magnitudes below 2⁻³⁰ T_max are zeros.
///
/// Throws Error(usage) if a value is not finite, if their number differs from the pyramid's, or if sqnr is not
/// positive. Cost: a scan of all coefficients for each threshold, nine bytes of memory per coefficient.
std::vector<std::uint8_t> ezw_encode(const wavelets::Pyramid& pyramid, std::span<const float> values,
                                     const EzwLimit& limit = {});

/// Decodes a stream or a prefix of one, even an empty one; each coefficient gets the middle of its interval. Throws
/// Error(bad_input) only if the stream's T_max is not a magnitude; damaged bytes give other values.
void ezw_decode(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values);

}  // namespace hogel::zerotrees
