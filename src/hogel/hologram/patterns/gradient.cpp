// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/core/random.h"
#include "hogel/hologram/patterns/pattern_parts.h"
#include "hogel/math/fft.h"

namespace hogel::hologram::patterns {
namespace {

using Complex = std::complex<float>;

// Adam, Kingma and Ba 2015, with its usual decay rates; one step is at most about this many radians.
constexpr double first_rate = 0.9, second_rate = 0.999, radians_a_step = 0.25;

// Sums over one row of squares, for the scale between the local spectra of the pattern and the field.
struct Sums {
    double product = 0, energy = 0;
};

// Squares of `side` pixels that cover the modulator, the first at −shift; beyond the border values are zero.
struct Squares {
    std::size_t side, shift_x, shift_y;

    std::size_t columns(std::size_t width) const { return (width + shift_x + side - 1) / side; }
    std::size_t rows(std::size_t height) const { return (height + shift_y + side - 1) / side; }
    // Calls visit(row and column of the pixel, row and column in the square) for the pixels of a square that are on the
    // modulator.
    template <class Visit>
    void visit(std::size_t i, std::size_t j, const Shape<2>& shape, Visit&& visit) const {
        for (std::size_t q = 0; q < side; ++q) {
            const std::size_t y = j * side + q;
            if (y < shift_y || y - shift_y >= shape[0]) continue;
            for (std::size_t p = 0; p < side; ++p) {
                const std::size_t x = i * side + p;
                if (x >= shift_x && x - shift_x < shape[1]) visit(y - shift_y, x - shift_x, q, p);
            }
        }
    }
};

// 1 for the frequencies of a square at which the field has light (a mean of more than a twentieth of the largest), 0
// for the others, at which the pattern is free.
std::vector<float> lit_frequencies(View<const Complex, 2> field, const Squares& squares, const math::Fft2& fft) {
    const std::size_t n = squares.side;
    std::vector<double> mean(n * n);
    Array<Complex, 2> square({n, n});
    for (std::size_t j = 0; j < squares.rows(field.extent(0)); ++j)
        for (std::size_t i = 0; i < squares.columns(field.extent(1)); ++i) {
            std::ranges::fill(square.elements(), Complex(0));
            squares.visit(i, j, field.shape(), [&](auto y, auto x, auto q, auto p) { square(q, p) = field(y, x); });
            fft.forward(square);
            for (std::size_t f = 0; f < n * n; ++f) mean[f] += std::norm(square.data()[f]);
        }
    const double threshold = 0.05 * *std::ranges::max_element(mean);
    std::vector<float> lit;
    for (const double light : mean) lit.push_back(light > threshold ? 1.0f : 0.0f);
    return lit;
}

// The state of the gradient descent.
struct Descent {
    Array<float, 2> phases, gradient;  // radians
    Array<float, 2> first, second;     // running means of the gradient and its square
    double scale = 1;                  // s

