// SPDX-License-Identifier: Apache-2.0
// Vector twins of spread_line.cpp, compiled for every SIMD target and chosen when first called.
#include <algorithm>
#include <vector>

#include "hogel/camera/hogel_spectra/spread_line.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/math/packed_complex-inl.h"
#include "hogel/math/transpose-inl.h"

// After simd_targets-inl.h:
#include "hogel/camera/hogel_spectra/spread_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::hogel_spectra::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using math::HWY_NAMESPACE::transpose_sixteen;
#if HWY_TARGET != HWY_SCALAR
using math::HWY_NAMESPACE::add_to_packed;
#endif

#if HWY_TARGET == HWY_SCALAR
void SpreadLine(const SlepianBasis& down, const float* carrier, const float* line, std::size_t row, std::size_t columns,
                float* light) {
    spread_line_plain(down, carrier, line, row, columns, light);
}
void AddDemodulated(const LightRow& row, std::size_t columns, math::PackedComplex* band) {
    add_demodulated_plain(row, columns, band);
}
void AddDemodulatedLooks(const LightRow& row, std::size_t columns, std::span<math::PackedComplex* const> bands) {
    add_demodulated_looks_plain(row, columns, bands);
}
#else
using D = hn::CappedTag<float, lanes>;
using V = hn::Vec<D>;

void SpreadLine(const SlepianBasis& down, const float* carrier, const float* line, std::size_t row, std::size_t columns,
                float* light) {
    const D d;
    const std::size_t nodes = down.nodes();
    for (std::size_t x = 0; x < columns; x += hn::Lanes(d)) {
        const auto add = [&](std::size_t y, V re, V im) HWY_ATTR {
            const V c = hn::Set(d, carrier[y]), s = hn::Set(d, carrier[padded(nodes) + y]);
            float* real = light + 2 * y * row + x;
            add_product(re, im, c, s, real, real + row);
        };
        spread_pairs(down, line + x, row, [&](std::size_t y, V even_re, V even_im, V odd_re, V odd_im) HWY_ATTR {
            add(y, hn::Add(even_re, odd_re), hn::Add(even_im, odd_im));
            if (const std::size_t other = nodes - 1 - y; other != y)
                add(other, hn::Sub(even_re, odd_re), hn::Sub(even_im, odd_im));
        });
    }
}

// Adds a vector of numbers, cut at the last column, to a row of a band from column `x` on.
HWY_INLINE void add_vector(V re, V im, std::size_t x, std::size_t columns, math::PackedComplex* band) {
    const D d;
    math::PackedComplex* to = band + x / lanes * camera::PackedBand::square + x % lanes;
    if (columns - x >= hn::Lanes(d)) return add_to_packed(d, re, im, to);
    math::PackedComplex tail[lanes];
    std::copy_n(to, columns - x, tail);
    add_to_packed(d, re, im, tail);
    std::copy_n(tail, columns - x, to);
}

void AddDemodulated(const LightRow& row, std::size_t columns, math::PackedComplex* band) {
    const D d;
    for (std::size_t x = 0; x < columns; x += hn::Lanes(d)) {
        const V a = hn::Load(d, row.light + x), b = hn::Load(d, row.light + row.light_row + x);
        const V c = hn::Load(d, row.phases + x), s = hn::Load(d, row.phases + row.phase_row + x);
        add_vector(hn::NegMulAdd(b, s, hn::Mul(a, c)), hn::MulAdd(b, c, hn::Mul(a, s)), x, columns, band);
    }
}

void AddDemodulatedLooks(const LightRow& row, std::size_t columns, std::span<math::PackedComplex* const> bands) {
    const D d;
    const std::size_t across = padded(columns), look_row = 2 * across;
    const core::ThreadBuffer<float> scratch(2 * lanes * lanes + lanes * look_row);
    float *demodulated = scratch.data(),
          *transposed = demodulated + 2 * lanes * lanes;  // [part][column][look], [look][part][column]
    for (std::size_t first = 0; first < across; first += lanes) {
        for (std::size_t x = 0; x < lanes && first + x < columns; ++x) {
            const float *light = row.light + (first + x) * lanes, *phase = row.phases + first + x;
            const V c = hn::Set(d, phase[0]), s = hn::Set(d, phase[row.phase_row]);
            for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
                const V a = hn::Load(d, light + i), b = hn::Load(d, light + row.light_row + i);
                hn::Store(hn::NegMulAdd(b, s, hn::Mul(a, c)), d, demodulated + x * lanes + i);
                hn::Store(hn::MulAdd(b, c, hn::Mul(a, s)), d, demodulated + (lanes + x) * lanes + i);
            }
        }
        for (std::size_t part = 0; part < 2; ++part)
            transpose_sixteen([&](std::size_t x) { return demodulated + (part * lanes + x) * lanes; }, lanes,
                              [&](std::size_t look) { return transposed + look * look_row + part * across + first; });
    }
    for (std::size_t look = 0; look < bands.size(); ++look)
        for (std::size_t x = 0; x < columns; x += hn::Lanes(d)) {
            const float* source = transposed + look * look_row + x;
            __builtin_prefetch(bands[look] + x / lanes * camera::PackedBand::square + x % lanes + lanes);
            add_vector(hn::Load(d, source), hn::Load(d, source + across), x, columns, bands[look]);
        }
}
#endif

}  // namespace hogel::camera::hogel_spectra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::hogel_spectra {
HOGEL_DISPATCH(spread_line, SpreadLine);
HOGEL_DISPATCH(add_demodulated, AddDemodulated);
HOGEL_DISPATCH(add_demodulated_looks, AddDemodulatedLooks);
}  // namespace hogel::camera::hogel_spectra
