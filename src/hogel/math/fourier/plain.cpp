// SPDX-License-Identifier: Apache-2.0
#include "hogel/math/fourier/plain.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace hogel::math::fourier {
namespace {

// e^{-2πi numerator/denominator}
template <class Real>
std::complex<Real> root(std::size_t numerator, std::size_t denominator) {
    const double angle =
        -2 * std::numbers::pi * static_cast<double>(numerator % denominator) / static_cast<double>(denominator);
    return {static_cast<Real>(std::cos(angle)), static_cast<Real>(std::sin(angle))};
}

std::size_t smallest_factor(std::size_t n) {
    for (const std::size_t prime : {2, 3, 5, 7, 11, 13})
        if (n % prime == 0) return prime;
    return n;
}

template <class Real>
using Line = std::vector<std::complex<Real>>;

template <class Real>
Line<Real> transformed(const Line<Real>& x);

// Bluestein: jk = (j² + k² − (k−j)²)/2, so with c_j = e^{-πi j²/n}
//   X_k = c_k Σ_j (x_j c_j) conj(c_{k−j}).
// Transforms of a power of two m ≥ 2n − 1 compute this convolution.
template <class Real>
Line<Real> by_convolution(const Line<Real>& x) {
    const std::size_t n = x.size(), m = std::bit_ceil(2 * n - 1);
    Line<Real> a(m), b(m);
    const auto c = [n](std::size_t j) { return root<Real>(j * j % (2 * n), 2 * n); };
    for (std::size_t j = 0; j < n; ++j) {
        a[j] = x[j] * c(j);
        b[j] = b[(m - j) % m] = std::conj(c(j));
    }
    a = transformed(a);
    b = transformed(b);
    // The backward transform of z is conj of the forward transform of conj(z).
    for (std::size_t k = 0; k < m; ++k) a[k] = std::conj(a[k] * b[k]);
    a = transformed(a);
    Line<Real> result(n);
    for (std::size_t k = 0; k < n; ++k) result[k] = c(k) * std::conj(a[k]) / static_cast<Real>(m);
    return result;
}

// Decimation in time: with n = r·m, j = r·i + s and k = l + m·t,
//   X_{l+mt} = Σ_s w_r^{st} w_n^{sl} Σ_i x_{ri+s} w_m^{il}.
template <class Real>
Line<Real> transformed(const Line<Real>& x) {
    const std::size_t n = x.size(), r = smallest_factor(n), m = n / r;
    if (n == 1) return x;
    if (r > 13) return by_convolution(x);
    Line<Real> result(n), part(m);
    std::vector<Line<Real>> parts;
    for (std::size_t s = 0; s < r; ++s) {
        for (std::size_t i = 0; i < m; ++i) part[i] = x[r * i + s];
        parts.push_back(transformed(part));
        for (std::size_t l = 0; l < m; ++l) parts[s][l] *= root<Real>(s * l, n);
    }
    for (std::size_t t = 0; t < r; ++t)
        for (std::size_t s = 0; s < r; ++s) {
            const std::complex<Real> w = root<Real>(s * t, r);
            for (std::size_t l = 0; l < m; ++l) result[l + m * t] += w * parts[s][l];
        }
    return result;
}

template <class Real>
void transform(std::span<std::complex<Real>> values) {
    const Line<Real> result = transformed(Line<Real>(values.begin(), values.end()));
    std::copy(result.begin(), result.end(), values.begin());
}

}  // namespace

void transform_plain(std::span<std::complex<float>> values) { transform(values); }
void transform_plain_double(std::span<std::complex<double>> values) { transform(values); }

}  // namespace hogel::math::fourier
