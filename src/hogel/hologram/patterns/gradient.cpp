// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <utility>

#include "hogel/core/parallel.h"
#include "hogel/core/shared_order.h"
#include "hogel/core/shared_plane.h"
#include "hogel/hologram/patterns/pattern_parts.h"
#include "hogel/optics/lines.h"

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

// Σ a b, in each row as eight sums, which vectors add. Each process of a team has its own rows.
double dot(const Numbers& a, const Numbers& b, Team* team) {
    return sum_of_lines(a.extent(0), team, [&](std::size_t y) {
        constexpr std::size_t together = 8;
        const float *one = a.data() + y * a.extent(1), *other = b.data() + y * b.extent(1);
        double sums[together] = {};
        std::size_t x = 0;
        for (; x + together <= a.extent(1); x += together)
            for (std::size_t i = 0; i < together; ++i)
                sums[i] += static_cast<double>(one[x + i]) * static_cast<double>(other[x + i]);
        for (; x < a.extent(1); ++x) sums[0] += static_cast<double>(one[x]) * static_cast<double>(other[x]);
        for (std::size_t i = 1; i < together; ++i) sums[0] += sums[i];
        return sums[0];
    });
}

// result = a + factor · b; any two may be the same array.
void add(const Numbers& a, double factor, const Numbers& b, Numbers& result) {
    core::parallel_for(a.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < a.extent(1); ++x) result(y, x) = a(y, x) + static_cast<float>(factor) * b(y, x);
    });
}

void add(Numbers& a, double factor, const Numbers& b) { add(a, factor, b, a); }

// result = factor · a
void multiply(const Numbers& a, double factor, Numbers& result) {
    core::parallel_for(a.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < a.extent(1); ++x) result(y, x) = static_cast<float>(factor) * a(y, x);
    });
}

// The error of the pattern e^{iφ}, and its gradient ∂ε/∂φ = −Im(conj(g) e^{iφ}) with g the error's derivative by the
// pattern, whose spectrum is FieldBand::derivative(). Phases and gradients are those of the own rows.
class PatternError {
  public:
    PatternError(const FieldBand& band, const Shape<2>& shape, Team* team)
        : band_(band),
          team_(team),
          rows_(shape[0]),
          along_(shape[1]),
          down_(shape[0]),
          plane_(shape[0], shape[1], 1, lines_together, {std::numeric_limits<std::size_t>::max(), {}}, team),
          own_(plane_.own_rows(rows_)),
          across_(plane_.own_columns()) {}

    core::LineRange own_rows() const { return own_; }

    double find(const Numbers& phases, Numbers& gradient) {
        plane_.begin_rows(rows_);
        for_rows([&](std::size_t y, Complex* line) {
            for (std::size_t x = 0; x < plane_.columns(); ++x) line[x] = std::polar(1.0f, phases(y - own_.first, x));
            along_.forward(line);
            plane_.put_row(y, line);
        });
        plane_.to_columns(rows_);
        std::vector<FieldBand::Sums> sums(across_.count);
        for_columns([&](std::size_t x, Complex* column) {
            down_.forward(column);
            for (std::size_t y = 0; y < rows_; ++y) band_.add(y, x, column[y], sums[x - across_.first]);
        });
        const FieldBand::Match match = band_.match(sum_in_order(sums, team_));
        for_columns([&](std::size_t x, Complex* column) {
            for (std::size_t y = 0; y < rows_; ++y) column[y] = band_.derivative(match, y, x, column[y]);
            down_.backward(column);
        });
        plane_.to_rows(rows_);
        for_rows([&](std::size_t y, Complex* line) {
            plane_.get_row(y, line);
            along_.backward(line);
            for (std::size_t x = 0; x < plane_.columns(); ++x)
                gradient(y - own_.first, x) =
                    -(std::conj(line[x]) * std::polar(1.0f, phases(y - own_.first, x))).imag();
        });
        return match.error;
    }

  private:
    static constexpr std::size_t lines_together = optics::lines_together;

    // Calls row(y, line) with a place for each own row.
    template <class Row>
    void for_rows(const Row& row) const {
        core::parallel_for(optics::blocks_of(own_.count), [&](std::size_t block) {
            Array<Complex, 1> line({plane_.columns()});
            const std::size_t first = block * lines_together;
            for (std::size_t y = first; y < std::min(first + lines_together, own_.count); ++y)
                row(own_.first + y, line.data());
        });
    }

