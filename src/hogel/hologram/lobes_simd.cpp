// The vector twins of average_lobes_plain and transpose_plain, compiled for every instruction set and chosen when first
// called.
#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/hologram/lobes_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include "hogel/hologram/lobes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The mean over one lobe for as many hogels as a vector holds. Most lobes have the same few directions across, which
// the compiler then knows; 0: any number.
template <std::uint32_t across, class D>
HWY_INLINE hn::Vec<D> Mean(D d, const FrequencyGrid::Lobe& lobe, const float* u, const float* rays,
                           std::size_t row_length) {
    const std::uint32_t nu = across > 0 ? across : lobe.nu;
    const float* v = u + lobe.nu;
    auto sum = hn::Zero(d);
    for (std::uint32_t l = 0; l < lobe.nv; ++l) {
        const float* row = rays + l * row_length * hogels_at_once;
        auto line = hn::Mul(hn::Set(d, u[0]), hn::LoadU(d, row));
        for (std::uint32_t k = 1; k < nu; ++k)
            line = hn::MulAdd(hn::Set(d, u[k]), hn::LoadU(d, row + k * hogels_at_once), line);
        sum = hn::MulAdd(hn::Set(d, v[l]), line, sum);
    }
    return sum;
}

void AverageLobes(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                  std::size_t row_length, bool of_roots, float* out) {
    const hn::CappedTag<float, hogels_at_once> d;
    const std::size_t lanes = hn::Lanes(d);
    for (const FrequencyGrid::Lobe& lobe : lobes) {
        const float* u = weights + lobe.weights;
        const float* first = rays + (lobe.v0 * row_length + lobe.u0) * hogels_at_once;
        const auto scale = hn::Set(d, lobe.scale);
        for (std::size_t i = 0; i < hogels_at_once; i += lanes) {
            const auto sum = lobe.nu == 3   ? Mean<3>(d, lobe, u, first + i, row_length)
                             : lobe.nu == 2 ? Mean<2>(d, lobe, u, first + i, row_length)
                             : lobe.nu == 1 ? Mean<1>(d, lobe, u, first + i, row_length)
                                            : Mean<0>(d, lobe, u, first + i, row_length);
            hn::StoreU(of_roots ? hn::Mul(sum, hn::Sqrt(scale)) : hn::Sqrt(hn::Mul(hn::Max(sum, hn::Zero(d)), scale)),
                       d, out + i);
        }
        out += hogels_at_once;
    }
}

void Transpose(const float* from, std::size_t from_row, std::size_t rows, std::size_t columns, float* to,
               std::size_t to_row) {
#if HWY_TARGET == HWY_SCALAR
    transpose_plain(from, from_row, rows, columns, to, to_row);
#else
    const hn::FixedTag<float, 4> quad;
    // Four rows of four columns each, or of several such pieces side by side.
    const auto turn = [&](auto d, auto a, auto b, auto c, auto e, float* out) {
        const auto ac = hn::InterleaveLower(d, a, c), be = hn::InterleaveLower(d, b, e);
        const auto ac_upper = hn::InterleaveUpper(d, a, c), be_upper = hn::InterleaveUpper(d, b, e);
        hn::StoreU(hn::InterleaveLower(d, ac, be), d, out);
        hn::StoreU(hn::InterleaveUpper(d, ac, be), d, out + to_row);
        hn::StoreU(hn::InterleaveLower(d, ac_upper, be_upper), d, out + 2 * to_row);
        hn::StoreU(hn::InterleaveUpper(d, ac_upper, be_upper), d, out + 3 * to_row);
    };
    const auto four = [&](const float* in, float* out) {
        const auto a = hn::LoadU(quad, in), b = hn::LoadU(quad, in + from_row);
        const auto c = hn::LoadU(quad, in + 2 * from_row), e = hn::LoadU(quad, in + 3 * from_row);
        turn(quad, a, b, c, e, out);
    };
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
    // Sixteen rows at once: their pieces of four columns become whole vectors of a column.
    const auto sixteen = [&](const float* in, float* out) {
        const hn::FixedTag<float, 8> eight;
        const hn::CappedTag<float, 16> d;
        const auto pieces = [&](std::size_t row) {
            const auto pair = [&](std::size_t first) {
                return hn::Combine(eight, hn::LoadU(quad, in + (first + 4) * from_row),
                                   hn::LoadU(quad, in + first * from_row));
            };
            return hn::Combine(d, pair(row + 8), pair(row));
        };
        const auto a = pieces(0), b = pieces(1), c = pieces(2), e = pieces(3);
        turn(d, a, b, c, e, out);
    };
#endif
    // In squares of sixteen, along the lines that lie farther apart: whole cache lines of those are done with at once,
    // which at distances of powers of two would not stay in the cache until they are needed again.
    const std::size_t whole_rows = rows / 4 * 4, whole_columns = columns / 4 * 4;
    for (std::size_t row = 0; row < whole_rows; row += 16)
        for (std::size_t column = 0; column < whole_columns; column += 16) {
            const std::size_t end_row = std::min(row + 16, whole_rows), end = std::min(column + 16, whole_columns);
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
            if (end_row == row + 16) {
                for (std::size_t c = column; c < end; c += 4) sixteen(from + row * from_row + c, to + c * to_row + row);
                continue;
            }
#endif
            if (from_row >= to_row) {
                for (std::size_t r = row; r < end_row; r += 4)
                    for (std::size_t c = column; c < end; c += 4) four(from + r * from_row + c, to + c * to_row + r);
            } else {
                for (std::size_t c = column; c < end; c += 4)
                    for (std::size_t r = row; r < end_row; r += 4) four(from + r * from_row + c, to + c * to_row + r);
            }
        }
    transpose_plain(from + whole_columns, from_row, whole_rows, columns - whole_columns, to + whole_columns * to_row,
                    to_row);
    transpose_plain(from + whole_rows * from_row, from_row, rows - whole_rows, columns, to + whole_rows, to_row);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace hogel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel {

HWY_EXPORT(AverageLobes);
HWY_EXPORT(Transpose);

void average_lobes(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                   std::size_t row_length, bool of_roots, float* out) {
    HWY_DYNAMIC_DISPATCH(AverageLobes)(lobes, weights, rays, row_length, of_roots, out);
}

void transpose(const float* from, std::size_t from_row, std::size_t rows, std::size_t columns, float* to,
               std::size_t to_row) {
    HWY_DYNAMIC_DISPATCH(Transpose)(from, from_row, rows, columns, to, to_row);
}

}  // namespace hogel
#endif
