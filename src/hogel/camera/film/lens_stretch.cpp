// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/lens_stretch.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "hogel/optics/phase_walk.h"

namespace hogel::camera::film {
namespace {

// The parabola a + b t + c t² through values at 0, length/2 and length.
struct Parabola {
    Parabola(const double (&values)[3], double length)
        : a(values[0]),
          c((values[2] - 2 * values[1] + values[0]) * 2 / (length * length)),
          b((values[2] - values[0]) / length - c * length) {}
    double a, c, b;

    void store(std::size_t row, LensStretch::Parabolas& parabolas) const {
        parabolas.a[row] = static_cast<float>(a);
        parabolas.b[row] = static_cast<float>(b);
        parabolas.c[row] = static_cast<float>(c);
    }
};

void store(std::complex<double> value, std::size_t row, LensStretch::Phasors& phasors) {
    phasors.re[row] = static_cast<float>(value.real());
    phasors.im[row] = static_cast<float>(value.imag());
}

float evaluate(const LensStretch::Parabolas& parabolas, std::size_t row, float t) {
    return (parabolas.c[row] * t + parabolas.b[row]) * t + parabolas.a[row];
}

std::complex<double> phasor(const LensStretch::Phasors& phasors, std::size_t row) {
    return {phasors.re[row], phasors.im[row]};
}

}  // namespace

void LensStretch::set(std::size_t row, const double (&squares)[3], const double (&weights)[3],
                      const double (&cycles)[3], double length) {
    Parabola(squares, length).store(row, square);
    Parabola(weights, length).store(row, weight);
    const Parabola phase(cycles, length);
    store(optics::unit_phasor(phase.a), row, value);
    store(optics::unit_phasor(phase.b + phase.c), row, step);
    store(optics::unit_phasor(2 * phase.c), row, bend);
}

void lens_stretch_plain(const LensStretch& stretch, const optics::PupilEdge& edge, double radius, float* out) {
    for (std::size_t row = 0; row < optics::block_lines; ++row) {
        std::complex<double> value = phasor(stretch.value, row), step = phasor(stretch.step, row);
        for (std::size_t column = 0; column < stretch.columns; ++column) {
            const auto t = static_cast<float>(column);
            const double distance = std::sqrt(std::max(0.0f, evaluate(stretch.square, row, t)));
            const double transmission = distance < stretch.inner ? 1 : edge.transmission(radius - distance);
            const std::complex<double> factor = evaluate(stretch.weight, row, t) * transmission * value;
            out[2 * column * optics::block_lines + row] = static_cast<float>(factor.real());
            out[(2 * column + 1) * optics::block_lines + row] = static_cast<float>(factor.imag());
            value = optics::times(value, step);
            step = optics::times(step, phasor(stretch.bend, row));
        }
    }
}

}  // namespace hogel::camera::film
