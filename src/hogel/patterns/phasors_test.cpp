// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/phasors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "hogel/core/test_targets.h"

namespace hogel::patterns {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(Phasors);

using Samples = std::vector<std::complex<float>>;

// Samples in the unit disc, some on its edge, on the axes and at 0.
Samples disc() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    Samples samples{0, 1, -1, {0, 1}, {0, -1}, {0.5f, 0.5f}, {-0.5f, -0.5f}, {1e-9f, -1e-9f}, {0.3f, -1e-9f}};
    while (samples.size() < 90) samples.push_back(std::polar(std::abs(uniform(random)), 4 * uniform(random)));
    return samples;
}

void expect_same_phases(const std::vector<float>& fast, const std::vector<float>& plain, float tolerance) {
    for (std::size_t x = 0; x < plain.size(); ++x) {
        EXPECT_GE(fast[x], 0) << plain.size() << " " << x;
        EXPECT_LE(fast[x], 1) << plain.size() << " " << x;
        EXPECT_LT(std::abs(std::remainder(fast[x] - plain[x], 1.0f)), tolerance) << plain.size() << " " << x;
    }
}

TEST_P(Phasors, vector_and_plain_phases_agree) {
    const Samples field = disc();
    for (std::size_t count = 0; count < field.size(); ++count) {
        std::vector<float> fast(count), plain(count);
        phases_of(&field[1], fast);
        phases_of_plain(&field[1], plain);
        expect_same_phases(fast, plain, 1e-6f);
    }
}

TEST_P(Phasors, vector_and_plain_double_phases_agree) {
    const Samples field = disc();
    for (const float sign : {1.0f, -1.0f})
        for (std::size_t count = 0; count < field.size(); ++count) {
            std::vector<float> fast(count), plain(count);
            double_phases(&field[1], sign, fast);
            double_phases_plain(&field[1], sign, plain);
            // acos magnifies the rounding of a modulus near 1.
            expect_same_phases(fast, plain, 2e-4f);
            for (std::size_t x = 0; x < count; ++x)
                if (std::abs(field[x + 1]) < 0.99f) {
                    EXPECT_LT(std::abs(std::remainder(fast[x] - plain[x], 1.0f)), 1e-6f) << count << " " << x;
                }
        }
}

TEST_P(Phasors, vector_and_plain_phasors_agree) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> uniform(-1000, 1000);
    std::vector<float> phases{0, 1, -1, 3.1415926f, -3.1415926f, 1.5707963f, 1000};
    while (phases.size() < 90) phases.push_back(uniform(random));
    for (std::size_t count = 0; count < phases.size(); ++count) {
        Samples fast(count), plain(count);
        phasors(&phases[1], fast);
        phasors_plain(&phases[1], plain);
        for (std::size_t x = 0; x < count; ++x) EXPECT_LT(std::abs(fast[x] - plain[x]), 1e-6f) << phases[x + 1];
    }
}

TEST_P(Phasors, vector_and_plain_moduli_agree) {
    const Samples field = disc();
    std::vector<float> moduli(field.size());
    for (std::size_t x = 0; x < moduli.size(); ++x) moduli[x] = static_cast<float>(x % 7);
    for (std::size_t count = 0; count <= field.size(); ++count) {
        const auto end = field.begin() + static_cast<std::ptrdiff_t>(count);
        Samples fast(field.begin(), end), plain(field.begin(), end);
        set_moduli(moduli.data(), fast);
        set_moduli_plain(moduli.data(), plain);
        for (std::size_t x = 0; x < count; ++x) EXPECT_LE(std::abs(fast[x] - plain[x]), 1e-6f * moduli[x]) << x;
    }
}

}  // namespace
}  // namespace hogel::patterns
