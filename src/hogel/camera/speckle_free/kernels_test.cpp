// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "hogel/camera/dirichlet.h"
#include "hogel/camera/speckle_free/kernels.h"
#include "hogel/camera/speckle_free/tails.h"
#include "hogel/core/test_targets.h"

namespace hogel::camera::speckle_free {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(ExpectedKernels);

std::vector<float> noise(std::size_t count) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    std::vector<float> values(count);
    for (float& value : values) value = normal(random);
    return values;
}

// Hogels that fill vectors and that do not, bases with fewer and with more waves than a vector holds.
TEST_P(ExpectedKernels, vector_and_plain_sums_of_powers_agree) {
    for (const std::size_t n : {8, 16, 27, 32, 64})
        for (const double half_band : {0.3, 1.1, 4.2}) {
            const PsfBasis basis(n, half_band);
            const std::vector<float> powers = noise((n + 15) / 16 * 16 * n);
            std::vector<float> fast(basis.count() * basis.padded_count()), plain = fast;
            sum_powers(basis, basis.weights(3.3), basis.weights(-77.2), powers.data(), fast.data());
            sum_powers_plain(basis, basis.weights(3.3), basis.weights(-77.2), powers.data(), plain.data());
            float largest = 0;
            for (const float value : plain) largest = std::max(largest, std::abs(value));
            EXPECT_GT(largest, 1);
            for (std::size_t i = 0; i < fast.size(); ++i) ASSERT_NEAR(fast[i], plain[i], 1e-5f * largest) << n;
        }
}

TEST_P(ExpectedKernels, vector_and_plain_sums_of_products_agree) {
    const std::vector<float> values = noise(4000);
    const auto arrays = [&](std::size_t count, std::size_t step) {
        std::vector<const float*> all;
        for (std::size_t i = 0; i < count; ++i) all.push_back(values.data() + step * (i + 1));
        return all;
    };
    for (const std::size_t length : {1, 15, 64, 81, 333})
        for (std::size_t b_count = 1; b_count <= max_b_per_pass; ++b_count)
            for (std::size_t a_count = 1; a_count <= max_a_per_pass(b_count); ++a_count) {
                const auto a = arrays(a_count, 5), b = arrays(b_count, 17);
                const Lines lines{a, b, 340, 350, 7, length};
                std::vector<float> fast(a_count * b_count), plain(a_count * b_count);
                sum_products(lines, fast.data());
                sum_products_plain(lines, plain.data());
                for (std::size_t i = 0; i < fast.size(); ++i)
                    EXPECT_NEAR(fast[i], plain[i], 2e-3f) << length << " " << a_count << " " << b_count;
            }
}

TEST_P(ExpectedKernels, vector_and_plain_products_of_matrices_agree) {
    for (const std::size_t rows : {1, 8, 13, 30})
        for (const std::size_t inner : {1, 16, 45})
            for (const std::size_t width : {16, 48}) {
                Array<float, 2> weights({rows, inner + 3}), in({inner, width}), fast({rows, width}),
                    plain({rows, width});
                std::ranges::copy(noise(weights.size()), weights.data());
                std::ranges::copy(noise(in.size()), in.data());
                multiply(weights, in, fast);
                multiply_plain(weights, in, plain);
                for (std::size_t i = 0; i < fast.size(); ++i)
                    ASSERT_NEAR(fast.data()[i], plain.data()[i], 1e-4f) << rows << " " << inner << " " << width;
            }
}

// For pairs of points of the pupil, the product of the lights of any wave is that of its expansion in the basis.
TEST(PsfBasis, gives_the_products_of_all_waves) {
    for (const std::size_t n : {16, 32, 45})
        for (const double half_band : {0.2, 0.8, 1.1, 2.5}) {
            const PsfBasis basis(n, half_band);
            EXPECT_LT(basis.error(), 8e-3) << n << " " << half_band;
            double wrong = 0, all = 0;
            for (const double nu : {0.0, 0.25, -7.5}) {
                const PsfBasis::Weights weights = basis.weights(nu);
                for (std::size_t m = 0; m < n; ++m)
                    for (const double a : {-0.9, -0.2, 0.5})
                        for (const double b : {-0.6, 0.1, 1.0}) {
                            const auto light = [&](double y, double position) {
                                return dirichlet(y - position * half_band, n);
                            };
                            const double truth = light(double(m) + nu, a) * light(double(m) + nu, b);
                            double sum = 0;
                            for (std::size_t q = 0; q < basis.count(); ++q)
                                sum += double(weights.first[m * weights.stride + q]) * light(basis.node(q), a) *
                                       light(basis.node(q), b);
                            wrong += (sum - truth) * (sum - truth);
                            all += truth * truth;
                        }
            }
            EXPECT_LT(std::sqrt(wrong / all), 1e-2) << n << " " << half_band;
        }
}

TEST(SpreadTails, keeps_all_light_that_stays_on_the_hologram) {
    Array<float, 2> light({60, 50});
    light(30, 25) = 2;
    const Array<float, 2> spread = spread_tails(light, 4, 20);
    double sum = 0;
    for (const float value : spread.elements()) sum += value;
    EXPECT_NEAR(sum, 2, 1e-4);
    EXPECT_NEAR(spread(30, 29), 0, 1e-7);
    EXPECT_NEAR(spread(30, 35) / spread(30, 45), 8, 1e-2);
    EXPECT_NEAR(spread(30, 46), 0, 1e-7);
}

}  // namespace
}  // namespace hogel::camera::speckle_free
