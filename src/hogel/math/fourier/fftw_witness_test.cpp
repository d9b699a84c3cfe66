// SPDX-License-Identifier: Apache-2.0
// Compares with FFTW where it is installed.
#ifdef HOGEL_FFTW_WITNESS
#include <fftw3.h>
#include <gtest/gtest.h>

#include "hogel/core/test_targets.h"
#include "hogel/math/fft.h"
#include "hogel/math/fourier/test_lines.h"

namespace hogel::math::fourier {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(FourierTransformsAndFftw);

// FFTW transforms a copy.
ExactLine by_fftw(Line x, std::size_t height, std::size_t width, int sign) {
    auto* values = reinterpret_cast<fftwf_complex*>(x.data());
    const fftwf_plan plan =
        fftwf_plan_dft_2d(static_cast<int>(height), static_cast<int>(width), values, values, sign, FFTW_ESTIMATE);
    fftwf_execute(plan);
    fftwf_destroy_plan(plan);
    return exact(x);
}

TEST_P(FourierTransformsAndFftw, agree_on_lines) {
    for (const std::size_t n :
         {1, 2, 16, 30, 48, 50, 60, 97, 100, 120, 480, 1000, 1031, 1080, 2062, 4096, 10007, 65536}) {
        const Line x = noise(n);
        Line there = x, back = x;
        const Fft1 fft(n);
        fft.forward(there.data());
        fft.backward(back.data());
        EXPECT_LT(relative_error(there.data(), by_fftw(x, 1, n, FFTW_FORWARD)), allowed_error(n)) << n;
        EXPECT_LT(relative_error(back.data(), by_fftw(x, 1, n, FFTW_BACKWARD)), allowed_error(n)) << n;
    }
}

TEST_P(FourierTransformsAndFftw, agree_on_arrays) {
    for (const auto& [height, width] :
         {std::pair<std::size_t, std::size_t>{30, 30}, {48, 100}, {64, 64}, {131, 97}, {600, 512}}) {
        const Line x = noise(height * width);
        Array<std::complex<float>, 2> values({height, width});
        std::copy(x.begin(), x.end(), values.data());
        Fft2(height, width).forward(values);
        EXPECT_LT(relative_error(values.data(), by_fftw(x, height, width, FFTW_FORWARD)), 2e-6)
            << height << " " << width;
    }
}

}  // namespace
}  // namespace hogel::math::fourier
#endif
