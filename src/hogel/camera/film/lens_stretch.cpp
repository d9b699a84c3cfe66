// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/lens_stretch.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "hogel/optics/phase_walk.h"

namespace hogel::camera::film {
namespace {

// a + b t + c t² through values at 0, length/2 and length.
struct Parabola {
    Parabola(const double (&values)[3], double length)
        : a(values[0]),
          c((values[2] - 2 * values[1] + values[0]) * 2 / (length * length)),
          b((values[2] - values[0]) / length - c * length) {}
    double a, c, b;

    void put(std::size_t row, LensStretch::Parabolas& all) const {
        all.a[row] = static_cast<float>(a);
        all.b[row] = static_cast<float>(b);
        all.c[row] = static_cast<float>(c);
    }
};

void put(std::complex<double> value, std::size_t row, LensStretch::Phasors& all) {
    all.re[row] = static_cast<float>(value.real());
    all.im[row] = static_cast<float>(value.imag());
}

float at(const LensStretch::Parabolas& all, std::size_t row, float t) {
    return (all.c[row] * t + all.b[row]) * t + all.a[row];
}

std::complex<double> phasor(const LensStretch::Phasors& all, std::size_t row) { return {all.re[row], all.im[row]}; }

}  // namespace

void LensStretch::set(std::size_t row, const double (&squares)[3], const double (&weights)[3],
                      const double (&cycles)[3], double length) {
    Parabola(squares, length).put(row, square);
    Parabola(weights, length).put(row, weight);
    const Parabola phase(cycles, length);
    put(optics::unit_phasor(phase.a), row, value);
    put(optics::unit_phasor(phase.b + phase.c), row, step);
    put(optics::unit_phasor(2 * phase.c), row, bend);
}

void lens_stretch_plain(const LensStretch& stretch, const optics::PupilEdge& edge, double radius, float* out) {
    for (std::size_t row = 0; row < optics::block_lines; ++row) {
        std::complex<double> value = phasor(stretch.value, row), step = phasor(stretch.step, row);
        for (std::size_t column = 0; column < stretch.columns; ++column) {
            const auto t = static_cast<float>(column);
            const double distance = std::sqrt(std::max(0.0f, at(stretch.square, row, t)));
            const double passes = distance < stretch.inner ? 1 : edge.transmission(radius - distance);
            const std::complex<double> factor = at(stretch.weight, row, t) * passes * value;
            out[2 * column * optics::block_lines + row] = static_cast<float>(factor.real());
            out[(2 * column + 1) * optics::block_lines + row] = static_cast<float>(factor.imag());
            value = optics::times(value, step);
            step = optics::times(step, phasor(stretch.bend, row));
        }
    }
}

}  // namespace hogel::camera::film
