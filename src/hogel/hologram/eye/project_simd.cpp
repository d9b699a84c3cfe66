// SPDX-License-Identifier: Apache-2.0
// The vector twin of project_plain, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/hologram/eye/project_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>

#include "hogel/core/with_count.h"
#include "hogel/hologram/eye/project.h"
#include "hogel/hologram/transpose_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::hologram::eye {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using core::HWY_NAMESPACE::with_count;
using hologram::HWY_NAMESPACE::transpose_sixteen;

#if HWY_TARGET == HWY_SCALAR
void Project(const HogelBasis& basis, const MiddlePhases& middle, const HogelView& view, const float* waves,
             const BandPlace& band) {
    project_plain(basis, middle, view, waves, band);
}
#else
using D = hn::CappedTag<float, lanes>;
using V = hn::Vec<D>;

// Functions whose two parts fill a row of sixteen numbers.
constexpr std::size_t together = lanes / 2;

// lines[part][function][row] of sixteen rows: the sums over all columns of weights times waves, whose phases are
// counted from the middle.
template <std::size_t functions>
HWY_INLINE void sum_columns(const float* waves, std::size_t columns, const float* weights, std::size_t stride,
                            const MiddlePhases& middle, std::size_t first_row, float* lines) {
    const D d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        V re[functions], im[functions];
        for (std::size_t k = 0; k < functions; ++k) re[k] = im[k] = hn::Zero(d);
        for (std::size_t column = 0; column < columns; ++column) {
            const float* wave = waves + 2 * lanes * column + i;
            const V a = hn::Load(d, wave), b = hn::Load(d, wave + lanes);
            const V c = hn::Set(d, middle.re[column]), s = hn::Set(d, middle.im[column]);
            const V x = hn::NegMulAdd(b, s, hn::Mul(a, c)), y = hn::MulAdd(b, c, hn::Mul(a, s));
            for (std::size_t k = 0; k < functions; ++k) {
                const V weight = hn::Set(d, weights[k * stride + column]);
                re[k] = hn::MulAdd(weight, x, re[k]);
                im[k] = hn::MulAdd(weight, y, im[k]);
            }
        }
        const V c = hn::Load(d, middle.re.data() + first_row + i), s = hn::Load(d, middle.im.data() + first_row + i);
        for (std::size_t k = 0; k < functions; ++k) {
            hn::Store(hn::NegMulAdd(im[k], s, hn::Mul(re[k], c)), d, lines + k * lanes + i);
            hn::Store(hn::MulAdd(im[k], c, hn::Mul(re[k], s)), d, lines + (together + k) * lanes + i);
        }
    }
}

// out[i][…] = Σ_j weights[i · stride + j · step] in[j][…], sixteen numbers in a row, in the order of j.
template <std::size_t count>
HWY_INLINE void sum_rows(const float* in, std::size_t rows, std::size_t in_row, const float* weights,
                         std::size_t stride, float* out, std::size_t out_row) {
    const D d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        V sum[count];
        for (V& one : sum) one = hn::Zero(d);
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
    for (std::size_t first = 0; first < count; first += together)
        with_count<together>(std::min(together, count - first), [&](auto some) {
            sum_rows<some()>(in, rows, in_row, weights + first * stride, stride, out + first * out_row, out_row);
        });
}

// Adds a row of nodes times their phases to the band.
HWY_INLINE void add_times_phases(const float* re, const float* im, const float* phase_re, const float* phase_im,
                                 float* to_re, float* to_im) {
    const D d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const V a = hn::Load(d, re + i), b = hn::Load(d, im + i);
        const V c = hn::Load(d, phase_re + i), s = hn::Load(d, phase_im + i);
        hn::StoreU(hn::Add(hn::LoadU(d, to_re + i), hn::NegMulAdd(b, s, hn::Mul(a, c))), d, to_re + i);
        hn::StoreU(hn::Add(hn::LoadU(d, to_im + i), hn::MulAdd(b, c, hn::Mul(a, s))), d, to_im + i);
    }
}

