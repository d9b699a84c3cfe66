// SPDX-License-Identifier: Apache-2.0
// Vector twin of project_plain(), compiled for every SIMD target and chosen when first called.
#include <algorithm>

#include "hogel/camera/hogel_spectra/project.h"
#include "hogel/core/simd_targets-inl.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/core/with_count.h"
#include "hogel/math/transpose-inl.h"

// After simd_targets-inl.h:
#include "hogel/camera/hogel_spectra/spread_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::hogel_spectra::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using core::HWY_NAMESPACE::with_count;
using math::HWY_NAMESPACE::transpose_sixteen;

#if HWY_TARGET == HWY_SCALAR
void Project(const SlepianBases& bases, const HogelView& view, const float* waves, const LineTarget& line) {
    project_plain(bases, view, waves, line);
}

void Multiply(const float* factors, std::size_t count, float* waves) {
    for (std::size_t first = 0; first < count; first += 2 * lanes)
        for (std::size_t i = first; i < first + lanes; ++i) {
            const float a = waves[i], b = waves[i + lanes], c = factors[i], s = factors[i + lanes];
            waves[i] = a * c - b * s;
            waves[i + lanes] = a * s + b * c;
        }
}
#else
using D = hn::CappedTag<float, lanes>;
using V = hn::Vec<D>;

// Number of functions with two parts each that fill a row of sixteen numbers.
constexpr std::size_t functions_per_pass = lanes / 2;

void Multiply(const float* factors, std::size_t count, float* waves) {
    const D d;
    for (std::size_t first = 0; first < count; first += 2 * lanes)
        for (std::size_t i = first; i < first + lanes; i += hn::Lanes(d)) {
            const V a = hn::Load(d, waves + i), b = hn::Load(d, waves + i + lanes);
            const V c = hn::Load(d, factors + i), s = hn::Load(d, factors + i + lanes);
            hn::Store(hn::NegMulAdd(b, s, hn::Mul(a, c)), d, waves + i);
            hn::Store(hn::MulAdd(b, c, hn::Mul(a, s)), d, waves + i + lanes);
        }
}

using SymmetricPair = SlepianBasis::SymmetricPair;

// lines[part][function][row] = Σ_column weights · waves for sixteen rows, by pairs of columns.
template <std::size_t functions>
HWY_INLINE void sum_columns(const float* waves, const SlepianBasis::Weights& weights, std::size_t first, float* lines) {
    const D d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        V re[functions], im[functions];
        for (std::size_t k = 0; k < functions; ++k) re[k] = im[k] = hn::Zero(d);
        const std::size_t paired = weights.pairs.size() - weights.unpaired;
        for (const SymmetricPair& pair : weights.pairs.first(paired)) {
            const float *a_wave = waves + 2 * lanes * pair.first + i, *b_wave = waves + 2 * lanes * pair.second + i;
            const V sign = hn::Set(d, pair.sign_first), sign_second = hn::Set(d, pair.sign_second);
            const V a = hn::Xor(hn::Load(d, a_wave), sign), b = hn::Xor(hn::Load(d, a_wave + lanes), sign);
            const V c = hn::Xor(hn::Load(d, b_wave), sign_second),
                    e = hn::Xor(hn::Load(d, b_wave + lanes), sign_second);
            const V sum_re = hn::Add(a, c), sum_im = hn::Add(b, e);
            const V difference_re = hn::Sub(a, c), difference_im = hn::Sub(b, e);
            const float* weight = pair.weights + first;
            for (std::size_t k = 0; k < functions; ++k) {
                const V w = hn::Set(d, weight[k]);
                re[k] = hn::MulAdd(w, k % 2 == 0 ? sum_re : difference_re, re[k]);
                im[k] = hn::MulAdd(w, k % 2 == 0 ? sum_im : difference_im, im[k]);
            }
        }
        for (const SymmetricPair& pair : weights.pairs.subspan(paired)) {
            const float* a_wave = waves + 2 * lanes * pair.first + i;
            const V sign = hn::Set(d, pair.sign_first);
            const V a = hn::Xor(hn::Load(d, a_wave), sign), b = hn::Xor(hn::Load(d, a_wave + lanes), sign);
            for (std::size_t k = 0; k < functions; ++k) {
                const V w = hn::Set(d, pair.weights[first + k]);
                re[k] = hn::MulAdd(w, a, re[k]);
                im[k] = hn::MulAdd(w, b, im[k]);
            }
        }
        for (std::size_t k = 0; k < functions; ++k) {
            hn::Store(re[k], d, lines + k * lanes + i);
            hn::Store(im[k], d, lines + (functions_per_pass + k) * lanes + i);
        }
    }
}

