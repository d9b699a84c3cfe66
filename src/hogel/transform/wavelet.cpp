#include "hogel/transform/wavelet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hogel {
namespace {

// Each line: what changes, offset of the first tap, taps, and how many samples continue the source beyond an end.
// A step that reads details which already vanish for polynomials may continue them as it likes; one that reads anything
// else has to continue as many samples as the polynomials that are to be kept.
std::vector<Wavelet> table() {
    constexpr Half detail = Half::detail, coarse = Half::coarse;
    const double r3 = std::sqrt(3.0);
    return {
        // Orthonormal, N = Ñ. Daubechies, CPAM 41 (1988); steps: Daubechies and Sweldens, "Factoring wavelet transforms
        // into lifting steps", 1998. D2 and D4 are (1,1) and (2,2), D6 is (3,3).
        {"haar", 1, 1, {{detail, 0, {-1}, 1}, {coarse, 0, {0.5}, 0}}, {}},
        {"d4", 2, 2, {{detail, 0, {-r3}, 2}, {coarse, 0, {r3 / 4, (r3 - 2) / 4}, 2}, {detail, -1, {1}, 2}}, {}},
        // Of the factorizations of D6 the one with the smallest taps, and so the best conditioned ends.
        {"d6",
         3,
         3,
         {{coarse, 0, {0.41228659505180554}, 3},
          {detail, 0, {-0.35238765767485564, -0.46675694679423857}, 3},
          {coarse, -2, {-0.09542943900975184, 0.4921518448877388}, 3},
          {detail, 2, {0.11619309193636229}, 3}},
         {}},
        // Average-interpolating (N,Ñ): N is the order of the polynomial whose averages over cells agree with the
        // samples, odd; from Haar, a prediction from the neighbouring averages, then an update. Donoho 1993; Sweldens,
        // "The lifting scheme", 1996.
        {"ai13", 1, 3, {{detail, 0, {-1}, 1}, {coarse, 0, {0.5}, 0}, {coarse, -1, {1. / 16, 0, -1. / 16}, 0}}, {}},
        {"ai31", 3, 1, {{detail, 0, {-1}, 1}, {coarse, 0, {0.5}, 2}, {detail, -1, {0.25, 0, -0.25}, 3}}, {}},
        {"ai33",
         3,
         3,
         {{detail, 0, {-1}, 1},
          {coarse, 0, {0.5}, 2},
          {detail, -1, {0.25, 0, -0.25}, 3},
          {coarse, -1, {1. / 16, 0, -1. / 16}, 0}},
         {}},
        // Interpolating (N,Ñ): N samples give the interpolating polynomial that predicts the odd ones. Deslauriers and
        // Dubuc 1989; Sweldens 1996. i22 is the 5/3 wavelet.
        {"i22", 2, 2, {{detail, 0, {-1. / 2, -1. / 2}, 2}, {coarse, -1, {1. / 4, 1. / 4}, 1}}, {}},
        {"i24",
         2,
         4,
         {{detail, 0, {-1. / 2, -1. / 2}, 2}, {coarse, -2, {-3. / 64, 19. / 64, 19. / 64, -3. / 64}, 1}},
         {}},
        {"i42", 4, 2, {{detail, -1, {1. / 16, -9. / 16, -9. / 16, 1. / 16}, 4}, {coarse, -1, {1. / 4, 1. / 4}, 1}}, {}},
        {"i44",
         4,
         4,
         {{detail, -1, {1. / 16, -9. / 16, -9. / 16, 1. / 16}, 4},
          {coarse, -2, {-1. / 32, 9. / 32, 9. / 32, -1. / 32}, 1}},
         {}},
        // Cohen-Daubechies-Feauveau (N,Ñ): the synthesis scaling function is the B-spline of order N, which reproduces
        // polynomials of degree < N. Cohen, Daubechies and Feauveau, CPAM 45 (1992).
        {"cdf31", 3, 1, {{coarse, -1, {-1. / 3}, 3}, {detail, 0, {-9. / 8, -3. / 8}, 3}, {coarse, 0, {4. / 9}, 1}}, {}},
        {"cdf33",
         3,
         3,
         {{coarse, -1, {-1. / 3}, 3}, {detail, 0, {-9. / 8, -3. / 8}, 3}, {coarse, -1, {1. / 12, 4. / 9, -1. / 12}, 1}},
         {}},
        {"cdf42",
         4,
         2,
         {{coarse, -1, {-1. / 4, -1. / 4}, 4}, {detail, 0, {-1, -1}, 4}, {coarse, -1, {3. / 16, 3. / 16}, 1}},
         {}},
        {"cdf44",
         4,
         4,
         {{coarse, -1, {-1. / 4, -1. / 4}, 4},
          {detail, 0, {-1, -1}, 4},
          {coarse, -2, {-5. / 128, 29. / 128, 29. / 128, -5. / 128}, 1}},
         {}},
        // The (9,7) spline variant, numbers of taps: Antonini, Barlaud, Mathieu and Daubechies 1992; N = Ñ = 4. Taps by
        // Daubechies and Sweldens 1998.
        {"cdf97",
         4,
         4,
         {{detail, 0, {-1.586134342059924, -1.586134342059924}, 4},
          {coarse, -1, {-0.052980118572961, -0.052980118572961}, 4},
          {detail, 0, {0.882911075530934, 0.882911075530934}, 4},
          {coarse, -1, {0.443506852043971, 0.443506852043971}, 1}},
         {}},
    };
}

// One level of synthesis, unscaled, of coarse samples and details on a line without ends: both have the same length,
// beyond which they are zero, and the result is long enough to hold everything that is not.
using Line = std::vector<double>;
Line synthesis(const Wavelet& wavelet, Line coarse, Line detail) {
    constexpr std::ptrdiff_t margin = 4;  // more than the reach of all steps of any wavelet here
    for (Line* line : {&coarse, &detail}) {
        line->insert(line->begin(), margin, 0.0);
        line->insert(line->end(), margin, 0.0);
    }
    const auto count = std::ssize(coarse);
    for (auto step = wavelet.steps.rbegin(); step != wavelet.steps.rend(); ++step) {
        Line& target = step->target == Half::detail ? detail : coarse;
        const Line& source = step->target == Half::detail ? coarse : detail;
        for (std::ptrdiff_t i = 0; i < count; ++i)
            for (std::ptrdiff_t k = 0; k < std::ssize(step->taps); ++k) {
                const std::ptrdiff_t at = i + step->first + k;
                if (at >= 0 && at < count)
                    target[static_cast<std::size_t>(i)] -=
                        step->taps[static_cast<std::size_t>(k)] * source[static_cast<std::size_t>(at)];
            }
    }
    Line result;
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        result.push_back(coarse[i]);
        result.push_back(detail[i]);
    }
    const auto nonzero = [](double value) { return value != 0; };
    const auto begin = std::find_if(result.begin(), result.end(), nonzero);
    const auto end = std::find_if(result.rbegin(), result.rend(), nonzero).base();
    return {begin, end};
}

