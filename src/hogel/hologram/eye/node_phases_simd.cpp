// SPDX-License-Identifier: Apache-2.0
// The vector twin of node_phases.cpp, compiled for every SIMD target and chosen when first called.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hogel/hologram/eye/node_phases_simd.cpp"
#include <hwy/foreach_target.h>
// Must be included after foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hogel/hologram/eye/node_phases.h"
#include "hogel/hologram/eye/project.h"
#include "hogel/optics/unit_phasors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::hologram::eye {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
void NodePhases(const NodeLine& across, const NodeLine& down, double bend, std::span<const double> places,
                float* phases) {
    node_phases_plain(across, down, bend, places, phases);
}
#else
// A line's phases, real and imaginary parts: √(r² + c) − r = c/(√(r² + c) + r) needs no double precision.
void line_phases(const NodeLine& line, const float* places, std::size_t count, float* re, float* im) {
    const hn::CappedTag<float, lanes> d;
    const double square = line.first * line.first + line.square, distance = std::sqrt(square);
    const double turns = distance * line.frequency - line.off;
    const auto set = [&](double value) HWY_ATTR { return hn::Set(d, static_cast<float>(value)); };
    const auto start = set(turns - std::round(turns)), r = set(distance), r_square = set(square);
    const auto slope = set(2 * line.first * line.step), bend = set(line.step * line.step);
    const auto frequency = set(line.frequency), tilt = set(line.tilt);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto place = hn::Load(d, places + i);
        const auto change = hn::Mul(hn::MulAdd(bend, place, slope), place);
        const auto longer = hn::Div(change, hn::Add(hn::Sqrt(hn::Add(r_square, change)), r));
        const auto cycles = hn::MulAdd(longer, frequency, hn::NegMulAdd(tilt, place, start));
        hn::Vec<decltype(d)> cosine, sine;
        optics::HWY_NAMESPACE::unit_phasors_within(hn::Sub(cycles, hn::Round(cycles)), cosine, sine);
        hn::Store(cosine, d, re + i);
        hn::Store(sine, d, im + i);
    }
}

void NodePhases(const NodeLine& across, const NodeLine& down, double bend, std::span<const double> places,
                float* phases) {
    const hn::CappedTag<float, lanes> d;
    constexpr std::size_t most = 64;  // nodes of a tile of the square
    const std::size_t nodes = places.size(), row = phase_row(nodes);
    if (nodes > most) return node_phases_plain(across, down, bend, places, phases);
    HWY_ALIGN float right[most], across_re[most], across_im[most], down_re[most], down_im[most];
    const std::size_t count = padded(nodes);
    for (std::size_t i = 0; i < count; ++i) right[i] = static_cast<float>(places[std::min(i, nodes - 1)]);
    line_phases(across, right, count, across_re, across_im);
    line_phases(down, right, count, down_re, down_im);
    for (std::size_t y = 0; y < nodes; ++y) {
        float* to = phases + 2 * y * row;
        const auto angle = hn::Set(d, static_cast<float>(2 * std::numbers::pi * bend) * right[y]);
        const auto c = hn::Set(d, down_re[y]), s = hn::Set(d, down_im[y]);
        for (std::size_t x = 0; 2 * x < row; x += hn::Lanes(d)) {
            // e^{iθ} for a small θ
            const auto theta = hn::Mul(angle, hn::Load(d, right + x)), square = hn::Mul(theta, theta);
            const auto cosine = hn::MulAdd(square, hn::Set(d, -0.5f), hn::Set(d, 1.0f));
            const auto sine = hn::Mul(theta, hn::MulAdd(square, hn::Set(d, -1.0f / 6), hn::Set(d, 1.0f)));
            const auto a = hn::Load(d, across_re + x), b = hn::Load(d, across_im + x);
            const auto e = hn::NegMulAdd(b, s, hn::Mul(a, c)), f = hn::MulAdd(b, c, hn::Mul(a, s));
            const auto re = hn::NegMulAdd(f, sine, hn::Mul(e, cosine)), im = hn::MulAdd(f, cosine, hn::Mul(e, sine));
            HWY_ALIGN float same[2 * lanes], turned[2 * lanes];
            hn::StoreInterleaved2(re, re, d, same);
            hn::StoreInterleaved2(hn::Neg(im), im, d, turned);
            for (std::size_t i = 0; i < 2 * hn::Lanes(d) && 2 * x + i < row; i += hn::Lanes(d)) {
                hn::Store(hn::Load(d, same + i), d, to + 2 * x + i);
                hn::Store(hn::Load(d, turned + i), d, to + row + 2 * x + i);
            }
        }
    }
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hogel::hologram::eye
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hogel::hologram::eye {

HWY_EXPORT(NodePhases);

void node_phases(const NodeLine& across, const NodeLine& down, double bend, std::span<const double> places,
                 float* phases) {
    HWY_DYNAMIC_DISPATCH(NodePhases)(across, down, bend, places, phases);
}

}  // namespace hogel::hologram::eye
#endif