// out[l][…] = Σ_row D_l(row) in[row][…] for `functions` functions l, sixteen numbers per row, by pairs of rows.
template <std::size_t functions>
HWY_INLINE void sum_pairs_of_rows(const float* in, const SlepianBasis::Weights& weights, std::size_t first,
                                  float* out) {
    const D d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        V sums[functions];
        for (V& accumulator : sums) accumulator = hn::Zero(d);
        const std::size_t paired = weights.pairs.size() - weights.unpaired;
        for (const SymmetricPair& pair : weights.pairs.first(paired)) {
            const V a = hn::Xor(hn::Load(d, in + pair.first * lanes + i), hn::Set(d, pair.sign_first));
            const V b = hn::Xor(hn::Load(d, in + pair.second * lanes + i), hn::Set(d, pair.sign_second));
            const V sum = hn::Add(a, b), difference = hn::Sub(a, b);
            for (std::size_t l = 0; l < functions; ++l)
                sums[l] = hn::MulAdd(hn::Set(d, pair.weights[first + l]), l % 2 == 0 ? sum : difference, sums[l]);
        }
        for (const SymmetricPair& pair : weights.pairs.subspan(paired)) {
            const V a = hn::Xor(hn::Load(d, in + pair.first * lanes + i), hn::Set(d, pair.sign_first));
            for (std::size_t l = 0; l < functions; ++l)
                sums[l] = hn::MulAdd(hn::Set(d, pair.weights[first + l]), a, sums[l]);
        }
        for (std::size_t l = 0; l < functions; ++l) hn::Store(sums[l], d, out + l * lanes + i);
    }
}

// out[i][…] = Σ_j weights[i · stride + j · step] in[j][…], sixteen numbers per row, in the order of j.
template <std::size_t count>
HWY_INLINE void sum_rows(const float* in, std::size_t rows, std::size_t in_row, const float* weights,
                         std::size_t stride, float* out, std::size_t out_row) {
    const D d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        V sum[count];
        for (V& accumulator : sum) accumulator = hn::Zero(d);
        for (std::size_t j = 0; j < rows; ++j) {
            const V value = hn::Load(d, in + j * in_row + i);
            for (std::size_t r = 0; r < count; ++r)
                sum[r] = hn::MulAdd(hn::Set(d, weights[r * stride + j]), value, sum[r]);
        }
        for (std::size_t r = 0; r < count; ++r) hn::Store(sum[r], d, out + r * out_row + i);
    }
}

void sum_all_rows(const float* in, std::size_t rows, std::size_t in_row, const float* weights, std::size_t stride,
                  std::size_t count, float* out, std::size_t out_row) {
    for (std::size_t first = 0; first < count; first += functions_per_pass)
        with_count<functions_per_pass>(std::min(functions_per_pass, count - first), [&](auto fixed_count) {
            sum_rows<fixed_count()>(in, rows, in_row, weights + first * stride, stride, out + first * out_row, out_row);
        });
}

