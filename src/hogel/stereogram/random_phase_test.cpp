// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/random_phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "hogel/core/random.h"
#include "hogel/core/test_targets.h"
#include "hogel/stereogram/random_bytes.h"
#include "hogel/stereogram/unit_roots.h"

namespace hogel::stereogram {
namespace {

using Complex = std::complex<float>;

TEST(RandomPhase, keeps_moduli_and_takes_phases_from_the_bytes_of_the_draws) {
    std::vector<float> moduli(40);
    for (std::size_t i = 0; i < moduli.size(); ++i) moduli[i] = float(i);
    std::vector<Complex> values(40);
    const PhaseSeries series{{77, 3}, {5, 11, 13}};
    spread_random_phases(series, moduli, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto draw = core::philox({static_cast<std::uint32_t>(i / 16), 5, 11, 13}, {77, 3});
        const double byte = draw[i % 16 / 4] >> (8 * (i % 4)) & 0xff;
        const auto expected = std::polar(double(i), 2 * std::numbers::pi * byte / 256);
        EXPECT_LT(std::abs(std::complex<double>(values[i]) - expected), 1e-6 * double(i) + 1e-12) << i;
    }
}

HOGEL_TEST_ON_EVERY_TARGET(RandomBytes);

TEST_P(RandomBytes, equal_their_plain_version) {
    const PhaseSeries series{{0xdeadbeefu, 0x80000001u}, {5, 0xffffffffu, 13}};
    for (const std::size_t size : {0, 1, 16, 130, 512, 1000}) {
        std::vector<std::uint8_t> plain(size), fast(size);
        random_bytes_plain(series, 3, plain);
        random_bytes(series, 3, fast);
        EXPECT_EQ(plain, fast) << size;
    }
}

TEST(UnitRoots, are_right_to_half_a_step_for_phases_of_either_sign) {
    const UnitRoots roots;
    for (double cycles = -20000; cycles < 20000; cycles += 123.456) {
        const double angle = 2 * std::numbers::pi * (cycles - std::round(cycles));
        EXPECT_LT(std::abs(std::complex<double>(roots(cycles)) - std::polar(1.0, angle)),
                  1e-6 + std::numbers::pi / 4096)
            << cycles;
    }
}

// Phases are uniform over the circle: the moments e^{ikφ}, k = 1..3, average to zero as fast as for independent phases.
// Phases of neighbouring coefficients, hogels and looks are independent.
TEST(RandomPhase, is_uniform_and_independent) {
    const std::size_t count = 4096;
    const std::vector<float> ones(count, 1);
    const auto draw = [&](std::uint32_t look, std::uint32_t s) {
        std::vector<Complex> values(count);
        spread_random_phases({{1, 0}, {look, s, 9}}, ones, values);
        return values;
    };
    const auto a = draw(0, 0), other_look = draw(1, 0), other_hogel = draw(0, 1);
    std::complex<double> moments[3]{}, with_look = 0, with_hogel = 0, with_next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::complex<double> z(a[i]);
        moments[0] += z;
        moments[1] += z * z;
        moments[2] += z * z * z;
        with_look += z * std::conj(std::complex<double>(other_look[i]));
        with_hogel += z * std::conj(std::complex<double>(other_hogel[i]));
        with_next += z * std::conj(std::complex<double>(a[(i + 1) % count]));
    }
    // A sum of n independent unit vectors is about √n long; it exceeds 3.5 √n about once in 200,000 draws.
    const double bound = 3.5 * std::sqrt(double(count));
    for (const auto& sum : {moments[0], moments[1], moments[2], with_look, with_hogel, with_next})
        EXPECT_LT(std::abs(sum), bound);
}

}  // namespace
}  // namespace hogel::stereogram
