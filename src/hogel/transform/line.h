// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/transform/wavelet.h"

namespace hogel::transform {

/// How many lines are transformed side by side.
constexpr std::size_t lane_count = 16;

/// One level of a wavelet on lines of one length, `lane_count` lines at a time, as its lifting steps alone or with
/// scales. A tile holds sample k of all lines in its row k, rows[k·lane_count + lane]; while it is transformed the even
/// samples come first and the odd ones after them.
class WaveletLine {
  public:
    WaveletLine(const Wavelet& wavelet, std::size_t length);

    /// Before the steps forward() divides, and after those inverse() multiplies, sample k by before[k]; after the steps
    /// row k is multiplied, or before those of inverse() divided, by after[k].
    void set_scales(const std::vector<double>& before, const std::vector<double>& after);

    /// The sample of the line that stands in a row of the tile before forward() and after inverse().
    std::size_t sample_of_row(std::size_t row) const {
        return row < coarse_count_ ? 2 * row : 2 * (row - coarse_count_) + 1;
    }
    void forward(float* rows) const;
    void inverse(float* rows) const;
    std::size_t length() const { return length_; }

  private:
    struct Row {  // rows[target] += Σ taps[k] · rows[source + k]
        std::size_t target, source;
        std::vector<float> taps;
    };
    struct Step {
        Row inner;          // the first of `count` targets all of whose sources exist
        std::size_t count;  // the others follow at distance 1
        std::vector<Row> edges;
    };
    struct Scale {
        float forward = 1, inverse = 1;
    };
    static void apply(const Row& row, std::size_t count, float sign, float* rows);

    std::size_t length_, coarse_count_;
    std::vector<Step> steps_;
    std::vector<Scale> before_, after_;  // by row
};

/// All levels of a wavelet on lines of one length, scaled so that every synthesis basis function has norm 1, those at
/// the ends of the line too: an error of a coefficient is then an error of the same energy in the signal, nearly
/// (exactly, where the basis is orthogonal). In several dimensions basis functions are products of these. Lines of one
/// sample have no levels, so there are at most as many as it takes to get there.
std::vector<WaveletLine> wavelet_levels(const Wavelet& wavelet, std::size_t length, int levels);

/// One level of one line without scales, straight from the definition and in double precision: the truth for
/// WaveletLine. forward: samples in, coarse samples and then details out; inverse: the other way round.
void forward_line_plain(const Wavelet& wavelet, std::span<double> line);
void inverse_line_plain(const Wavelet& wavelet, std::span<double> line);

/// The weights by which samples 0..count−1 of a polynomial sequence of degree < count give its value at `at`.
std::vector<double> extrapolation(std::size_t count, std::ptrdiff_t at);

}  // namespace hogel::transform
