// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/symmetric_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hogel::camera::hogel_spectra {

Eigensystem eigensystem(Array<double, 2> matrix) {
    const std::size_t n = matrix.extent(0);
    Array<double, 2> vectors({n, n});
    for (std::size_t i = 0; i < n; ++i) vectors(i, i) = 1;
    const auto off_diagonal = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < i; ++j) sum += matrix(i, j) * matrix(i, j);
        return sum;
    };
    double norm = 0;
    for (double value : matrix.elements()) norm += value * value;
    for (int sweep = 0; sweep < 40 && off_diagonal() > 1e-30 * norm; ++sweep)
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                if (matrix(p, q) == 0) continue;
                // The rotation by the angle of tangent t makes (p, q) zero.
                const double theta = (matrix(q, q) - matrix(p, p)) / (2 * matrix(p, q));
                const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
                const double c = 1 / std::hypot(t, 1.0), s = t * c;
                const auto rotate = [&](double& a, double& b) {
                    const double old = a;
                    a = c * old - s * b;
                    b = s * old + c * b;
                };
                for (std::size_t i = 0; i < n; ++i) rotate(matrix(i, p), matrix(i, q));
                for (std::size_t i = 0; i < n; ++i) rotate(matrix(p, i), matrix(q, i));
                for (std::size_t i = 0; i < n; ++i) rotate(vectors(p, i), vectors(q, i));
            }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return matrix(a, a) > matrix(b, b); });
    Eigensystem result{{}, Array<double, 2>({n, n})};
    for (std::size_t i = 0; i < n; ++i) {
        result.values.push_back(matrix(order[i], order[i]));
        std::ranges::copy(vectors[order[i]].elements(), &result.vectors(i, 0));
    }
    return result;
}

}  // namespace hogel::camera::hogel_spectra
