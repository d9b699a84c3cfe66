// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <utility>

#include "hogel/optics/lines.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/patterns/phasors.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {
namespace {

using Complex = std::complex<float>;
using Numbers = Array<float, 2>;

constexpr std::size_t max_pairs = 5;  // steps and gradient changes in the history
constexpr double first_step = 0.25;   // root mean square of the first step, radians
constexpr double sufficient = 1e-4;   // Armijo's share of the descent predicted by the slope
constexpr int max_halvings = 10;      // of a step without descent
// The descent ends when the correlation rises by less than min_gain in watched_steps steps.
constexpr double min_gain = 5e-4;
constexpr std::size_t watched_steps = 5;

// Σ a b, with eight sums per row for vectorisation.
double dot(const Numbers& a, const Numbers& b) {
    return sum_of_lines(a.extent(0), [&](std::size_t y) {
        constexpr std::size_t lanes = 8;
        const float *row_a = a.data() + y * a.extent(1), *row_b = b.data() + y * b.extent(1);
        double sums[lanes] = {};
        std::size_t x = 0;
        for (; x + lanes <= a.extent(1); x += lanes)
            for (std::size_t i = 0; i < lanes; ++i)
                sums[i] += static_cast<double>(row_a[x + i]) * static_cast<double>(row_b[x + i]);
        for (; x < a.extent(1); ++x) sums[0] += static_cast<double>(row_a[x]) * static_cast<double>(row_b[x]);
        for (std::size_t i = 1; i < lanes; ++i) sums[0] += sums[i];
        return sums[0];
    });
}

// result = a + factor · b; arguments may be the same array.
void add(const Numbers& a, double factor, const Numbers& b, Numbers& result) {
    work::parallel_for(a.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < a.extent(1); ++x) result(y, x) = a(y, x) + static_cast<float>(factor) * b(y, x);
    });
}

void add(Numbers& a, double factor, const Numbers& b) { add(a, factor, b, a); }

// result = factor · a
void multiply(const Numbers& a, double factor, Numbers& result) {
    work::parallel_for(a.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < a.extent(1); ++x) result(y, x) = static_cast<float>(factor) * a(y, x);
    });
}

// Error ε of the pattern e^{iφ} and its gradient −Im(conj(g) e^{iφ}); g has the spectrum FieldBand::derivative().
class PatternError {
  public:
    PatternError(const FieldBand& band, const Shape<2>& shape)
        : band_(band), rows_(shape[0]), columns_(shape[1]), row_fft_(columns_), column_fft_(rows_), plane_(shape) {}

    double evaluate(const Numbers& phases, Numbers& gradient) {
        for_rows([&](std::size_t y, Complex* line) {
            phasors(&phases(y, 0), {line, columns_});
            row_fft_.forward(line);
        });
        std::vector<FieldBand::Sums> sums(columns_);
        for_columns([&](std::size_t x, Complex* column) {
            if (!band_.has_column(x)) return;
            column_fft_.forward(column);
            for (std::size_t y = 0; y < rows_; ++y) band_.add(y, x, column[y], sums[x]);
        });
        FieldBand::Sums sum;
        for (const FieldBand::Sums& column_sums : sums) sum += column_sums;
        const FieldBand::Match match = band_.match(sum);
        for_columns([&](std::size_t x, Complex* column) {
            for (std::size_t y = 0; y < rows_; ++y) column[y] = band_.derivative(match, y, x, column[y]);
            if (!band_.has_column(x)) return;
            column_fft_.backward(column);
        });
        for_rows([&](std::size_t y, Complex* line) {
            row_fft_.backward(line);
            std::vector<Complex> pattern(columns_);
            phasors(&phases(y, 0), pattern);
            for (std::size_t x = 0; x < columns_; ++x)
                gradient(y, x) = line[x].imag() * pattern[x].real() - line[x].real() * pattern[x].imag();
        });
        return match.error;
    }

  private:
    static constexpr std::size_t block_lines = optics::block_lines;

    // Calls row(y, samples) for each row, which it may change.
    template <class Row>
    void for_rows(const Row& row) {
        work::parallel_for(optics::blocks_of(rows_), [&](std::size_t block) {
            const std::size_t first = block * block_lines;
            for (std::size_t y = first; y < std::min(first + block_lines, rows_); ++y) row(y, &plane_(y, 0));
        });
    }