double norm(const Line& line) {
    double sum = 0;
    for (double value : line) sum += value * value;
    return std::sqrt(sum);
}

// Beyond this level the norms grow by a constant factor a level, to 1e-4.
constexpr int scaled_levels = 8;

std::vector<Wavelet::Scale> unit_norm_scales(const Wavelet& wavelet) {
    std::vector<Wavelet::Scale> scales;
    double finer = 1;
    for (int level = 1; level <= scaled_levels; ++level) {
        Line coarse = synthesis(wavelet, {1}, {0}), detail = synthesis(wavelet, {0}, {1});
        for (int l = 1; l < level; ++l) {
            coarse = synthesis(wavelet, coarse, Line(coarse.size()));
            detail = synthesis(wavelet, detail, Line(detail.size()));
        }
        scales.push_back({norm(coarse) / finer, norm(detail) / finer});
        finer = norm(coarse);
    }
    return scales;
}

}  // namespace

Wavelet::Scale Wavelet::scale(int level) const {
    return scales[static_cast<std::size_t>(std::min(level, scaled_levels) - 1)];
}

std::span<const Wavelet> wavelets() {
    static const std::vector<Wavelet> all = [] {
        std::vector<Wavelet> made = table();
        for (Wavelet& wavelet : made) wavelet.scales = unit_norm_scales(wavelet);
        return made;
    }();
    return all;
}

}  // namespace hogel