void Project(const SlepianBases& bases, const HogelView& view, const float* waves, const LineTarget& line) {
    const std::size_t rows = bases.down.samples(), columns = bases.across.samples(), nodes = bases.across.nodes();
    const std::size_t functions = bases.across.functions(), functions_down = bases.down.functions();
    const auto groups_of = [](std::size_t count) { return (count + functions_per_pass - 1) / functions_per_pass; };
    const std::size_t groups = groups_of(functions), padded_functions = groups * functions_per_pass;
    const std::size_t groups_down = groups_of(functions_down), padded_functions_down = groups_down * functions_per_pass;
    const std::size_t padded_rows = padded(rows), across = padded(nodes);
    const core::ThreadBuffer<float> scratch(
        lanes * (lanes + groups * (padded_rows + padded_functions_down) + groups_down * (padded_functions + across)) +
        2 * across * padded_functions_down);
    float* lines = scratch.data();                               // [part][function][row]
    float* transposed = lines + lanes * lanes;                   // [group][row][part, function across]
    float* numbers = transposed + lanes * groups * padded_rows;  // [group][function down][part, function across]
    float* regrouped =
        numbers + lanes * groups * padded_functions_down;  // [group down][function across][part, function down]
    float* spread_x =
        regrouped + lanes * groups_down * padded_functions;   // [group down][node across][part, function down]
    float* rows_x = spread_x + lanes * groups_down * across;  // [function down][part][node across]
    for (std::size_t group = 0; group < groups; ++group) {
        const std::size_t first = group * functions_per_pass, count = std::min(functions_per_pass, functions - first);
        for (std::size_t row = 0; row < rows; row += lanes) {
            if (!view.in_band_rows.has_any(row, lanes, rows)) {
                std::fill_n(transposed + (group * padded_rows + row) * lanes, lanes * lanes, 0.0f);
                continue;
            }
            with_count<functions_per_pass>(count, [&](auto fixed_count) {
                sum_columns<fixed_count()>(waves + 2 * row * columns, view.columns, first, lines);
            });
            for (std::size_t k = count; k < functions_per_pass; ++k)
                for (std::size_t part : {std::size_t{0}, functions_per_pass})
                    std::fill_n(lines + (part + k) * lanes, lanes, 0.0f);
            float* to = transposed + (group * padded_rows + row) * lanes;
            transpose_sixteen([&](std::size_t i) { return lines + i * lanes; }, lanes,
                              [&](std::size_t j) { return to + j * lanes; });
        }
        for (std::size_t l = 0; l < functions_down; l += functions_per_pass)
            with_count<functions_per_pass>(std::min(functions_per_pass, functions_down - l), [&](auto fixed_count) {
                sum_pairs_of_rows<fixed_count()>(transposed + group * padded_rows * lanes, view.rows, l,
                                                 numbers + (group * padded_functions_down + l) * lanes);
            });
    }
    // Regroups by functions down instead of across, with a factor i for each odd function.
    std::fill_n(regrouped, lanes * groups_down * padded_functions, 0.0f);
    const float sign = view.columns.sign * view.rows.sign;
    for (std::size_t l = 0; l < functions_down; ++l)
        for (std::size_t k = 0; k < functions; ++k) {
            const float* from =
                numbers + (k / functions_per_pass * padded_functions_down + l) * lanes + k % functions_per_pass;
            float* to = regrouped + (l / functions_per_pass * padded_functions + k) * lanes + l % functions_per_pass;
            const float re = sign * from[0], im = sign * from[functions_per_pass];
            const std::size_t odd = k % 2 + l % 2;
            to[0] = odd == 0 ? re : odd == 1 ? -im : -re;
            to[functions_per_pass] = odd == 0 ? im : odd == 1 ? re : -im;
        }
    const float* spread = bases.across.spread().data();
    for (std::size_t group = 0; group < groups_down; ++group) {
        float* to = spread_x + group * across * lanes;
        sum_all_rows(regrouped + group * padded_functions * lanes, functions, lanes, spread, functions, nodes, to,
                     lanes);
        std::fill_n(to + nodes * lanes, (across - nodes) * lanes, 0.0f);
        for (std::size_t node = 0; node < across; node += lanes)
            transpose_sixteen([&](std::size_t i) { return to + (node + i) * lanes; }, lanes,
                              [&](std::size_t j) {
                                  const std::size_t part = j / functions_per_pass,
                                                    l = group * functions_per_pass + j % functions_per_pass;
                                  return rows_x + (2 * l + part) * across + node;
                              });
    }
    const D d;
    for (std::size_t x = 0; x < across; x += hn::Lanes(d)) {
        const V c = hn::Load(d, view.columns.carrier + x), s = hn::Load(d, view.columns.carrier + across + x);
        for (std::size_t l = 0; l < functions_down; ++l) {
            const V re = hn::Load(d, rows_x + 2 * l * across + x), im = hn::Load(d, rows_x + (2 * l + 1) * across + x);
            float* real = line.first + 2 * l * line.row + x;
            add_product(re, im, c, s, real, real + line.row);
        }
    }
}
#endif

}  // namespace hogel::camera::hogel_spectra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::camera::hogel_spectra {

HWY_EXPORT(Multiply);

void MiddlePhases::apply(float* waves, const stereogram::InBandRows& rows) const {
    const std::size_t block = 2 * lanes * columns_;
    for (std::size_t row = 0; row < rows_; row += lanes)
        if (rows.has_any(row, lanes, rows_))
            HWY_DYNAMIC_DISPATCH(Multiply)(&factors_[row / lanes * block], block, waves + row / lanes * block);
}

HOGEL_DISPATCH(project, Project);

}  // namespace hogel::camera::hogel_spectra
#endif
