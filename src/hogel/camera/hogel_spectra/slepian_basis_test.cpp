// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/slepian_basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "hogel/camera/hogel_spectra/symmetric_matrix.h"
#include "hogel/core/random.h"

namespace hogel::camera::hogel_spectra {
namespace {

using Complex = std::complex<double>;

Complex phasor(double cycles) { return std::polar(1.0, 2 * std::numbers::pi * cycles); }

TEST(Eigensystem, makes_the_matrix_again) {
    const std::size_t n = 9;
    Array<double, 2> matrix({n, n});
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            matrix(i, j) = std::cos(static_cast<double>(i * j)) + (i == j ? static_cast<double>(i) : 0.0);
    const Eigensystem system = eigensystem(matrix);
    for (std::size_t k = 1; k < n; ++k) EXPECT_GE(system.values[k - 1], system.values[k]);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < n; ++k) sum += system.values[k] * system.vectors(k, i) * system.vectors(k, j);
            EXPECT_NEAR(sum, matrix(i, j), 1e-12);
        }
}

// Light of a wave of a hogel in the pupil, and light of the band's samples that represent it.
struct Case {
    std::size_t samples, per_hogel;
    double half_band;
};

class HogelBasisOfSize : public testing::TestWithParam<Case> {};

TEST_P(HogelBasisOfSize, sends_the_light_of_the_samples_into_the_pupil) {
    const auto [n, per_hogel, half_band] = GetParam();
    const SlepianBasis basis(n, per_hogel, half_band);
    EXPECT_LT(basis.error(), 1e-3);
    const double c = 0.5 * static_cast<double>(n - 1);
    double wrong = 0, all = 0;
    for (double frequency : {0.0, 0.3, -0.77, 5.1, -40.6, 71.25})
        for (std::size_t m = 0; m < n; ++m) {
            const SlepianBasis::Weights weights = basis.weights(frequency);
            EXPECT_NEAR(weights.frequency, frequency, 0.5 / SlepianBasis::fractions + 1e-12);
            for (int i = -8; i <= 8; ++i) {
                const double kappa = half_band * i / 8;
                Complex direct = 0, spread = 0;
                for (std::size_t j = 0; j < n; ++j)
                    direct += phasor((static_cast<double>(m) + weights.frequency - kappa) *
                                     (static_cast<double>(j) - c) / static_cast<double>(n));
                for (std::size_t b = 0; b < basis.nodes(); ++b) {
                    Complex sample = 0;
                    for (std::size_t k = 0; k < basis.functions(); ++k) {
                        const Complex turn = k % 2 == 0 ? Complex(1) : Complex(0, 1);
                        sample += turn * double(weights.sign) * double(weights.first[k * weights.stride + m]) *
                                  double(basis.spread()(b, k));
                    }
                    spread += sample * phasor(-kappa * basis.position(b));
                }
                // A sample of the band represents n / per_hogel samples of the hogel.
                spread *= static_cast<double>(n) / static_cast<double>(per_hogel);
                wrong += std::norm(spread - direct);
                all += std::norm(direct);
            }
        }
    EXPECT_LT(std::sqrt(wrong / all), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(, HogelBasisOfSize,
                         testing::Values(Case{32, 5, 1.1}, Case{32, 4, 0.9}, Case{16, 1, 0.2}, Case{64, 18, 4.0},
                                         Case{27, 3, 0.7}, Case{128, 9, 2.2}, Case{8, 2, 0.45}, Case{48, 22, 6.5},
                                         Case{64, 24, 7.4}));

// Every wave is in exactly one pair, with the weights of the table up to the sign.
TEST(SlepianBasis, pairs_waves_of_equal_weights) {
    for (const std::size_t n : {16, 27}) {
        const SlepianBasis basis(n, 4, 0.9);
        for (double frequency = -33.5; frequency < 70; frequency += 0.5) {
            const SlepianBasis::Weights weights = basis.weights(frequency);
            std::vector<int> seen(n);
            const auto check = [&](std::uint32_t m, float sign, const float* own, bool mirrored) {
                ++seen.at(m);
                for (std::size_t k = 0; k < basis.functions(); ++k) {
                    const float factor = std::copysign(1.0f, sign) * (mirrored && k % 2 != 0 ? -1.0f : 1.0f);
                    ASSERT_NEAR(factor * own[k], weights.first[k * weights.stride + m], 2e-5f)
                        << n << ' ' << frequency << ' ' << m << ' ' << k;
                }
            };
            const std::size_t two = weights.pairs.size() - weights.unpaired;
            for (std::size_t i = 0; i < weights.pairs.size(); ++i) {
                const SlepianBasis::SymmetricPair& pair = weights.pairs[i];
                check(pair.first, pair.sign_first, pair.weights, false);
                if (i < two) check(pair.second, pair.sign_second, pair.weights, true);
            }
            for (int times : seen) EXPECT_EQ(times, 1);
        }
    }
}

TEST(SlepianBasis, needs_few_functions) {
    // Hardly more than the time-bandwidth product, 2.2 here.
    EXPECT_LE(SlepianBasis(32, 5, 1.1).functions(), 7u);
    EXPECT_LE(SlepianBasis(32, 5, 1.1).nodes(), 11u);
    EXPECT_LE(SlepianBasis(64, 1, 0.1).functions(), 4u);
}

// The carrier of a frequency is e^{−2πiνx} at the positions of the nodes, however large the frequency is.
TEST(SlepianBasis, has_carriers_that_are_waves_of_their_frequency) {
    for (const std::size_t per_hogel : {1, 4, 5}) {
        const SlepianBasis basis(32, per_hogel, 0.2 * static_cast<double>(per_hogel));
        for (const double frequency : {0.0, 0.5, -0.5, 3.5, -77.0, 1000.5}) {
            const SlepianBasis::Weights weights = basis.weights(frequency);
            for (std::size_t node = 0; node < basis.nodes(); ++node) {
                const double angle = -2 * std::numbers::pi * frequency * basis.position(node);
                EXPECT_NEAR(weights.carrier[node], std::cos(angle), 1e-6) << frequency << " " << node;
                EXPECT_NEAR(weights.carrier[padded(basis.nodes()) + node], std::sin(angle), 1e-6) << frequency;
            }
        }
    }
}

}  // namespace
}  // namespace hogel::camera::hogel_spectra
