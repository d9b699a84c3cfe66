// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/speckle_free/psf_basis.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hogel/camera/dirichlet.h"
#include "hogel/core/stop_scope.h"
#include "hogel/math/quadrature.h"
#include "hogel/work/parallel.h"

namespace hogel::camera::speckle_free {
namespace {

// Relative increase of the diagonal, because waves that are close together have nearly equal PSFs.
constexpr double damping = 1e-8;

// Returns the frequencies y_q: half a cycle apart up to half a cycle beyond the pupil, then two more on either side for
// all farther waves. If hogels have too few samples for these, half a cycle apart throughout.
std::vector<double> choose_nodes(std::size_t samples, double half_band) {
    const double steps = std::floor((half_band + 0.5) / 0.5 + 1e-9), last = 0.5 * steps;
    const double end = 0.5 * static_cast<double>(samples);
    std::vector<double> nodes;
    if (last + 2 > end) {
        for (double y = -end; y < end; y += 0.5) nodes.push_back(y);
        return nodes;
    }
    for (double y = -last; y <= last; y += 0.5) nodes.push_back(y);
    for (double beyond : {0.7, 1.6}) {
        nodes.push_back(last + beyond);
        nodes.push_back(-last - beyond);
    }
    std::ranges::sort(nodes);
    return nodes;
}

class Cholesky {
  public:
    explicit Cholesky(Array<double, 2> matrix) : lower_(std::move(matrix)) {
        for (std::size_t i = 0; i < lower_.extent(0); ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = lower_(i, j);
                for (std::size_t k = 0; k < j; ++k) sum -= lower_(i, k) * lower_(j, k);
                lower_(i, j) = i == j ? std::sqrt(sum) : sum / lower_(j, j);
            }
    }
    void solve(std::vector<double>& x) const {
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) x[i] -= lower_(i, k) * x[k];
            x[i] /= lower_(i, i);
        }
        for (std::size_t i = x.size(); i-- > 0;) {
            for (std::size_t k = i + 1; k < x.size(); ++k) x[i] -= lower_(k, i) * x[k];
            x[i] /= lower_(i, i);
        }
    }

  private:
    Array<double, 2> lower_;
};

}  // namespace

PsfNodes::PsfNodes(std::size_t samples, double half_band)
    : samples_(samples), half_band_(half_band), nodes_(choose_nodes(samples, half_band)) {}

std::size_t PsfNodes::points() const { return 20 + static_cast<std::size_t>(std::ceil(6 * half_band_)); }

double PsfNodes::products() const {
    const auto n = static_cast<double>(count());
    return static_cast<double>(PsfBasis::fractions * samples_) * (static_cast<double>(points()) * n + n * n);
}

PsfBasis::PsfBasis(std::size_t samples, double half_band) : PsfNodes(samples, half_band) {
    const math::Quadrature pupil = math::gauss_legendre(PsfNodes::points(), half_band);
    const std::size_t points = pupil.points.size(), count = this->count();
    const auto light = [&](double y) {
        std::vector<double> values(points);
        for (std::size_t i = 0; i < points; ++i)
            values[i] = std::sqrt(pupil.weights[i]) * dirichlet(y - pupil.points[i], samples);
        return values;
    };
    const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum * sum;
    };
    std::vector<std::vector<double>> lights;
    std::vector<double> norms;
    for (std::size_t q = 0; q < count; ++q) {
        lights.push_back(light(node(q)));
        norms.push_back(std::sqrt(product(lights.back(), lights.back())));
    }
    Array<double, 2> normal({count, count});
    for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b)
            normal(a, b) = product(lights[a], lights[b]) / (norms[a] * norms[b]) + (a == b ? damping : 0);
    const Cholesky equations(std::move(normal));

    table_ = Array<float, 3>({fractions, 2 * samples, padded_count()});
    std::vector<double> residuals(fractions), squares(fractions);
    work::parallel_for(fractions, [&](std::size_t fraction) {
        std::vector<double> b(count), projections(count);
        for (std::size_t m = 0; m < samples; ++m) {
            if (m % 64 == 0) core::throw_if_stopped();
            const std::vector<double> amplitudes =
                light(static_cast<double>(m) + static_cast<double>(fraction) / static_cast<double>(fractions));
            for (std::size_t q = 0; q < count; ++q) b[q] = projections[q] = product(amplitudes, lights[q]) / norms[q];
            equations.solve(b);
            const double square = product(amplitudes, amplitudes);
            double residual = square;
            for (std::size_t q = 0; q < count; ++q) residual -= b[q] * projections[q];
            residuals[fraction] += std::max(residual, 0.0);
            squares[fraction] += square;
            for (std::size_t q = 0; q < count; ++q)
                table_(fraction, m, q) = table_(fraction, samples + m, q) = static_cast<float>(b[q] / norms[q]);
        }
    });
    error_ = std::sqrt(std::reduce(residuals.begin(), residuals.end()) / std::reduce(squares.begin(), squares.end()));
}

PsfBasis::Weights PsfBasis::weights(double frequency) const {
    const std::size_t samples = this->samples();
    const auto n = static_cast<double>(samples);
    const double steps = std::round((frequency - n * std::floor(frequency / n)) * static_cast<double>(fractions));
    const auto integer = static_cast<std::size_t>(steps) / fractions % samples,
               fraction = static_cast<std::size_t>(steps) % fractions;
    return {&table_(fraction, integer, 0), padded_count()};
}

}  // namespace hogel::camera::speckle_free
