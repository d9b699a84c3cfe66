// SPDX-License-Identifier: Apache-2.0
// Vector twin of lens_stretch.cpp, compiled for every SIMD target and chosen when first called.
#include <cmath>

#include "hogel/camera/film/lens_stretch.h"
#include "hogel/core/simd_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hogel::camera::film::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, optics::block_lines>;
using V = hn::Vec<D>;

struct Parabola {
    V a, b, c;

    Parabola(const LensStretch::Parabolas& source, std::size_t row)
        : a(hn::Load(D(), source.a + row)), b(hn::Load(D(), source.b + row)), c(hn::Load(D(), source.c + row)) {}
    HWY_INLINE V at(V t) const { return hn::MulAdd(hn::MulAdd(c, t, b), t, a); }
};

struct Phasor {
    V re, im;

    Phasor(const LensStretch::Phasors& source, std::size_t row)
        : re(hn::Load(D(), source.re + row)), im(hn::Load(D(), source.im + row)) {}
    HWY_INLINE void rotate(const Phasor& factor) {
        const V rotated = hn::NegMulAdd(im, factor.im, hn::Mul(re, factor.re));
        im = hn::MulAdd(re, factor.im, hn::Mul(im, factor.re));
        re = rotated;
    }
};

void LensStretchRows(const LensStretch& stretch, const optics::PupilEdge& edge, double radius, float* out) {
    const D d;
    const V inner = hn::Set(d, static_cast<float>(stretch.inner * stretch.inner)),
            outer = hn::Set(d, static_cast<float>((radius + edge.reach()) * (radius + edge.reach())));
    for (std::size_t row = 0; row < optics::block_lines; row += hn::Lanes(d)) {
        const Parabola square(stretch.square, row), weight(stretch.weight, row);
        Phasor value(stretch.value, row), step(stretch.step, row);
        const Phasor bend(stretch.bend, row);
        for (std::size_t column = 0; column < stretch.columns; ++column) {
            const V t = hn::Set(d, static_cast<float>(column)), squared = square.at(t);
            V transmission = weight.at(t);
            if (hn::AllTrue(d, hn::Ge(squared, outer))) {
                transmission = hn::Zero(d);
            } else if (!hn::AllTrue(d, hn::Lt(squared, inner))) {
                HWY_ALIGN float distances[optics::block_lines], shares[optics::block_lines];
                hn::Store(hn::Sqrt(hn::Max(squared, hn::Zero(d))), d, distances);
                for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
                    const double distance = distances[lane];
                    shares[lane] =
                        distance < stretch.inner ? 1.0f : static_cast<float>(edge.transmission(radius - distance));
                }
                transmission = hn::Mul(transmission, hn::Load(d, shares));
            }
            float* to = out + 2 * column * optics::block_lines + row;
            hn::Store(hn::Mul(transmission, value.re), d, to);
            hn::Store(hn::Mul(transmission, value.im), d, to + optics::block_lines);
            value.rotate(step);
            step.rotate(bend);
        }
    }
}

}  // namespace hogel::camera::film::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace hogel::camera::film {
HOGEL_DISPATCH(lens_stretch, LensStretchRows);
}  // namespace hogel::camera::film
