// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/optics/expected/spot_basis.h"

namespace hogel::optics::expected {

/// The inner loops of the mean of infinitely many looks. Plain and fast twins agree to rounding.

/// out[q_x][q_y] = Σ columns(m_x, q_x) rows(m_y, q_y) powers(m_y, m_x), for q_x below basis.count() and q_y below
/// basis.padded_count(): by how much the spots of few waves stand for those of all waves of a hogel.
/// @param powers  as EyeLight::powers() gives them
/// @param out     aligned to a cache line
void sum_powers_plain(const SpotBasis& basis, const SpotBasis::Weights& columns, const SpotBasis::Weights& rows,
                      const float* powers, float* out);
void sum_powers(const SpotBasis& basis, const SpotBasis::Weights& columns, const SpotBasis::Weights& rows,
                const float* powers, float* out);

/// Two arrays of the same shape in memory, `rows` of `length` numbers, with the distances from row to row.
struct Lines {
    const float *a, *b;
    std::size_t a_row, b_row;
    std::size_t rows, length;
};
/// Σ a b.
float sum_products_plain(const Lines& lines);
float sum_products(const Lines& lines);

}  // namespace hogel::optics::expected