    // Calls column(x, values) for each own column, to change it.
    template <class Column>
    void for_columns(const Column& column) {
        core::parallel_for(optics::blocks_of(across_.count), [&](std::size_t block) {
            const std::size_t x0 = across_.first + block * lines_together,
                              count = std::min(lines_together, across_.end() - x0);
            Array<Complex, 2> lines({count, optics::stride_of(rows_)});
            for (std::size_t y = 0; y < rows_; ++y)
                for (std::size_t i = 0; i < count; ++i) lines(i, y) = plane_.at(y, x0 + i);
            for (std::size_t i = 0; i < count; ++i) column(x0 + i, &lines(i, 0));
            for (std::size_t y = 0; y < rows_; ++y)
                for (std::size_t i = 0; i < count; ++i) plane_.at(y, x0 + i) = lines(i, y);
        });
    }

    const FieldBand& band_;
    Team* team_;
    std::size_t rows_;
    math::Fft1 along_, down_;
    core::SharedPlane plane_;
    core::LineRange own_, across_;
};

// The last steps s and the changes y of the gradient over them, which stand for the curvature: L-BFGS, Nocedal and
// Wright, Numerical Optimization, 2nd ed., algorithm 7.4.
class Curvature {
  public:
    explicit Curvature(Team* team) : team_(team) {}

    // Takes both, and leaves arrays in their place with any numbers: those of the oldest pair, if it is forgotten.
    void remember(Numbers& step, Numbers& change) {
        const double product = dot(step, change, team_);
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

    // The direction of descent that belongs to a gradient.
    // @param samples  of all processes
    void find_direction(const Numbers& gradient, double samples, Numbers& d) const {
        multiply(gradient, 1, d);
        std::vector<double> along(pairs_.size());
        for (std::size_t i = pairs_.size(); i-- > 0;) {
            along[i] = dot(pairs_[i].step, d, team_) / pairs_[i].product;
            add(d, -along[i], pairs_[i].change);
        }
        const double scale = pairs_.empty()
                                 ? -first_step / std::max(std::sqrt(dot(gradient, gradient, team_) / samples), 1e-30)
                                 : -pairs_.back().product / dot(pairs_.back().change, pairs_.back().change, team_);
        multiply(d, scale, d);
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            add(d, -along[i] - dot(pairs_[i].change, d, team_) / pairs_[i].product, pairs_[i].step);
    }

  private:
    struct Pair {
        Numbers step, change;
        double product;
    };
    Team* team_;
    std::deque<Pair> pairs_;
};

// All rows, of which each process of a team has its own.
Numbers all_rows(Numbers own, std::size_t rows, Team* team) {
    if (team == nullptr) return own;
    const std::size_t columns = own.extent(1);
    Numbers all({rows, columns});
    std::ranges::copy(own.elements(), all.data() + core::own_lines(team, rows).first * columns);
    core::share_lines(*team, all.data(), columns,
                      [&](std::size_t process) { return core::lines_of(process, team->size(), rows, 1); });
    return all;
}

}  // namespace

// Descent on the phases φ for ε = 1 − C², with C the correlation of the field and of what an aperture for it lets
// through of e^{iφ}; the light that the aperture blocks is free. The objective is that of Chakravarthula, Peng, Kollin,
// Fuchs and Heide, Wirtinger holography, ACM TOG 38(6), 2019, in the field's own plane.
Array<float, 2> descend_phases(View<const Complex, 2> field, const FieldBand& band, const PatternOptions& options,
                               Convergence& convergence, const Progress& progress, Team* team) {
    PatternError error(band, field.shape(), team);
    const core::LineRange own = error.own_rows();
    const Shape<2> shape{own.count, field.extent(1)};
    Numbers phases(shape), gradient(shape), next(shape), next_gradient(shape), step(shape);
    core::parallel_for(own.count, [&](std::size_t y) {
        for (std::size_t x = 0; x < field.extent(1); ++x) phases(y, x) = std::arg(field(own.first + y, x));
    });
    const std::size_t limit = options.iterations > 0 ? options.iterations : max_descent_steps;
    double now = error.find(phases, gradient);
    std::vector<double> correlations{std::sqrt(1 - now)};
    Curvature curvature(team);
    for (std::size_t k = 0; k < limit; ++k) {
        progress.report(static_cast<double>(k) / static_cast<double>(limit));
        curvature.find_direction(gradient, static_cast<double>(field.size()), step);
        const double slope = dot(gradient, step, team);
        if (!(slope < 0)) break;
        double length = 1;
        const auto error_of_next = [&] {
            add(phases, length, step, next);
            return error.find(next, next_gradient);
        };
        double then = error_of_next();
        for (int i = 0; i < max_halvings && then > now + sufficient * length * slope; ++i) {
            length *= 0.5;
            then = error_of_next();
        }
        if (!(then < now)) break;
        // The step as it was rounded, and the change, in the place of what is no longer needed.
        add(next, -1, phases, step);
        add(next_gradient, -1, gradient, gradient);
        curvature.remember(step, gradient);
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
    return all_rows(std::move(phases), field.extent(0), team);
}

}  // namespace hogel::hologram::patterns
