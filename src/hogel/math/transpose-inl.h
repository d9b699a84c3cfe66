// SPDX-License-Identifier: Apache-2.0
// Transpose of 16 × 16 numbers, for files that are compiled once per SIMD target. Include it after hwy/highway.h.
#if defined(HOGEL_MATH_TRANSPOSE) == defined(HWY_TARGET_TOGGLE)
#ifdef HOGEL_MATH_TRANSPOSE
#undef HOGEL_MATH_TRANSPOSE
#else
#define HOGEL_MATH_TRANSPOSE
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace hogel::math::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
template <class From, class To>
void transpose_sixteen(const From& from, std::size_t columns, const To& to) {
    for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t i = 0; i < 16; ++i) to(j)[i] = from(i)[j];
}
#else
// Transposes 4 × 4 numbers.
HWY_INLINE void transpose_four(const float* a, const float* b, const float* c, const float* e, float* out0, float* out1,
                               float* out2, float* out3) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::FixedTag<float, 4> d;
    const auto va = hn::LoadU(d, a), vb = hn::LoadU(d, b), vc = hn::LoadU(d, c), ve = hn::LoadU(d, e);
    const auto ac = hn::InterleaveLower(d, va, vc), be = hn::InterleaveLower(d, vb, ve);
    const auto ac_upper = hn::InterleaveUpper(d, va, vc), be_upper = hn::InterleaveUpper(d, vb, ve);
    hn::StoreU(hn::InterleaveLower(d, ac, be), d, out0);
    hn::StoreU(hn::InterleaveUpper(d, ac, be), d, out1);
    hn::StoreU(hn::InterleaveLower(d, ac_upper, be_upper), d, out2);
    hn::StoreU(hn::InterleaveUpper(d, ac_upper, be_upper), d, out3);
}

// Transposes sixteen rows. from(i): address of row i. to(j): destination of column j, j < columns.
template <class From, class To>
HWY_INLINE void transpose_sixteen(const From& from, std::size_t columns, const To& to) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::FixedTag<float, 16> d;
    const hn::Repartition<double, decltype(d)> pairs;
    // Exchanges single numbers, then pairs, fours and eights.
    hn::Vec<decltype(d)> a[16], b[16];
    for (std::size_t i = 0; i < 16; ++i) a[i] = hn::LoadU(d, from(i));
    for (std::size_t i = 0; i < 16; i += 2) {
        b[i] = hn::InterleaveLower(d, a[i], a[i + 1]);
        b[i + 1] = hn::InterleaveUpper(d, a[i], a[i + 1]);
    }
    for (std::size_t i = 0; i < 16; i += 4)
        for (std::size_t j = 0; j < 2; ++j) {
            const auto low = hn::BitCast(pairs, b[i + j]), high = hn::BitCast(pairs, b[i + j + 2]);
            a[i + 2 * j] = hn::BitCast(d, hn::InterleaveLower(pairs, low, high));
            a[i + 2 * j + 1] = hn::BitCast(d, hn::InterleaveUpper(pairs, low, high));
        }
    for (std::size_t i = 0; i < 16; i += 8)
        for (std::size_t j = 0; j < 4; ++j) {
            b[i + j] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(a[i + j + 4]), a[i + j]);
            b[i + j + 4] = hn::OddEvenBlocks(a[i + j + 4], hn::SwapAdjacentBlocks(a[i + j]));
        }
    if (columns == 16) {
        for (std::size_t j = 0; j < 8; ++j) {
            hn::StoreU(hn::ConcatLowerLower(d, b[j + 8], b[j]), d, to(j));
            hn::StoreU(hn::ConcatUpperUpper(d, b[j + 8], b[j]), d, to(j + 8));
        }
        return;
    }
    for (std::size_t j = 0; j < 8; ++j) {
        if (j < columns) hn::StoreU(hn::ConcatLowerLower(d, b[j + 8], b[j]), d, to(j));
        if (j + 8 < columns) hn::StoreU(hn::ConcatUpperUpper(d, b[j + 8], b[j]), d, to(j + 8));
    }
#else
    std::size_t j = 0;
    for (; j < columns / 4 * 4; j += 4)
        for (std::size_t i = 0; i < 16; i += 4)
            transpose_four(from(i) + j, from(i + 1) + j, from(i + 2) + j, from(i + 3) + j, to(j) + i, to(j + 1) + i,
                           to(j + 2) + i, to(j + 3) + i);
    for (; j < columns; ++j)
        for (std::size_t i = 0; i < 16; ++i) to(j)[i] = from(i)[j];
#endif
}
#endif

}  // namespace hogel::math::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
