// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/slepian_basis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/camera/dirichlet.h"
#include "hogel/camera/hogel_spectra/symmetric_matrix.h"
#include "hogel/math/quadrature.h"

namespace hogel::camera::hogel_spectra {
namespace {

using math::Quadrature;

using std::numbers::pi;

// Maximum, beyond either end of a hogel.
constexpr std::size_t max_beyond = 8;

// Least-squares fit of the real samples a(b) such that Σ_b a(b) cos 2πκx_b (or sin) is closest to f(κ) for |κ| ≤ κ_m.
class Fit {
  public:
    Fit(const Quadrature& quadrature, std::span<const double> positions, bool odd)
        : quadrature_(quadrature), waves_({quadrature.points.size(), positions.size()}) {
        Array<double, 2> normal({positions.size(), positions.size()});
        for (std::size_t i = 0; i < quadrature.points.size(); ++i) {
            for (std::size_t b = 0; b < positions.size(); ++b) {
                const double angle = 2 * pi * quadrature.points[i] * positions[b];
                waves_(i, b) = odd ? std::sin(angle) : std::cos(angle);
            }
            for (std::size_t a = 0; a < positions.size(); ++a)
                for (std::size_t b = 0; b < positions.size(); ++b)
                    normal(a, b) += quadrature.weights[i] * waves_(i, a) * waves_(i, b);
        }
        normal_ = eigensystem(std::move(normal));
    }

    std::vector<double> samples(std::span<const double> function) const {
        const std::size_t nodes = waves_.extent(1);
        std::vector<double> right(nodes), result(nodes);
        for (std::size_t i = 0; i < function.size(); ++i)
            for (std::size_t b = 0; b < nodes; ++b) right[b] += quadrature_.weights[i] * waves_(i, b) * function[i];
        for (std::size_t e = 0; e < nodes; ++e) {
            // Skips combinations of nodes that hardly send light into the pupil, so that no sample becomes large.
            if (normal_.values[e] < 1e-9 * normal_.values[0]) break;
            double along = 0;
            for (std::size_t b = 0; b < nodes; ++b) along += normal_.vectors(e, b) * right[b];
            for (std::size_t b = 0; b < nodes; ++b) result[b] += along / normal_.values[e] * normal_.vectors(e, b);
        }
        return result;
    }

    /// ∫ |Σ_b a(b) cos 2πκx_b − f(κ)|² dκ
    double error(std::span<const double> samples, std::span<const double> function) const {
        double sum = 0;
        for (std::size_t i = 0; i < function.size(); ++i) {
            double value = -function[i];
            for (std::size_t b = 0; b < samples.size(); ++b) value += samples[b] * waves_(i, b);
            sum += quadrature_.weights[i] * value * value;
        }
        return sum;
    }

