// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "thesis/wavelets/wavelet.h"

namespace hogel::wavelets {

/// Number of lines that are transformed together.
constexpr std::size_t lane_count = 16;

/// One level of a wavelet on lines of one length, `lane_count` lines at a time, as lifting steps with optional
/// scales. Row k of a tile holds sample k of all lines, rows[k·lane_count + lane]; during the transform even samples
/// come first, then the odd ones.
class WaveletLine {
  public:
    WaveletLine(const Wavelet& wavelet, std::size_t length);

    /// Sets scale factors. forward() first divides sample k of the line by before[k]. After its steps it multiplies row
    /// r by after[r], where rows hold the even samples first, then the odd ones. inverse() undoes both.
    void set_scales(const std::vector<double>& before, const std::vector<double>& after);

    /// Returns the index of the line's sample in a row of the tile, before forward() and after inverse().
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
        Row inner;          // first of `count` targets with all sources inside the line
        std::size_t count;  // consecutive targets
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

/// All levels of a wavelet on lines of one length, scaled so that every synthesis basis function has norm 1, also at
/// the ends of the line. An error of a coefficient then has nearly the same energy in the signal (exactly the same for
/// orthogonal bases). In several dimensions basis functions are products of these. The last possible level yields a
/// single coarse sample.
std::vector<WaveletLine> wavelet_levels(const Wavelet& wavelet, std::size_t length, int levels);

/// Plain twins of WaveletLine: one level of one line without scales, directly from the definition and in double
/// precision. forward: samples in, coarse samples and then details out; inverse: the reverse.
void forward_line_plain(const Wavelet& wavelet, std::span<double> line);
void inverse_line_plain(const Wavelet& wavelet, std::span<double> line);

/// Returns the weights of samples 0 … count − 1 that give the value at `position` of the polynomial of degree < count
/// through these samples.
std::vector<double> extrapolation(std::size_t count, std::ptrdiff_t position);

}  // namespace hogel::wavelets
