// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/interpolation.h"

#include <numbers>

#include "hogel/math/bessel.h"

namespace hogel::camera::film {
namespace {

template <std::size_t taps>
std::array<double, taps> kaiser_weights(double z) {
    constexpr double beta = 5, half_width = 0.5 * taps;
    std::array<double, taps> weights;
    double sum = 0;
    for (std::size_t k = 0; k < taps; ++k) {
        const double distance = z - (static_cast<double>(k) - half_width + 0.5);
        const double relative = distance / half_width, angle = std::numbers::pi * distance;
        const double sinc = std::abs(angle) < 1e-9 ? 1 : std::sin(angle) / angle;
        weights[k] = sinc * math::bessel_i0(beta * std::sqrt(std::max(0.0, 1 - relative * relative)));
        sum += weights[k];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

}  // namespace

template <std::size_t count>
KaiserPoints<count>::KaiserPoints() {
    // Polynomials through as many Chebyshev points as terms, by Newton's divided differences, multiplied out.
    std::array<double, terms> point;
    for (std::size_t i = 0; i < terms; ++i)
        point[i] = 0.5 * std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / terms);
    std::array<std::array<double, taps>, terms> difference;
    for (std::size_t i = 0; i < terms; ++i) difference[i] = kaiser_weights<taps>(point[i]);
    for (std::size_t order = 1; order < terms; ++order)
        for (std::size_t i = terms; i-- > order;)
            for (std::size_t k = 0; k < taps; ++k)
                difference[i][k] = (difference[i][k] - difference[i - 1][k]) / (point[i] - point[i - order]);
    for (std::size_t k = 0; k < taps; ++k) {
        std::array<double, terms> sum{}, product{1};
        for (std::size_t i = 0; i < terms; ++i) {
            for (std::size_t p = 0; p <= i; ++p) sum[p] += difference[i][k] * product[p];
            // product · (z − point)
            for (std::size_t p = std::min(i + 2, terms); p-- > 0;)
                product[p] = (p > 0 ? product[p - 1] : 0) - point[i] * product[p];
        }
        for (std::size_t p = 0; p < terms; ++p) coefficients_[p][k] = static_cast<float>(sum[p]);
    }
}

template <std::size_t count>
const KaiserPoints<count>& KaiserPoints<count>::table() {
    static const KaiserPoints table;
    return table;
}

template class KaiserPoints<6>;
template class KaiserPoints<12>;

}  // namespace hogel::camera::film
