// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/demodulation.h"

#include <gtest/gtest.h>

#include "hogel/core/test_targets.h"

namespace hogel::camera::hogel_spectra {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(Demodulation);

TEST_P(Demodulation, has_the_phases_of_the_exact_path) {
    const SampleLine across{0.012, 12e-6, 0.09, 1 / 532e-9, 564333.25}, down{-0.007, -12e-6, 0.0902, 1 / 532e-9, 0};
    for (const std::size_t rows : {std::size_t{16}, std::size_t{3}}) {
        const std::size_t row = 2 * lanes;
        Array<float, 3> fast({lanes, 2, row}, 7.0f), plain(fast.shape(), 7.0f);
        demodulation(across, down, -2e-4 / 16, rows, fast.data(), row);
        demodulation_plain(across, down, -2e-4 / 16, rows, plain.data(), row);
        for (std::size_t i = 0; i < fast.size(); ++i) {
            ASSERT_NEAR(fast.data()[i], plain.data()[i], 2e-5) << i;
            EXPECT_EQ(fast.data()[i] == 7.0f, i % row >= lanes || i / row >= 2 * rows) << i;
        }
    }
}

}  // namespace
}  // namespace hogel::camera::hogel_spectra
