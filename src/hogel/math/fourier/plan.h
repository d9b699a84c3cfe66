// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hogel/array.h"

// hogel's own Fourier transforms, forward sums with e^{-2πi jm/n}. Backward transforms are forward ones of numbers
// whose real and imaginary parts are exchanged, and so are their results.
namespace hogel::math::fourier {

/// The number of lines that are transformed side by side. In the split layout, [position][part][line], this number of
/// real parts is followed by as many imaginary parts.
constexpr std::size_t together = 16;
/// Floats from one position to the next in the split layout.
constexpr std::size_t split_row = 2 * together;

/// The largest prime factor of lengths that are transformed without a convolution.
constexpr std::size_t max_radix = 13;
bool is_smooth(std::size_t length);
/// The smallest length from n on whose transform as a part of a convolution is fast.
std::size_t convolution_length(std::size_t n);

/// e^{-2πi numerator/denominator}, rounded from double precision.
std::complex<float> root_of_unity(std::size_t numerator, std::size_t denominator);

/// A transform of one smooth length by decimation in frequency, in place: a pass of radix r and group length L replaces
/// the values x_i, i < r, at distance L/r in each group by the values Σ_i x_i w_r^{ik}, times w_L^{jk} for the values
/// at offset j. Then the r parts of a group are transforms of their own.
struct Plan {
    struct Pass {
        std::size_t radix, length, factors;  // factors: where w_L^{jk} begin, [j][k-1][part]
    };

    explicit Plan(std::size_t length);

    std::size_t length;
    std::vector<Pass> passes;
    std::vector<float> factors;
    std::vector<std::uint32_t> frequency;  // [place after all passes]
    std::vector<std::uint32_t> place;      // [frequency]
};

/// A transform of any length as a convolution of a smooth length m ≥ 2n − 1 (Bluestein): with c_j = e^{-πi j²/n},
/// X_k = c_k Σ_j (x_j c_j) conj(c_{k−j}).
struct Chirp {
    Chirp(std::size_t length, std::size_t convolved);

    std::vector<float> chirp;  // [j][part]: c_j
    /// [frequency][part]: the transform of conj(c), over m.
    std::vector<float, CacheLineAllocator<float>> spectrum;
};

/// A long line as an array of `down` rows and `across` columns: transforms of its columns, whose frequency p is then
/// multiplied by w_n^{pb} in column b, and transforms of the rows, which give frequencies p + down·q.
struct Split {
    explicit Split(std::size_t length);

    Plan down, across;
    /// [p][b/16][part][b mod 16]
    std::vector<float, CacheLineAllocator<float>> twiddles;
    std::size_t blocks_across() const { return (across.length + together - 1) / together; }
    std::size_t blocks_down() const { return (down.length + together - 1) / together; }
};

// The functions below work on interleaved complex numbers, compiled for every SIMD target and dispatched at run time.
// `backward` exchanges the parts. Strides are in floats.

/// Whether the SIMD target in use has vectors of at least four numbers. If not, use the plain transforms.
extern bool (&has_vectors)();

/// Transforms up to `together` columns; row r of the result is at to + r·to_row.
extern void (&transform_columns)(const Plan& plan, const Chirp* chirp, bool backward, const float* from,
                                 std::size_t from_row, float* to, std::size_t to_row, std::size_t columns,
                                 std::size_t length);
/// Transforms up to `together` lines in place.
extern void (&transform_lines)(const Plan& plan, const Chirp* chirp, bool backward, float* lines, std::size_t stride,
                               std::size_t count, std::size_t length);
/// Transforms a long line; `to` may be `from`.
extern void (&transform_split)(const Split& split, bool backward, const float* from, float* to);
/// Transforms sixteen lines in split layout in place, without sorting: frequency f lies in row plan.place[f].
extern void (&transform_in_place)(const Plan& plan, float* rows);
/// x_i y_i for n complex numbers; the parts of x, or of the result, are exchanged if asked for.
extern void (&multiply)(const float* x, const float* y, float* out, std::size_t n, bool exchange_x, bool exchange_out);

}  // namespace hogel::math::fourier