  private:
    const Quadrature& quadrature_;
    Array<double, 2> waves_;  // [point][node]
    Eigensystem normal_;
};

// Returns the even (sign 1) or odd (sign −1) eigenfunctions of a kernel, times the roots of the weights. Each parity
// has its own eigensystem: the largest eigenvalues of a wide band are all 1 within rounding, and the full kernel's
// eigenvectors would mix parities there.
template <class Kernel>
Eigensystem prolate(const Quadrature& quadrature, double sign, const Kernel& kernel) {
    const std::size_t points = quadrature.points.size();
    Array<double, 2> values({points, points});
    for (std::size_t i = 0; i < points; ++i)
        for (std::size_t j = 0; j < points; ++j)
            values(i, j) = 0.5 * std::sqrt(quadrature.weights[i] * quadrature.weights[j]) *
                           (kernel(quadrature.points[i] - quadrature.points[j]) +
                            sign * kernel(quadrature.points[i] + quadrature.points[j]));
    return eigensystem(std::move(values));
}

}  // namespace

SlepianBasis::SlepianBasis(std::size_t samples, std::size_t nodes_per_hogel, double half_band, Window window,
                           std::size_t before, double tolerance)
    : samples_(samples), per_hogel_(nodes_per_hogel), window_(window) {
    const Quadrature quadrature =
        math::gauss_legendre(20 + static_cast<std::size_t>(std::ceil(6 * half_band)), half_band);
    const std::size_t points = quadrature.points.size();
    const auto kernel = [&](double y) { return square_at(y) / static_cast<double>(samples); };
    const Eigensystem even_functions = prolate(quadrature, 1, kernel), odd_functions = prolate(quadrature, -1, kernel);
    const auto of_parity = [&](std::size_t k) -> const Eigensystem& {
        return k % 2 == 0 ? even_functions : odd_functions;
    };
    const auto eigenvalue = [&](std::size_t k) { return std::max(of_parity(k).values[k / 2], 0.0); };
    // An eigenvalue is the power of random samples in its function.
    double power = 0, omitted = 0;
    for (std::size_t k = 0; k < points; ++k) {
        const double value = eigenvalue(k);
        power += value;
        if (value >= tolerance * tolerance * eigenvalue(0))
            functions_ = k + 1;
        else
            omitted += value;
    }
    Array<double, 2> functions({functions_, points});
    for (std::size_t k = 0; k < functions_; ++k)
        for (std::size_t i = 0; i < points; ++i)
            functions(k, i) = of_parity(k).vectors(k / 2, i) / std::sqrt(quadrature.weights[i]);

    double misfit = 0;
    for (before_ = before; before_ <= max_beyond; ++before_) {
        std::vector<double> positions;
        for (std::size_t b = 0; b < per_hogel_ + 2 * before_; ++b) positions.push_back(position(b));
        const Fit even(quadrature, positions, false), odd(quadrature, positions, true);
        spread_ = Array<float, 2>({positions.size(), functions_});
        misfit = 0;
        for (std::size_t k = 0; k < functions_; ++k) {
            const Fit& fit = k % 2 == 0 ? even : odd;
            const std::vector<double> node_samples = fit.samples(functions[k].elements());
            misfit += eigenvalue(k) * fit.error(node_samples, functions[k].elements());
            for (std::size_t b = 0; b < node_samples.size(); ++b)
                spread_(b, k) = static_cast<float>(node_samples[b] * static_cast<double>(per_hogel_) /
                                                   static_cast<double>(samples_));
        }
        if (misfit <= tolerance * tolerance * power || before_ == max_beyond) break;
    }
    error_ = std::sqrt((misfit + omitted) / power);
    tabulate(functions, quadrature.points, quadrature.weights);
}

// Window: ½ + ½ cos 2πx; its square: ⅜ + ½ cos 2πx + ⅛ cos 4πx. Each cosine shifts the kernel by its frequency.
double SlepianBasis::window_at(double y) const {
    const double middle = dirichlet(y, samples_);
    if (window_ == Window::none) return middle;
    return 0.5 * middle + 0.25 * (dirichlet(y - 1, samples_) + dirichlet(y + 1, samples_));
}

double SlepianBasis::square_at(double y) const {
    const double middle = dirichlet(y, samples_);
    if (window_ == Window::none) return middle;
    return 0.375 * middle + 0.25 * (dirichlet(y - 1, samples_) + dirichlet(y + 1, samples_)) +
           0.0625 * (dirichlet(y - 2, samples_) + dirichlet(y + 2, samples_));
}

void SlepianBasis::tabulate(View<const double, 2> functions, std::span<const double> points,
                            std::span<const double> quadrature_weights) {
    table_ = Array<float, 3>({fractions, functions_, 2 * samples_});
    Array<double, 2> weighted(functions.shape());
    for (std::size_t k = 0; k < functions_; ++k)
        for (std::size_t i = 0; i < points.size(); ++i) weighted(k, i) = quadrature_weights[i] * functions(k, i);
    // Frequencies n apart have the same weights, or opposite ones for even n.
    const float mirrored = samples_ % 2 == 0 ? -1.0f : 1.0f;
    std::vector<double> sums(functions_);
    for (std::size_t fraction = 0; fraction < fractions; ++fraction)
        for (std::size_t m = 0; m < samples_; ++m) {
            const double y = static_cast<double>(m) + static_cast<double>(fraction) / static_cast<double>(fractions);
            std::ranges::fill(sums, 0.0);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const double value = window_at(y - points[i]);
                for (std::size_t k = 0; k < functions_; ++k) sums[k] += weighted(k, i) * value;
            }
            for (std::size_t k = 0; k < functions_; ++k) {
                table_(fraction, k, m) = static_cast<float>(sums[k]);
                table_(fraction, k, samples_ + m) = mirrored * table_(fraction, k, m);
            }
        }
    folded_ = Array<float, 3>({fractions, samples_ / 2 + 1, functions_});
    for (std::size_t fraction = 0; fraction < fractions; ++fraction)
        for (std::size_t i = 0; i <= samples_ / 2; ++i)
            for (std::size_t k = 0; k < functions_; ++k) folded_(fraction, i, k) = table_(fraction, k, i);
    make_pairs();
    make_carriers();
}