    // Calls column(x, samples) for each column, which it may change.
    template <class Column>
    void for_columns(const Column& column) {
        work::parallel_for(optics::blocks_of(columns_), [&](std::size_t block) {
            const std::size_t x0 = block * block_lines, count = std::min(block_lines, columns_ - x0);
            Array<Complex, 2> lines({count, optics::stride_of(rows_)});
            for (std::size_t y = 0; y < rows_; ++y)
                for (std::size_t i = 0; i < count; ++i) lines(i, y) = plane_(y, x0 + i);
            for (std::size_t i = 0; i < count; ++i) column(x0 + i, &lines(i, 0));
            for (std::size_t y = 0; y < rows_; ++y)
                for (std::size_t i = 0; i < count; ++i) plane_(y, x0 + i) = lines(i, y);
        });
    }

    const FieldBand& band_;
    std::size_t rows_, columns_;
    math::Fft1 row_fft_, column_fft_;
    Array<Complex, 2> plane_;
};

// L-BFGS curvature from the last steps s and gradient changes y: Nocedal and Wright, Numerical Optimization, 2nd ed.,
// algorithm 7.4.
class Curvature {
  public:
    // Stores the pair by swapping. Leaves arrays with undefined values: those of a dropped pair, or new ones.
    void remember(Numbers& step, Numbers& change) {
        const double product = dot(step, change);
        if (!(product > 0)) return;
        Pair pair;
        if (pairs_.size() == max_pairs) {
            pair = std::move(pairs_.front());
            pairs_.pop_front();
        } else {
            pair = {Numbers(step.shape()), Numbers(change.shape()), 0};
        }
        std::swap(pair.step, step);
        std::swap(pair.change, change);
        pair.product = product;
        pairs_.push_back(std::move(pair));
    }

    // Computes the direction of descent d for a gradient of `samples` values.
    void find_direction(const Numbers& gradient, double samples, Numbers& d) const {
        multiply(gradient, 1, d);
        std::vector<double> alpha(pairs_.size());
        for (std::size_t i = pairs_.size(); i-- > 0;) {
            alpha[i] = dot(pairs_[i].step, d) / pairs_[i].product;
            add(d, -alpha[i], pairs_[i].change);
        }
        const double scale = pairs_.empty()
                                 ? -first_step / std::max(std::sqrt(dot(gradient, gradient) / samples), 1e-30)
                                 : -pairs_.back().product / dot(pairs_.back().change, pairs_.back().change);
        multiply(d, scale, d);
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            add(d, -alpha[i] - dot(pairs_[i].change, d) / pairs_[i].product, pairs_[i].step);
    }

  private:
    struct Pair {
        Numbers step, change;
        double product;
    };
    std::deque<Pair> pairs_;
};

}  // namespace

// Minimises ε = 1 − C² over the phases φ. C is the correlation of the field with the light of e^{iφ} that the field's
// aperture passes; the blocked light is free. Objective as in Chakravarthula, Peng, Kollin, Fuchs and Heide, Wirtinger
// holography, ACM TOG 38(6), 2019, in the field's own plane.
Array<float, 2> descend_phases(View<const Complex, 2> field, const FieldBand& band, const PatternOptions& options,
                               Convergence& convergence, const Progress& progress) {
    PatternError error(band, field.shape());
    const Shape<2> shape = field.shape();
    Numbers phases(shape), gradient(shape), next(shape), next_gradient(shape), step(shape);
    work::parallel_for(field.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < field.extent(1); ++x) phases(y, x) = std::arg(field(y, x));
    });
    const std::size_t limit = options.iterations > 0 ? options.iterations : max_descent_steps;
    double current = error.evaluate(phases, gradient);
    std::vector<double> correlations{std::sqrt(1 - current)};
    Curvature curvature;
    for (std::size_t k = 0; k < limit; ++k) {
        progress.report(static_cast<double>(k) / static_cast<double>(limit));
        curvature.find_direction(gradient, static_cast<double>(field.size()), step);
        const double slope = dot(gradient, step);
        if (!(slope < 0)) break;
        double length = 1;
        const auto trial_error = [&] {
            add(phases, length, step, next);
            return error.evaluate(next, next_gradient);
        };
        double trial = trial_error();
        for (int i = 0; i < max_halvings && trial > current + sufficient * length * slope; ++i) {
            length *= 0.5;
            trial = trial_error();
        }
        if (!(trial < current)) break;
        // The step as rounded, and the change of the gradient, in arrays no longer needed.
        add(next, -1, phases, step);
        add(next_gradient, -1, gradient, gradient);
        curvature.remember(step, gradient);
        std::swap(phases, next);
        std::swap(gradient, next_gradient);
        current = trial;
        correlations.push_back(std::sqrt(1 - current));
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

}  // namespace hogel::patterns
