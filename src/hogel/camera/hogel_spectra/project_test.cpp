// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/project.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/stereogram/hogel_synthesis.h"

namespace hogel::camera::hogel_spectra {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(EyeProjection);

// Sides of hogels that fill vectors and that do not, bands with more functions and nodes than a vector holds.
TEST_P(EyeProjection, vector_and_plain_projection_agree) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    struct Size {
        std::size_t samples, per_hogel;
        double half_band;
    };
    for (const Size& size :
         {Size{16, 1, 0.2}, Size{32, 5, 1.1}, Size{27, 4, 0.9}, Size{64, 24, 5.2}, Size{40, 14, 3.1}}) {
        const SlepianBasis basis(size.samples, size.per_hogel, size.half_band);
        // As many rows as columns, and fewer.
        for (const std::size_t rows : {size.samples, size.samples / 5}) {
            const SlepianBasis down(rows, size.per_hogel, size.half_band, SlepianBasis::Window::none, basis.before());
            if (down.before() != basis.before()) continue;
            const std::size_t n = size.samples, row = padded(basis.nodes()) + lanes;
            Array<float, 1> waves({stereogram::HogelWaves::size(rows, n)});
            for (std::size_t y = 0; y < rows; ++y)
                for (std::size_t column = 0; column < n; ++column)
                    for (std::size_t part : {0, 1})
                        waves((y / 16 * n + column) * 32 + part * 16 + y % 16) = normal(random);
            const HogelView view{basis.weights(3.3), down.weights(-77.2)};
            // A line with light of other hogels, from an unaligned node on.
            Array<float, 3> fast({down.functions(), 2, row}, 1.0f), plain(fast.shape(), 1.0f);
            project({basis, down}, view, waves.data(), {&fast(0, 0, 3), row});
            project_plain({basis, down}, view, waves.data(), {&plain(0, 0, 3), row});
            float largest = 0;
            for (const float value : plain.elements()) largest = std::max(largest, std::abs(value));
            EXPECT_GT(largest, 1.5f);
            // Sums over n × n waves in another order: their rounding grows with n.
            const float rounding = 5e-6f * std::sqrt(static_cast<float>(n));
            for (std::size_t i = 0; i < fast.size(); ++i)
                ASSERT_NEAR(fast.data()[i], plain.data()[i], rounding * largest) << n << " " << rows << " " << i;
        }
    }
}

TEST_P(EyeProjection, vector_and_plain_phases_agree) {
    std::mt19937 random(6);
    std::normal_distribution<float> normal;
    for (const auto& [rows, n] : std::vector<std::array<std::size_t, 2>>{{8, 8}, {27, 27}, {32, 32}, {5, 40}}) {
        Array<float, 1> fast({stereogram::HogelWaves::size(rows, n)});
        for (float& value : fast.elements()) value = normal(random);
        Array<float, 1> plain({fast.size()});
        std::ranges::copy(fast.elements(), plain.data());
        const MiddlePhases middle(rows, n);
        middle.apply(fast.data());
        middle.apply_plain(plain.data());
        for (std::size_t i = 0; i < fast.size(); ++i) ASSERT_NEAR(fast(i), plain(i), 1e-6f) << n << " " << i;
    }
}

}  // namespace
}  // namespace hogel::camera::hogel_spectra
