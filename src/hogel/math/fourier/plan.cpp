// SPDX-License-Identifier: Apache-2.0
#include "hogel/math/fourier/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hogel/math/fourier/plain.h"

namespace hogel::math::fourier {
namespace {

// Returns the radices of a length in the order of the passes. Large radices save passes.
std::vector<std::size_t> radices_of(std::size_t length) {
    std::vector<std::size_t> result;
    for (const std::size_t prime : {13, 11, 7, 5, 3})
        for (; length % prime == 0; length /= prime) result.push_back(prime);
    // 16 and 2 (beside another factor of 8) are faster as 4·4.
    std::size_t twos = 0;
    for (; length % 2 == 0; length /= 2) ++twos;
    std::size_t fours = twos % 3 == 2 ? 1 : twos % 3 == 1 && twos >= 4 ? 2 : 0;
    for (std::size_t i = 0; i < (twos - 2 * fours) / 3; ++i) result.push_back(8);
    if (twos == 1) result.push_back(2);
    for (std::size_t i = 0; i < fours; ++i) result.push_back(4);
    return result;
}

}  // namespace

bool is_smooth(std::size_t length) {
    for (const std::size_t prime : {2, 3, 5, 7, 11, 13})
        while (length % prime == 0) length /= prime;
    return length == 1;
}

std::size_t convolution_length(std::size_t n) {
    const std::size_t step = n > 512 ? 64 : n > 64 ? 8 : 4;
    for (std::size_t m = (n + step - 1) / step * step;; m += step) {
        std::size_t rest = m;
        for (const std::size_t prime : {2, 3, 5})
            while (rest % prime == 0) rest /= prime;
        if (rest == 1) return m;
    }
}

std::complex<float> root_of_unity(std::size_t numerator, std::size_t denominator) {
    const double angle =
        -2 * std::numbers::pi * static_cast<double>(numerator % denominator) / static_cast<double>(denominator);
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

Plan::Plan(std::size_t n) : length(n), frequency{0}, position(n) {
    const std::vector<std::size_t> radices = radices_of(n);
    std::size_t rest = n;
    for (const std::size_t radix : radices) {
        passes.push_back({radix, rest, factors.size()});
        for (std::size_t j = 0; j < rest / radix; ++j)
            for (std::size_t k = 1; k < radix; ++k) {
                const std::complex<float> w = root_of_unity(j * k, rest);
                factors.push_back(w.real());
                factors.push_back(w.imag());
            }
        rest /= radix;
    }
    // Each pass orders frequencies by their remainder modulo its radix: frequency f of part k is frequency k + radix ·
    // f.
    for (auto radix = radices.rbegin(); radix != radices.rend(); ++radix) {
        std::vector<std::uint32_t> order;
        for (std::size_t k = 0; k < *radix; ++k)
            for (const std::uint32_t f : frequency) order.push_back(static_cast<std::uint32_t>(k + *radix * f));
        frequency = std::move(order);
    }
    for (std::size_t i = 0; i < n; ++i) position[frequency[i]] = static_cast<std::uint32_t>(i);
}

Chirp::Chirp(std::size_t n, std::size_t m) : chirp(2 * n), spectrum(2 * m) {
    std::vector<std::complex<double>> conjugate(m);
    for (std::size_t j = 0; j < n; ++j) {
        // j² modulo the period 2n keeps the angle exact.
        const double angle = std::numbers::pi * static_cast<double>(j * j % (2 * n)) / static_cast<double>(n);
        const std::complex<double> c = std::polar(1.0, angle);
        chirp[2 * j] = static_cast<float>(c.real());
        chirp[2 * j + 1] = static_cast<float>(-c.imag());
        conjugate[j] = c;
        if (j > 0) conjugate[m - j] = c;
    }
    transform_plain_double(conjugate);
    for (std::size_t k = 0; k < m; ++k) {
        spectrum[2 * k] = static_cast<float>(conjugate[k].real() / static_cast<double>(m));
        spectrum[2 * k + 1] = static_cast<float>(conjugate[k].imag() / static_cast<double>(m));
    }
}

namespace {

// Returns the factor of a smooth length for which the transforms of both factors waste the fewest lanes.
std::size_t rows_of(std::size_t length) {
    std::size_t best = 1;
    double best_cost = std::numeric_limits<double>::max();
    for (std::size_t down = 1; down * down <= length; ++down) {
        if (length % down != 0) continue;
        const std::size_t across = length / down;
        const auto waste = [](std::size_t lanes) {
            const std::size_t groups = (lanes + batch_lines - 1) / batch_lines;
            return static_cast<double>(groups * batch_lines) / static_cast<double>(lanes);
        };
        const double longest = static_cast<double>(std::max(down, across));
        const double uneven = longest * longest / static_cast<double>(length);
        const double cost = waste(across) + waste(down) + 0.05 * uneven;
        if (cost < best_cost) best_cost = cost, best = down;
    }
    return best;
}

}  // namespace

Split::Split(std::size_t length) : down(rows_of(length)), across(length / down.length) {
    twiddles.resize(down.length * blocks_across() * split_row);
    for (std::size_t p = 0; p < down.length; ++p)
        for (std::size_t b = 0; b < across.length; ++b) {
            const std::complex<float> w = root_of_unity(p * b, length);
            float* twiddle = twiddles.data() + (p * blocks_across() + b / batch_lines) * split_row + b % batch_lines;
            twiddle[0] = w.real();
            twiddle[batch_lines] = w.imag();
        }
}

}  // namespace hogel::math::fourier
