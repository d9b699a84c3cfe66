// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hogel/array.h"

// hogel's own Fourier transforms. Forward sums with e^{-2πi jm/n}. Backward transforms exchange the real and imaginary
// parts of inputs and outputs of forward transforms.
namespace hogel::math::fourier {

/// Number of lines in a batch. In the split layout [position][part][line] real parts precede imaginary parts.
constexpr std::size_t batch_lines = 16;
/// Number of floats between positions in the split layout.
constexpr std::size_t split_row = 2 * batch_lines;

/// Largest prime factor of lengths that are transformed without a convolution.
constexpr std::size_t max_radix = 13;
bool is_smooth(std::size_t length);
/// Returns the smallest length not below n that is fast for convolutions.
std::size_t convolution_length(std::size_t n);

/// Returns e^{-2πi numerator/denominator}, rounded from double precision.
std::complex<float> root_of_unity(std::size_t numerator, std::size_t denominator);

/// In-place transform of a smooth length by decimation in frequency. A pass of radix r and group length L replaces
/// values x_i, i < r, at distance L/r in each group by Σ_i x_i w_r^{ik}, times w_L^{jk} at offset j. The r parts of a
/// group are then transformed independently.
struct Plan {
    struct Pass {
        std::size_t radix, length, factors;  // factors: offset of w_L^{jk} as [j][k-1][part]
    };

    explicit Plan(std::size_t length);

    std::size_t length;
    std::vector<Pass> passes;
    std::vector<float> factors;
    std::vector<std::uint32_t> frequency;  // [position after all passes]
    std::vector<std::uint32_t> position;   // [frequency]
};

/// Transform of any length n as a convolution of a smooth length m ≥ 2n − 1 (Bluestein), with c_j = e^{-πi j²/n}:
/// X_k = c_k Σ_j (x_j c_j) conj(c_{k−j}).
struct Chirp {
    Chirp(std::size_t length, std::size_t convolved);

    std::vector<float> chirp;  // [j][part]: c_j
    /// [frequency][part]: transform of conj(c), over m.
    std::vector<float, CacheLineAllocator<float>> spectrum;
};

/// Transform of a long line as an array of `down` rows and `across` columns: transforms the columns, multiplies
/// frequency p of column b by w_n^{pb}, and transforms the rows, which gives frequencies p + down·q.
struct Split {
    explicit Split(std::size_t length);

    Plan down, across;
    /// [p][b/16][part][b mod 16]
    std::vector<float, CacheLineAllocator<float>> twiddles;
    std::size_t blocks_across() const { return (across.length + batch_lines - 1) / batch_lines; }
    std::size_t blocks_down() const { return (down.length + batch_lines - 1) / batch_lines; }
};

// The functions below process interleaved complex numbers. They are compiled for every SIMD target and dispatched at
// run time. `backward` exchanges real and imaginary parts. Strides are in floats.

/// Returns whether the SIMD target in use has vectors of at least four numbers. If not, use the plain transforms.
extern bool (&has_vectors)();

/// Transforms up to `batch_lines` columns. Writes row r of the result at to + r·to_row.
extern void (&transform_columns)(const Plan& plan, const Chirp* chirp, bool backward, const float* from,
                                 std::size_t from_row, float* to, std::size_t to_row, std::size_t columns,
                                 std::size_t length);
/// Transforms up to `batch_lines` lines in place.
extern void (&transform_lines)(const Plan& plan, const Chirp* chirp, bool backward, float* lines, std::size_t stride,
                               std::size_t count, std::size_t length);
/// Transforms a long line. `to` may equal `from`.
extern void (&transform_split)(const Split& split, bool backward, const float* from, float* to);
/// Transforms sixteen lines in split layout in place, without reordering: frequency f is in row plan.position[f].
extern void (&transform_in_place)(const Plan& plan, float* rows);
/// Multiplies n complex numbers, out_i = x_i y_i. Optionally exchanges real and imaginary parts of x, or of the result.
extern void (&multiply)(const float* x, const float* y, float* out, std::size_t n, bool exchange_x, bool exchange_out);

}  // namespace hogel::math::fourier
