// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "hogel/array.h"
#include "hogel/camera/speckle_free/psf_basis.h"

namespace hogel::camera::speckle_free {

/// Inner loops of speckle-free photographs. Plain and fast twins agree to rounding.

/// Expands the powers of all waves of a hogel in the node waves: out[q_x][q_y] = Σ columns(m_x, q_x) rows(m_y, q_y)
/// powers(m_y, m_x), for q_x below basis.count() and q_y below basis.padded_count().
/// @param powers  as WavePowers::read() gives them
/// @param out     aligned to a cache line
void sum_powers_plain(const PsfBasis& basis, const PsfBasis::Weights& columns, const PsfBasis::Weights& rows,
                      const float* powers, float* out);
extern decltype(sum_powers_plain)& sum_powers;

/// Two sets of arrays of `rows` × `length` numbers, and their row strides.
struct Lines {
    std::span<const float*const> a, b;
    std::size_t a_row, b_row;
    std::size_t rows, length;
};
/// Maximum number of arrays b and of sums per pass, so that each number is read once for several sums.
inline constexpr std::size_t max_b_per_pass = 3, max_sums_per_pass = 12;
/// Returns the maximum number of arrays a per pass with `b` arrays b.
constexpr std::size_t max_a_per_pass(std::size_t b) { return b == 1 ? 8 : max_sums_per_pass / b; }
/// Computes sums[i · b.size() + j] = Σ a[i] b[j] for at most max_b_per_pass arrays b and max_a_per_pass(b.size())
/// arrays a.
void sum_products_plain(const Lines& lines, float* sums);
void sum_products(const Lines& lines, float* sums);
inline float sum_products(const float* a, const float* b, std::size_t length) {
    float sum = 0;
    sum_products({{&a, 1}, {&b, 1}, 0, 0, 1, length}, &sum);
    return sum;
}

/// Computes out(i, x) = Σ_j weights(i, j) in(j, x). The rows of in and out have the same length, a multiple of
/// PsfBasis::lanes.
void multiply_plain(View<const float, 2> weights, View<const float, 2> in, View<float, 2> out);
extern decltype(multiply_plain)& multiply;

}  // namespace hogel::camera::speckle_free
