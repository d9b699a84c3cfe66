// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/speckle_free/kernels.h"

namespace hogel::camera::speckle_free {

void sum_powers_plain(const PsfBasis& basis, const PsfBasis::Weights& columns, const PsfBasis::Weights& rows,
                      const float* powers, float* out) {
    const std::size_t n = basis.samples(), count = basis.count(), padded = basis.padded_count();
    for (std::size_t i = 0; i < count * padded; ++i) out[i] = 0;
    for (std::size_t row = 0; row < n; ++row)
        for (std::size_t column = 0; column < n; ++column) {
            constexpr std::size_t lanes = PsfBasis::lanes;
            const float power = powers[(row / lanes * n + column) * lanes + row % lanes];
            for (std::size_t x = 0; x < count; ++x)
                for (std::size_t y = 0; y < padded; ++y)
                    out[x * padded + y] +=
                        columns.first[column * columns.stride + x] * rows.first[row * rows.stride + y] * power;
        }
}

void sum_products_plain(const Lines& lines, float* sums) {
    for (const float* a : lines.a)
        for (const float* b : lines.b) {
            float sum = 0;
            for (std::size_t row = 0; row < lines.rows; ++row)
                for (std::size_t i = 0; i < lines.length; ++i)
                    sum += a[row * lines.a_row + i] * b[row * lines.b_row + i];
            *sums++ = sum;
        }
}

void multiply_plain(View<const float, 2> weights, View<const float, 2> in, View<float, 2> out) {
    for (std::size_t i = 0; i < out.extent(0); ++i)
        for (std::size_t x = 0; x < out.extent(1); ++x) {
            float sum = 0;
            for (std::size_t j = 0; j < in.extent(0); ++j) sum += weights(i, j) * in(j, x);
            out(i, x) = sum;
        }
}

}  // namespace hogel::camera::speckle_free
