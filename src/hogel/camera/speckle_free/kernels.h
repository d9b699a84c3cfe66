// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "hogel/array.h"
#include "hogel/camera/speckle_free/psf_basis.h"

namespace hogel::camera::speckle_free {

/// The inner loops of the mean of infinitely many looks. Plain and fast twins agree to rounding.

/// out[q_x][q_y] = Σ columns(m_x, q_x) rows(m_y, q_y) powers(m_y, m_x), for q_x below basis.count() and q_y below
/// basis.padded_count(): by how much the spots of few waves stand for those of all waves of a hogel.
/// @param powers  as WavePowers::read() gives them
/// @param out     aligned to a cache line
void sum_powers_plain(const PsfBasis& basis, const PsfBasis::Weights& columns, const PsfBasis::Weights& rows,
                      const float* powers, float* out);
extern decltype(sum_powers_plain)& sum_powers;

/// Arrays of the same shape in memory, `rows` of `length` numbers, with the distances from row to row.
struct Lines {
    std::span<const float*const> a, b;
    std::size_t a_row, b_row;
    std::size_t rows, length;
};
/// How many arrays b are multiplied at once, and sums computed, so that each number is read once for several of them.
inline constexpr std::size_t max_b_per_pass = 3, max_sums_per_pass = 12;
/// How many arrays a are multiplied at once with so many arrays b.
constexpr std::size_t max_a_per_pass(std::size_t b) { return b == 1 ? 8 : max_sums_per_pass / b; }
/// sums[i · b.size() + j] = Σ a[i] b[j], for at most max_b_per_pass arrays b and max_a_per_pass(b.size()) arrays a.
void sum_products_plain(const Lines& lines, float* sums);
void sum_products(const Lines& lines, float* sums);
/// Σ a b of two arrays.
inline float sum_products(const float* a, const float* b, std::size_t length) {
    float sum = 0;
    sum_products({{&a, 1}, {&b, 1}, 0, 0, 1, length}, &sum);
    return sum;
}

/// out(i, x) = Σ_j weights(i, j) in(j, x), for all rows j of `in`. The rows of in and out have the same length, a
/// multiple of PsfBasis::lanes.
void multiply_plain(View<const float, 2> weights, View<const float, 2> in, View<float, 2> out);
extern decltype(multiply_plain)& multiply;

}  // namespace hogel::camera::speckle_free
