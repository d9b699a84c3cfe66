// SPDX-License-Identifier: Apache-2.0
#include "thesis/wavelets/wavelet.h"

#include <cmath>

namespace hogel::wavelets {
namespace {

// Returns the wavelets. For each step: the half that it changes, the offset of the first tap, the taps, and the number
// of samples that determine the continuation beyond an end. A step may continue details arbitrarily if they already
// vanish for polynomials; any other step needs as many samples as the order to be kept at the ends. With filters of
// this length, 3 or 4 samples make the ends so ill-conditioned that the loss exceeds the gain: with a 4D array of
// 16x16x64x64 with edges, at 0.05 bits each, i42 gave 19.4 dB with 4, 26.6 with 2 and 26.7 with 1, cdf97 21.0, 26.8
// and 27.0, d6 22.8, 24.9 and 25.1; at 0.25 bits 2 was best for nearly all. For ai33 3 and 2 were within 0.2 dB.
std::vector<Wavelet> table() {
    constexpr Half detail = Half::detail, coarse = Half::coarse;
    const double r3 = std::sqrt(3.0);
    // clang-format off
    return {
        // Orthonormal, N = Ñ. Daubechies, CPAM 41 (1988); steps of D4: Daubechies and Sweldens, "Factoring wavelet
        // transforms into lifting steps", 1998; of D6: of its factorizations the one with the smallest taps.
        {"haar", 1, 1, 1, {{detail, 0, {-1}, 1}, {coarse, 0, {0.5}, 0}}},
        {"d4", 2, 2, 2, {{detail, 0, {-r3}, 2}, {coarse, 0, {r3 / 4, (r3 - 2) / 4}, 2}, {detail, -1, {1}, 2}}},
        {"d6", 3, 3, 2, {{coarse, 0, {0.41228659505180554}, 2},
                         {detail, 0, {-0.35238765767485564, -0.46675694679423857}, 2},
                         {coarse, -2, {-0.09542943900975184, 0.4921518448877388}, 2},
                         {detail, 2, {0.11619309193636229}, 2}}},
        // Average-interpolating (N,Ñ): N samples are averages over cells of the interpolating polynomial, which predicts
        // the averages over their halves; from Haar, that prediction, then an update. Donoho 1993; Sweldens, "The
        // lifting scheme", 1996.
        {"ai13", 1, 3, 1, {{detail, 0, {-1}, 1}, {coarse, 0, {0.5}, 0}, {coarse, -1, {1. / 16, 0, -1. / 16}, 0}}},
        {"ai31", 3, 1, 3, {{detail, 0, {-1}, 1}, {coarse, 0, {0.5}, 2}, {detail, -1, {0.25, 0, -0.25}, 3}}},
        {"ai33", 3, 3, 3, {{detail, 0, {-1}, 1}, {coarse, 0, {0.5}, 2}, {detail, -1, {0.25, 0, -0.25}, 3},
                           {coarse, -1, {1. / 16, 0, -1. / 16}, 0}}},
        // Interpolating (N,Ñ): the polynomial through N samples predicts the odd ones. Deslauriers and Dubuc 1989;
        // Sweldens 1996. i22 is the 5/3 wavelet.
        {"i22", 2, 2, 2, {{detail, 0, {-1. / 2, -1. / 2}, 2}, {coarse, -1, {1. / 4, 1. / 4}, 1}}},
        {"i24", 2, 4, 2, {{detail, 0, {-1. / 2, -1. / 2}, 2}, {coarse, -2, {-3. / 64, 19. / 64, 19. / 64, -3. / 64}, 1}}},
        {"i42", 4, 2, 2, {{detail, -1, {1. / 16, -9. / 16, -9. / 16, 1. / 16}, 2}, {coarse, -1, {1. / 4, 1. / 4}, 1}}},
        {"i44", 4, 4, 2, {{detail, -1, {1. / 16, -9. / 16, -9. / 16, 1. / 16}, 2},
                          {coarse, -2, {-1. / 32, 9. / 32, 9. / 32, -1. / 32}, 1}}},
        // Cohen-Daubechies-Feauveau (N,Ñ): the synthesis scaling function is the B-spline of order N, which reproduces
        // polynomials of degree < N. Cohen, Daubechies and Feauveau, CPAM 45 (1992).
        {"cdf31", 3, 1, 2, {{coarse, -1, {-1. / 3}, 2}, {detail, 0, {-9. / 8, -3. / 8}, 2}, {coarse, 0, {4. / 9}, 1}}},
        {"cdf33", 3, 3, 2, {{coarse, -1, {-1. / 3}, 2}, {detail, 0, {-9. / 8, -3. / 8}, 2},
                            {coarse, -1, {1. / 12, 4. / 9, -1. / 12}, 1}}},
        {"cdf42", 4, 2, 2, {{coarse, -1, {-1. / 4, -1. / 4}, 2}, {detail, 0, {-1, -1}, 2},
                            {coarse, -1, {3. / 16, 3. / 16}, 1}}},
        {"cdf44", 4, 4, 2, {{coarse, -1, {-1. / 4, -1. / 4}, 2}, {detail, 0, {-1, -1}, 2},
                            {coarse, -2, {-5. / 128, 29. / 128, 29. / 128, -5. / 128}, 1}}},
        // The spline variant with filters of 9 and 7 taps, N = Ñ = 4: Antonini, Barlaud, Mathieu and Daubechies 1992.
        // Steps by Daubechies and Sweldens 1998.
        {"cdf97", 4, 4, 2, {{detail, 0, {-1.586134342059924, -1.586134342059924}, 2},
                            {coarse, -1, {-0.052980118572961, -0.052980118572961}, 2},
                            {detail, 0, {0.882911075530934, 0.882911075530934}, 2},
                            {coarse, -1, {0.443506852043971, 0.443506852043971}, 1}}},
    };
    // clang-format on
}

}  // namespace

std::span<const Wavelet> wavelets() {
    static const std::vector<Wavelet> wavelets = table();
    return wavelets;
}

}  // namespace hogel::wavelets