    explicit Descent(View<const Complex, 2> field)
        : phases(field.shape()), gradient(field.shape()), first(field.shape()), second(field.shape()) {
        for (std::size_t i = 0; i < phases.size(); ++i) phases.data()[i] = std::arg(field.data()[i]);
    }
};

// Computes the gradient from the local spectra in all squares, and the scale for the next step.
void find_gradient(View<const Complex, 2> field, const Squares& squares, const std::vector<float>& lit,
                   const math::Fft2& fft, Descent& descent) {
    const std::size_t side = squares.side;
    const std::size_t rows = squares.rows(field.extent(0)), columns = squares.columns(field.extent(1));
    std::vector<Sums> sums(rows);
    core::parallel_for(rows, [&](std::size_t j) {
        Array<Complex, 2> shown({side, side}), wanted({side, side});
        for (std::size_t i = 0; i < columns; ++i) {
            std::ranges::fill(shown.elements(), Complex(0));
            std::ranges::fill(wanted.elements(), Complex(0));
            squares.visit(i, j, field.shape(), [&](auto y, auto x, auto q, auto p) {
                shown(q, p) = std::polar(1.0f, descent.phases(y, x));
                wanted(q, p) = field(y, x);
            });
            fft.forward(shown);
            fft.forward(wanted);
            for (std::size_t f = 0; f < lit.size(); ++f) {
                const float a = std::abs(shown.data()[f]), b = std::abs(wanted.data()[f]);
                sums[j].product += lit[f] * a * b;
                sums[j].energy += lit[f] * a * a;
                shown.data()[f] *= a > 0 ? lit[f] * (static_cast<float>(descent.scale) - b / a) : 0.0f;
            }
            fft.backward(shown);
            squares.visit(i, j, field.shape(), [&](auto y, auto x, auto q, auto p) {
                descent.gradient(y, x) = -(std::conj(shown(q, p)) * std::polar(1.0f, descent.phases(y, x))).imag();
            });
        }
    });
    Sums all;
    for (const Sums& row : sums) {
        all.product += row.product;
        all.energy += row.energy;
    }
    descent.scale = all.energy > 0 ? all.product / all.energy : 1;
}

// Adam's step k of `iterations` along the gradient.
void step_along_gradient(std::size_t k, std::size_t iterations, Descent& descent) {
    // Steps become smaller towards the end, so that the phases converge although the squares change at each step.
    const double along = static_cast<double>(k) / static_cast<double>(iterations);
    const double length = radians_a_step * 0.5 * (1 + std::cos(std::numbers::pi * along));
    const double first_left = 1 - std::pow(first_rate, static_cast<double>(k)),
                 second_left = 1 - std::pow(second_rate, static_cast<double>(k));
    core::parallel_for(descent.phases.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < descent.phases.extent(1); ++x) {
            const float g = descent.gradient(y, x);
            float& m = descent.first(y, x);
            float& v = descent.second(y, x);
            m = static_cast<float>(first_rate * m + (1 - first_rate) * g);
            v = static_cast<float>(second_rate * v + (1 - second_rate) * g * g);
            descent.phases(y, x) -=
                static_cast<float>(length * (m / first_left) / (std::sqrt(v / second_left) + 1e-12));
        }
    });
}

}  // namespace

// Gradient descent on the phases φ for Σ m (s|A| − |B|)² over local spectra A of e^{iφ} and B of the field, in squares
// at random positions that change at each step, which avoids seams: a stochastic form of Gerchberg and Saxton's
// iteration, whose squares are fixed. s is the best-fitting scale; m is 1 in directions where the field has light.
// Sources: Peng, Choi, Padmanaban and Wetzstein, ACM TOG 39(6), 2020; with the light field as target, Choi et al.,
// SIGGRAPH 2022.
Array<float, 2> descend_phases(View<const Complex, 2> field, const PatternOptions& options, const Progress& progress) {
    const std::size_t side = options.window;
    require_squares_fit(field, side);
    const math::Fft2 fft(side, side);
    const std::vector<float> lit = lit_frequencies(field, {side, 0, 0}, fft);
    Descent descent(field);
    for (std::size_t k = 0; k <= options.iterations; ++k) {
        progress.report(static_cast<double>(k) / static_cast<double>(options.iterations + 1));
        const auto bits =
            core::philox({static_cast<std::uint32_t>(k), 0, 0, 0},
                         {static_cast<std::uint32_t>(options.seed), static_cast<std::uint32_t>(options.seed >> 32)});
        find_gradient(field, {side, bits[0] % side, bits[1] % side}, lit, fft, descent);
        // The first iteration only determines the scale.
        if (k > 0) step_along_gradient(k, options.iterations, descent);
    }
    for (float& phase : descent.phases.elements()) {
        const auto cycles = static_cast<float>(phase * (0.5 / std::numbers::pi));
        phase = cycles - std::floor(cycles);
    }
    return std::move(descent.phases);
}

}  // namespace hogel::hologram::patterns
