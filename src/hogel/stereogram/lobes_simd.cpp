// SPDX-License-Identifier: Apache-2.0
// Vector versions of lobes.h, compiled for every SIMD target. The first call selects the target.
#include <algorithm>

#include "hogel/core/simd_targets-inl.h"
#include "hogel/math/transpose-inl.h"
#include "hogel/stereogram/lobes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::stereogram::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET != HWY_SCALAR
using math::HWY_NAMESPACE::transpose_four;
using math::HWY_NAMESPACE::transpose_sixteen;
#endif

// Returns the mean over one lobe for a vector of hogels; `across` and `down` are its numbers of directions.
template <class D>
HWY_INLINE hn::Vec<D> Mean(D d, std::uint32_t across, std::uint32_t down, const float* u, const float* v,
                           const float* rays, std::size_t row) {
    const auto line = [&](const float* from) {
        auto sum = hn::Mul(hn::Set(d, u[0]), hn::LoadU(d, from));
        for (std::uint32_t k = 1; k < across; ++k)
            sum = hn::MulAdd(hn::Set(d, u[k]), hn::LoadU(d, from + k * hogels_at_once), sum);
        return sum;
    };
    auto sum = hn::Mul(hn::Set(d, v[0]), line(rays));
    for (std::uint32_t l = 1; l < down; ++l) sum = hn::MulAdd(hn::Set(d, v[l]), line(rays + l * row), sum);
    return sum;
}

// Averages lobes with equal numbers of directions, a compile-time constant if small; 0: any numbers.
template <std::uint32_t side>
void LobeAverage(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                 std::size_t row_length, bool of_roots, float* out) {
    const hn::CappedTag<float, hogels_at_once> d;
    const std::size_t row = row_length * hogels_at_once;
    for (const FrequencyGrid::Lobe& lobe : lobes) {
        const std::uint32_t across = side > 0 ? side : lobe.nu, down = side > 0 ? side : lobe.nv;
        const float *u = weights + lobe.weights, *v = u + across;
        const float* first = rays + lobe.v0 * row + lobe.u0 * hogels_at_once;
        const auto scale = hn::Set(d, lobe.scale);
        for (std::size_t i = 0; i < hogels_at_once; i += hn::Lanes(d)) {
            const auto sum = Mean(d, across, down, u, v, first + i, row);
            hn::StoreU(of_roots ? hn::Mul(sum, hn::Sqrt(scale)) : hn::Sqrt(hn::Mul(hn::Max(sum, hn::Zero(d)), scale)),
                       d, out + i);
        }
        out += hogels_at_once;
    }
}

void AverageLobes(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                  std::size_t row_length, bool of_roots, float* out) {
    const std::uint32_t side = lobes.empty() ? 0 : lobes.front().nu;
    const bool square =
        std::ranges::all_of(lobes, [&](const auto& lobe) { return lobe.nu == side && lobe.nv == side; });
    const auto average = !square     ? LobeAverage<0>
                         : side == 1 ? LobeAverage<1>
                         : side == 2 ? LobeAverage<2>
                         : side == 3 ? LobeAverage<3>
                         : side == 4 ? LobeAverage<4>
                                     : LobeAverage<0>;
    average(lobes, weights, rays, row_length, of_roots, out);
}

void Transpose(const float* from, std::size_t from_stride, std::size_t rows, std::size_t columns, float* to,
               std::size_t to_stride) {
#if HWY_TARGET == HWY_SCALAR
    transpose_plain(from, from_stride, rows, columns, to, to_stride);
#else
    const auto four = [&](const float* in, float* out) {
        transpose_four(in, in + from_stride, in + 2 * from_stride, in + 3 * from_stride, out, out + to_stride,
                       out + 2 * to_stride, out + 3 * to_stride);
    };
    // In squares of sixteen, along the array with the larger row stride, which completes its cache lines at once: at
    // strides of powers of two they would be evicted before reuse.
    const std::size_t whole_rows = rows / 4 * 4, whole_columns = columns / 4 * 4;
    for (std::size_t row = 0; row < whole_rows; row += 16)
        for (std::size_t column = 0; column < whole_columns; column += 16) {
            const std::size_t end_row = std::min(row + 16, whole_rows), end = std::min(column + 16, whole_columns);
            if (end_row == row + 16 && end == column + 16) {
                transpose_sixteen([&](std::size_t i) { return from + (row + i) * from_stride + column; }, 16,
                                  [&](std::size_t j) { return to + (column + j) * to_stride + row; });
                continue;
            }
            if (from_stride >= to_stride) {
                for (std::size_t r = row; r < end_row; r += 4)
                    for (std::size_t c = column; c < end; c += 4)
                        four(from + r * from_stride + c, to + c * to_stride + r);
            } else {
                for (std::size_t c = column; c < end; c += 4)
                    for (std::size_t r = row; r < end_row; r += 4)
                        four(from + r * from_stride + c, to + c * to_stride + r);
            }
        }
    transpose_plain(from + whole_columns, from_stride, whole_rows, columns - whole_columns,
                    to + whole_columns * to_stride, to_stride);
    transpose_plain(from + whole_rows * from_stride, from_stride, rows - whole_rows, columns, to + whole_rows,
                    to_stride);
#endif
}

}  // namespace hogel::stereogram::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::stereogram {
HOGEL_DISPATCH(average_lobes, AverageLobes);
HOGEL_DISPATCH(transpose, Transpose);
}  // namespace hogel::stereogram