// Positions are odd multiples of half a node spacing, so carriers are periodic in ν.
void SlepianBasis::make_carriers() {
    carriers_ = Array<float, 3>({2 * fractions * per_hogel_, 2, padded(nodes())});
    for (std::size_t step = 0; step < carriers_.extent(0); ++step)
        for (std::size_t node = 0; node < nodes(); ++node) {
            const double cycles = static_cast<double>(step) / static_cast<double>(fractions) * position(node);
            const double angle = -2 * pi * (cycles - std::round(cycles));
            carriers_(step, 0, node) = static_cast<float>(std::cos(angle));
            carriers_(step, 1, node) = static_cast<float>(std::sin(angle));
        }
}

void SlepianBasis::make_pairs() {
    const std::size_t n = samples_;
    const bool opposite = n % 2 == 0;  // for frequencies n apart
    for (std::size_t fraction = 0; fraction < fractions; ++fraction)
        for (std::size_t begin = 0; begin < n; ++begin) {
            // The wave m with i = m + begin, modulo n.
            const auto wave = [&](std::size_t i) {
                return static_cast<std::uint32_t>(i < begin ? i + n - begin : i - begin);
            };
            const auto sign = [&](bool negative) { return negative ? -0.0f : 0.0f; };
            std::vector<SymmetricPair> unpaired;
            for (std::size_t i = 0; 2 * i + fraction <= n; ++i) {
                const std::size_t mirrored = n - i - fraction;  // of n − y
                const bool negative = opposite && i < begin;
                SymmetricPair pair{wave(i), wave(i), sign(negative), 0, &folded_(fraction, i, 0)};
                if (mirrored == i || mirrored == n) {
                    unpaired.push_back(pair);
                } else {
                    pair.second = wave(mirrored);
                    pair.sign_second = sign((opposite && mirrored < begin) != opposite);
                    pairs_[fraction].push_back(pair);
                }
            }
            unpaired_[fraction] = unpaired.size();
            if (begin == 0) count_[fraction] = pairs_[fraction].size() + unpaired.size();
            pairs_[fraction].insert(pairs_[fraction].end(), unpaired.begin(), unpaired.end());
        }
}

SlepianBasis::Weights SlepianBasis::weights(double frequency) const {
    // Integers of at most some thousands.
    const auto floored = [](std::int32_t a, std::int32_t b) { return (a < 0 ? a - b + 1 : a) / b; };
    const auto n = static_cast<std::int32_t>(samples_);
    constexpr auto parts = static_cast<std::int32_t>(fractions);
    const auto steps = static_cast<std::int32_t>(std::floor(frequency * parts + 0.5));
    const std::int32_t integer = floored(steps, parts), periods = floored(integer, n);
    const auto fraction = static_cast<std::size_t>(steps - integer * parts);
    const auto first = static_cast<std::size_t>(integer - periods * n);
    const bool opposite = samples_ % 2 == 0 && periods % 2 != 0;
    const std::size_t count = count_[fraction];
    const auto period = static_cast<std::int32_t>(carriers_.extent(0));
    return {static_cast<double>(steps) / parts,
            opposite ? -1.0f : 1.0f,
            &table_(fraction, 0, first),
            2 * samples_,
            std::span(pairs_[fraction]).subspan(first * count, count),
            unpaired_[fraction],
            &carriers_(static_cast<std::size_t>(steps - floored(steps, period) * period), 0, 0)};
}

}  // namespace hogel::camera::hogel_spectra
