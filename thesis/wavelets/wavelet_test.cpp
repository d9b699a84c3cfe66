// SPDX-License-Identifier: Apache-2.0
#include "thesis/wavelets/wavelet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "thesis/wavelets/line.h"

namespace hogel::wavelets {
namespace {

const Wavelet& named(std::string_view name) {
    for (const Wavelet& wavelet : wavelets())
        if (wavelet.name == name) return wavelet;
    throw std::runtime_error("no such wavelet");
}

struct Filters {
    std::vector<double> low, high;
};

std::vector<double> trimmed(const std::vector<double>& taps) {
    std::size_t begin = 0, end = taps.size();
    while (begin < end && std::abs(taps[begin]) < 1e-12) ++begin;
    while (end > begin && std::abs(taps[end - 1]) < 1e-12) --end;
    return {taps.begin() + static_cast<std::ptrdiff_t>(begin), taps.begin() + static_cast<std::ptrdiff_t>(end)};
}

// The measured filters of one level in the middle of a long line: analysis by impulses at each sample, synthesis as the
// response to one coefficient.
constexpr std::size_t length = 64, middle = 16;
Filters analysis(const Wavelet& wavelet) {
    Filters filters;
    for (std::size_t at = 0; at < length; ++at) {
        std::vector<double> line(length);
        line[at] = 1;
        forward_line_plain(wavelet, line);
        filters.low.push_back(line[middle]);
        filters.high.push_back(line[length / 2 + middle]);
    }
    return {trimmed(filters.low), trimmed(filters.high)};
}
Filters synthesis(const Wavelet& wavelet) {
    std::vector<double> low(length), high(length);
    low[middle] = 1;
    high[length / 2 + middle] = 1;
    inverse_line_plain(wavelet, low);
    inverse_line_plain(wavelet, high);
    return {trimmed(low), trimmed(high)};
}

// Filters are defined up to a factor, so both are normalised to norm 1 and the same sign.
void expect_same_up_to_factor(const std::vector<double>& measured, const std::vector<double>& published,
                              double tolerance, std::string_view what) {
    ASSERT_EQ(measured.size(), published.size()) << what;
    double product = 0, squares = 0, others = 0;
    for (std::size_t k = 0; k < published.size(); ++k) {
        product += measured[k] * published[k];
        squares += published[k] * published[k];
        others += measured[k] * measured[k];
    }
    const double factor = (product < 0 ? -1 : 1) * std::sqrt(others / squares);
    for (std::size_t k = 0; k < published.size(); ++k)
        EXPECT_NEAR(measured[k] / factor, published[k], tolerance) << what << " tap " << k;
}

// Published taps: Haar, D4, D6 by Daubechies' closed forms (tabulated as 0.48296 0.83652 0.22414 −0.12941 and
// 0.33267 0.80689 0.45988 −0.13501 −0.08544 0.03523); 5/3 and 9/7 as in JPEG 2000 (ISO 15444-1, annex F); the splines
// as in Cohen, Daubechies and Feauveau's table 6.1.
TEST(Wavelet, impulse_responses_are_the_published_taps) {
    const double r3 = std::sqrt(3.0), r10 = std::sqrt(10.0), c = std::sqrt(5 + 2 * r10);
    expect_same_up_to_factor(analysis(named("haar")).low, {1, 1}, 1e-14, "haar");
    expect_same_up_to_factor(analysis(named("haar")).high, {1, -1}, 1e-14, "haar");

    const double h4 = 4 * std::sqrt(2.0), h6 = 16 * std::sqrt(2.0);
    const std::vector<double> d4{(1 + r3) / h4, (3 + r3) / h4, (3 - r3) / h4, (1 - r3) / h4};
    const std::vector<double> d6{(1 + r10 + c) / h6,          (5 + r10 + 3 * c) / h6, (10 - 2 * r10 + 2 * c) / h6,
                                 (10 - 2 * r10 - 2 * c) / h6, (5 + r10 - 3 * c) / h6, (1 + r10 - c) / h6};
    EXPECT_NEAR(d6[0], 0.3326705529500825, 1e-12);
    EXPECT_NEAR(d6[5], 0.0352262918857095, 1e-12);
    expect_same_up_to_factor(analysis(named("d4")).low, d4, 1e-12, "d4");
    expect_same_up_to_factor(analysis(named("d4")).high, {d4[3], -d4[2], d4[1], -d4[0]}, 1e-12, "d4");
    // This factorization is reversed in time.
    expect_same_up_to_factor(analysis(named("d6")).low, {d6.rbegin(), d6.rend()}, 1e-12, "d6");
    expect_same_up_to_factor(analysis(named("d6")).high, {d6[0], -d6[1], d6[2], -d6[3], d6[4], -d6[5]}, 1e-12, "d6");

    expect_same_up_to_factor(analysis(named("i22")).low, {-1. / 8, 2. / 8, 6. / 8, 2. / 8, -1. / 8}, 1e-14, "5/3");
    expect_same_up_to_factor(analysis(named("i22")).high, {-0.5, 1, -0.5}, 1e-14, "5/3");
    expect_same_up_to_factor(synthesis(named("i22")).low, {0.5, 1, 0.5}, 1e-14, "5/3");

    const std::vector<double> low97{0.026748757411, -0.016864118443, -0.078223266529, 0.266864118443, 0.602949018236,
                                    0.266864118443, -0.078223266529, -0.016864118443, 0.026748757411};
    const std::vector<double> high97{0.045635881557,  -0.028771763114, -0.295635881557, 0.557543526229,
                                     -0.295635881557, -0.028771763114, 0.045635881557};
    expect_same_up_to_factor(analysis(named("cdf97")).low, low97, 1e-10, "9/7");
    expect_same_up_to_factor(analysis(named("cdf97")).high, high97, 1e-10, "9/7");

    expect_same_up_to_factor(analysis(named("cdf31")).low, {-1. / 4, 3. / 4, 3. / 4, -1. / 4}, 1e-14, "cdf31");
    expect_same_up_to_factor(analysis(named("cdf33")).low,
                             {3. / 64, -9. / 64, -7. / 64, 45. / 64, 45. / 64, -7. / 64, -9. / 64, 3. / 64}, 1e-14,
                             "cdf33");
    expect_same_up_to_factor(
        analysis(named("i24")).low,
        {3. / 128, -6. / 128, -16. / 128, 38. / 128, 90. / 128, 38. / 128, -16. / 128, -6. / 128, 3. / 128}, 1e-14,
        "cdf(2,4)");
    expect_same_up_to_factor(analysis(named("ai13")).low, {-1. / 16, 1. / 16, 1. / 2, 1. / 2, 1. / 16, -1. / 16}, 1e-14,
                             "cdf(1,3)");
}

// The definitions of the families: the synthesis scaling functions of cdf* are B-splines, those of i* interpolate
// (Deslauriers and Dubuc), and the analysis ones of ai31 are cell averages.
TEST(Wavelet, families_have_their_defining_scaling_functions) {
    for (const char* name : {"cdf31", "cdf33"})
        expect_same_up_to_factor(synthesis(named(name)).low, {1, 3, 3, 1}, 1e-13, name);
    for (const char* name : {"cdf42", "cdf44"})
        expect_same_up_to_factor(synthesis(named(name)).low, {1, 4, 6, 4, 1}, 1e-13, name);
    for (const char* name : {"i42", "i44"})
        expect_same_up_to_factor(synthesis(named(name)).low, {-1. / 16, 0, 9. / 16, 1, 9. / 16, 0, -1. / 16}, 1e-14,
                                 name);
    for (const char* name : {"haar", "ai31"}) expect_same_up_to_factor(analysis(named(name)).low, {1, 1}, 1e-14, name);
    for (const char* name : {"ai31", "ai33"})
        expect_same_up_to_factor(synthesis(named(name)).low, {-1, 1, 8, 8, 1, -1}, 1e-13, name);
}

double moment(const std::vector<double>& taps, int degree, double centre) {
    double sum = 0;
    for (std::size_t k = 0; k < taps.size(); ++k) sum += taps[k] * std::pow(static_cast<double>(k) - centre, degree);
    return sum;
}

TEST(Wavelet, details_and_wavelets_have_the_moments_that_the_names_say_and_no_more) {
    for (const Wavelet& wavelet : wavelets()) {
        const std::vector<double> analysis_high = analysis(wavelet).high, synthesis_high = synthesis(wavelet).high;
        // Off centre, so that no moment vanishes by symmetry alone.
        for (int degree = 0; degree <= wavelet.reproduction; ++degree) {
            const double value = moment(analysis_high, degree, 2.3);
            if (degree < wavelet.reproduction)
                EXPECT_NEAR(value, 0, 1e-9) << wavelet.name << " N, degree " << degree;
            else
                EXPECT_GT(std::abs(value), 1e-2) << wavelet.name << " N, degree " << degree;
        }
        for (int degree = 0; degree <= wavelet.moments; ++degree) {
            const double value = moment(synthesis_high, degree, 2.3);
            if (degree < wavelet.moments)
                EXPECT_NEAR(value, 0, 1e-9) << wavelet.name << " moments, degree " << degree;
            else
                EXPECT_GT(std::abs(value), 1e-2) << wavelet.name << " moments, degree " << degree;
        }
    }
}

// Up to the promised order, at both ends, for all lengths with enough samples in both halves, and at every level,
// because the coarse samples of a polynomial are a polynomial again.
TEST(Wavelet, polynomials_have_no_details_up_to_the_ends) {
    for (const Wavelet& wavelet : wavelets())
        for (std::size_t n = static_cast<std::size_t>(2 * wavelet.edge_order); n <= 40; ++n)
            for (int degree = 0; degree < wavelet.edge_order; ++degree) {
                std::vector<double> line(n);
                for (std::size_t k = 0; k < n; ++k)
                    line[k] = std::pow(static_cast<double>(k) / static_cast<double>(n) - 0.3, degree);
                std::size_t coarse = n;
                while (coarse >= static_cast<std::size_t>(2 * wavelet.edge_order)) {
                    forward_line_plain(wavelet, std::span(line).first(coarse));
                    for (std::size_t k = (coarse + 1) / 2; k < coarse; ++k)
                        EXPECT_NEAR(line[k], 0, 1e-9) << wavelet.name << " length " << n << " of " << coarse
                                                      << " degree " << degree << " detail " << k;
                    coarse = (coarse + 1) / 2;
                }
            }
}

TEST(Wavelet, lines_of_any_length_come_back) {
    for (const Wavelet& wavelet : wavelets())
        for (std::size_t n : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 17, 23, 31, 40, 97}) {
            std::vector<double> line(n);
            for (std::size_t k = 0; k < n; ++k) line[k] = std::sin(1.7 * static_cast<double>(k * k));
            std::vector<double> original = line;
            forward_line_plain(wavelet, line);
            inverse_line_plain(wavelet, line);
            for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(line[k], original[k], 1e-11) << wavelet.name << " " << n;
        }
}

// Compares the fast lines with the plain ones for every length, with different numbers in every lane.
TEST(WaveletLine, agrees_with_the_plain_line) {
    std::vector<std::size_t> lengths{53, 97, 127};
    for (std::size_t n = 1; n <= 40; ++n) lengths.push_back(n);
    for (const Wavelet& wavelet : wavelets())
        for (std::size_t n : lengths) {
            const WaveletLine fast(wavelet, n);
            std::vector<float> tile(n * lane_count);
            std::vector<std::vector<double>> plain(lane_count, std::vector<double>(n));
            const auto sample = [](std::size_t k, std::size_t lane) {
                return std::sin(0.37f * static_cast<float>(k * k) + static_cast<float>(lane));
            };
            for (std::size_t row = 0; row < n; ++row)
                for (std::size_t lane = 0; lane < lane_count; ++lane) {
                    const std::size_t k = fast.sample_of_row(row);
                    tile[row * lane_count + lane] = sample(k, lane);
                    plain[lane][k] = sample(k, lane);
                }
            fast.forward(tile.data());
            for (std::size_t lane = 0; lane < lane_count; ++lane) {
                forward_line_plain(wavelet, plain[lane]);
                for (std::size_t row = 0; row < n; ++row)
                    EXPECT_NEAR(tile[row * lane_count + lane], plain[lane][row], 2e-5)
                        << wavelet.name << " length " << n << " row " << row;
            }
            fast.inverse(tile.data());
            for (std::size_t row = 0; row < n; ++row)
                for (std::size_t lane = 0; lane < lane_count; ++lane)
                    EXPECT_NEAR(tile[row * lane_count + lane], sample(fast.sample_of_row(row), lane), 2e-5)
                        << wavelet.name << " length " << n;
        }
}

}  // namespace
}  // namespace hogel::wavelets
