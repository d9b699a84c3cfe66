// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/hologram/patterns/pattern_parts.h"

namespace hogel::hologram::patterns {
namespace {

using Complex = std::complex<float>;
using Numbers = Array<float, 2>;

constexpr std::size_t max_pairs = 5;  // steps that are remembered
constexpr double first_step = 0.25;   // root mean square of the first step, radians
constexpr double sufficient = 1e-4;   // Armijo's share of the descent that the slope promises
constexpr int max_halvings = 10;      // of a step that does not descend
// The descent ends when the correlation gains less than this in so many steps.
constexpr double min_gain = 5e-4;
constexpr std::size_t watched_steps = 5;

// Σ a b, row by row, so that it is the same for any number of threads.
double dot(const Numbers& a, const Numbers& b) {
    std::vector<double> rows(a.extent(0));
    core::parallel_for(a.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < a.extent(1); ++x) rows[y] += static_cast<double>(a(y, x)) * b(y, x);
    });
    double sum = 0;
    for (const double row : rows) sum += row;
    return sum;
}

// a += factor · b
void add(Numbers& a, double factor, const Numbers& b) {
    core::parallel_for(a.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < a.extent(1); ++x) a(y, x) += static_cast<float>(factor) * b(y, x);
    });
}

void multiply(Numbers& a, double factor) {
    core::parallel_for(a.extent(0), [&](std::size_t y) {
        for (float& value : a[y].elements()) value *= static_cast<float>(factor);
    });
}

Numbers difference(const Numbers& a, const Numbers& b) {
    Numbers result = a;
    add(result, -1, b);
    return result;
}

// The error of the pattern e^{iφ}, and its gradient ∂ε/∂φ = −Im(conj(g) e^{iφ}) with g from FieldBand::difference().
class PatternError {
  public:
    PatternError(const FieldBand& band, const Shape<2>& shape) : band_(band), shown_(shape) {}

    double find(const Numbers& phases, Numbers& gradient) {
        core::parallel_for(phases.extent(0), [&](std::size_t y) {
            for (std::size_t x = 0; x < phases.extent(1); ++x) shown_(y, x) = std::polar(1.0f, phases(y, x));
        });
        const FieldBand::Match match = band_.match(shown_);
        band_.difference(match, shown_);
        core::parallel_for(phases.extent(0), [&](std::size_t y) {
            for (std::size_t x = 0; x < phases.extent(1); ++x)
                gradient(y, x) = -(std::conj(shown_(y, x)) * std::polar(1.0f, phases(y, x))).imag();
        });
        return match.error;
    }

  private:
    const FieldBand& band_;
    Array<Complex, 2> shown_;
};

// The last steps s and the changes y of the gradient over them, which stand for the curvature: L-BFGS, Nocedal and
// Wright, Numerical Optimization, 2nd ed., algorithm 7.4.
class Curvature {
  public:
    void remember(Numbers step, Numbers change) {
        const double product = dot(step, change);
        if (!(product > 0)) return;
        pairs_.push_back({std::move(step), std::move(change), product});
        if (pairs_.size() > max_pairs) pairs_.pop_front();
    }

    // The direction of descent that belongs to a gradient.
    Numbers direction(const Numbers& gradient) const {
        Numbers d = gradient;
        std::vector<double> along(pairs_.size());
        for (std::size_t i = pairs_.size(); i-- > 0;) {
            along[i] = dot(pairs_[i].step, d) / pairs_[i].product;
            add(d, -along[i], pairs_[i].change);
        }
        const double count = static_cast<double>(d.size());
        multiply(d, pairs_.empty() ? -first_step / std::max(std::sqrt(dot(gradient, gradient) / count), 1e-30)
                                   : -pairs_.back().product / dot(pairs_.back().change, pairs_.back().change));
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            add(d, -along[i] - dot(pairs_[i].change, d) / pairs_[i].product, pairs_[i].step);
        return d;
    }

  private:
    struct Pair {
        Numbers step, change;
        double product;
    };
    std::deque<Pair> pairs_;
};

}  // namespace

// Descent on the phases φ for ε = 1 − C², with C the correlation of e^{iφ} and the field within the field's band; the
// light beyond is free, and an aperture blocks it. The objective is that of Chakravarthula, Peng, Kollin, Fuchs and
// Heide, Wirtinger holography, ACM TOG 38(6), 2019, in the field's own plane.
Array<float, 2> descend_phases(View<const Complex, 2> field, const PatternOptions& options, Convergence& convergence,
                               const Progress& progress) {
    require_squares_fit(field, options.window);
    const FieldBand band(field, options.window);
    PatternError error(band, field.shape());
    Numbers phases(field.shape()), gradient(field.shape()), next_gradient(field.shape());
    for (std::size_t i = 0; i < phases.size(); ++i) phases.data()[i] = std::arg(field.data()[i]);
    const std::size_t limit = options.iterations > 0 ? options.iterations : max_descent_steps;
    double now = error.find(phases, gradient);
    std::vector<double> correlations{std::sqrt(1 - now)};
    Curvature curvature;
    for (std::size_t k = 0; k < limit; ++k) {
        progress.report(static_cast<double>(k) / static_cast<double>(limit));
        Numbers step = curvature.direction(gradient);
        const double slope = dot(gradient, step);
        if (!(slope < 0)) break;
        Numbers next = phases;
        add(next, 1, step);
        double then = error.find(next, next_gradient), length = 1;
        for (int i = 0; i < max_halvings && then > now + sufficient * length * slope; ++i) {
            length *= 0.5;
            next = phases;
            add(next, length, step);
            then = error.find(next, next_gradient);
        }
        if (!(then < now)) break;
        curvature.remember(difference(next, phases), difference(next_gradient, gradient));
        std::swap(phases, next);
        std::swap(gradient, next_gradient);
        now = then;
        correlations.push_back(std::sqrt(1 - now));
        if (k + 1 >= watched_steps &&
            correlations.back() - correlations[correlations.size() - 1 - watched_steps] < min_gain)
            break;
    }
    convergence = {correlations.size() - 1, correlations.back()};
    for (float& phase : phases.elements()) {
        const auto cycles = static_cast<float>(phase * (0.5 / std::numbers::pi));
        phase = cycles - std::floor(cycles);
    }
    return phases;
}

}  // namespace hogel::hologram::patterns