void Project(const HogelBasis& basis, const MiddlePhases& middle, const HogelView& view, const float* waves,
             const BandPlace& band) {
    const std::size_t n = basis.samples(), functions = basis.functions(), nodes = basis.nodes();
    const std::size_t rows = padded(n), groups = (functions + together - 1) / together, across = padded(nodes);
    const std::size_t all = groups * together;
    thread_local std::vector<float, CacheLineAllocator<float> > scratch;
    const std::size_t needed =
        lanes * (lanes + groups * (rows + all + across)) + 2 * across * all + 2 * all * all + lanes * lanes;
    if (scratch.size() < needed) scratch.resize(needed);
    float* lines = scratch.data();                       // [part][function][row]
    float* turned = lines + lanes * lanes;               // [group][row][part, function across]
    float* numbers = turned + lanes * groups * rows;     // [group][function down][part, function across]
    float* swapped = numbers + lanes * groups * all;     // [group down][function across][part, function down]
    float* spread_x = swapped + lanes * groups * all;    // [group down][node across][part, function down]
    float* rows_x = spread_x + lanes * groups * across;  // [function down][part][node across]
    float* sums = rows_x + 2 * across * all;             // [part][node across]
    for (std::size_t group = 0; group < groups; ++group) {
        const std::size_t first = group * together, count = std::min(together, functions - first);
        for (std::size_t row = 0; row < n; row += lanes) {
            with_count<together>(count, [&](auto some) {
                sum_columns<some()>(waves + 2 * row * n, n, view.columns.first + first * view.columns.stride,
                                    view.columns.stride, middle, row, lines);
            });
            for (std::size_t k = count; k < together; ++k)
                for (std::size_t part : {std::size_t{0}, together})
                    std::fill_n(lines + (part + k) * lanes, lanes, 0.0f);
            float* to = turned + (group * rows + row) * lanes;
            transpose_sixteen([&](std::size_t i) { return lines + i * lanes; }, lanes,
                              [&](std::size_t j) { return to + j * lanes; });
        }
        sum_all_rows(turned + group * rows * lanes, n, lanes, view.rows.first, view.rows.stride, functions,
                     numbers + group * all * lanes, lanes);
    }
    // Functions down become those that lie side by side; i for each odd function.
    std::fill_n(swapped, lanes * groups * all, 0.0f);
    const float sign = view.columns.sign * view.rows.sign;
    for (std::size_t l = 0; l < functions; ++l)
        for (std::size_t k = 0; k < functions; ++k) {
            const float* from = numbers + (k / together * all + l) * lanes + k % together;
            float* to = swapped + (l / together * all + k) * lanes + l % together;
            const float re = sign * from[0], im = sign * from[together];
            const std::size_t odd = k % 2 + l % 2;
            to[0] = odd == 0 ? re : odd == 1 ? -im : -re;
            to[together] = odd == 0 ? im : odd == 1 ? re : -im;
        }
    const float* spread = basis.spread().data();
    for (std::size_t group = 0; group < groups; ++group) {
        float* to = spread_x + group * across * lanes;
        sum_all_rows(swapped + group * all * lanes, functions, lanes, spread, functions, nodes, to, lanes);
        std::fill_n(to + nodes * lanes, (across - nodes) * lanes, 0.0f);
        for (std::size_t node = 0; node < across; node += lanes)
            transpose_sixteen([&](std::size_t i) { return to + (node + i) * lanes; }, lanes,
                              [&](std::size_t j) {
                                  const std::size_t part = j / together, l = group * together + j % together;
                                  return rows_x + (2 * l + part) * across + node;
                              });
    }
    for (std::size_t y = 0; y < nodes; ++y)
        for (std::size_t x = 0; x < across; x += lanes) {
            // One node down at a time: the sums over functions are short.
            for (std::size_t part = 0; part < 2; ++part)
                sum_rows<1>(rows_x + part * across + x, functions, 2 * across, spread + y * functions, functions,
                            sums + part * lanes, lanes);
            float* to = band.first + y * band.row + x;
            add_times_phases(sums, sums + lanes, &view.phases(y, 0, x), &view.phases(y, 1, x), to, to + band.part);
        }
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::hologram::eye
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::hologram::eye {

HWY_EXPORT(Project);

void project(const HogelBasis& basis, const MiddlePhases& middle, const HogelView& view, const float* waves,
             const BandPlace& band) {
    HWY_DYNAMIC_DISPATCH(Project)(basis, middle, view, waves, band);
}

}  // namespace hogel::hologram::eye
#endif
