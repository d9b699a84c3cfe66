// SPDX-License-Identifier: Apache-2.0
#include "hogel/math/packed_complex.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "hogel/core/test_targets.h"

namespace hogel::math {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(PackedNumbers);

using Complex = std::complex<float>;

// Numbers of all magnitudes and directions; some have a part that nearly rounds up to the next exponent.
std::vector<Complex> numbers() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> part(-1, 1), exponent(-110, 120);
    std::vector<Complex> all{{0, 0}, {-0.0f, 0}, {2047.5f, -3}, {-2047.4f, 2047.6f}, {1, -1}, {0, 5e-39f}};
    for (int i = 0; i < 5000; ++i) all.push_back(std::exp2(exponent(random)) * Complex(part(random), part(random)));
    return all;
}

TEST(PackedComplex, is_near_its_number) {
    for (const Complex value : numbers()) {
        const float larger = std::max(std::abs(value.real()), std::abs(value.imag()));
        const Complex error = unpacked(pack(value)) - value;
        const float most = larger < 0x1p-116f ? 0x1p-116f : larger / 2047;
        EXPECT_LE(std::abs(error.real()), most) << value;
        EXPECT_LE(std::abs(error.imag()), most) << value;
    }
}

TEST(PackedComplex, keeps_what_it_can_hold) {
    EXPECT_EQ(pack({0, 0}), PackedComplex{});
    EXPECT_EQ(unpacked({}), Complex(0));
    for (const Complex value : numbers()) {
        const Complex held = unpacked(pack(value));
        EXPECT_EQ(unpacked(pack(held)), held) << value;
    }
    for (int a : {-2047, -1024, 1025, 2047})
        for (int b = -2047; b <= 2047; b += 89) {
            const Complex value(0x1p40f * static_cast<float>(a), 0x1p40f * static_cast<float>(b));
            EXPECT_EQ(unpacked(pack(value)), value);
        }
}

TEST(PackedComplex, is_as_often_too_large_as_too_small) {
    double sum = 0;
    const std::vector<Complex> all = numbers();
    for (const Complex value : all)
        if (std::abs(value) > 0x1p-100f) sum += std::abs(unpacked(pack(value))) / std::abs(value) - 1;
    EXPECT_LT(std::abs(sum / static_cast<double>(all.size())), 2e-5);
}

TEST_P(PackedNumbers, are_those_of_single_ones) {
    const std::vector<Complex> values = numbers();
    std::vector<PackedComplex> packed(values.size() + 1);
    packed.back() = {7};
    pack(values.data(), packed.data(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(packed[i], pack(values[i])) << values[i];
    EXPECT_EQ(packed.back(), PackedComplex{7});
}

}  // namespace
}  // namespace hogel::math
