#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/transform/wavelet.h"

namespace hogel {

/// How many lines are transformed side by side.
constexpr std::size_t lane_count = 16;

/// One level of a wavelet on lines of one length, `lane_count` lines at a time.
/// A tile holds sample k of all lines in its row k, rows[k·lane_count + lane]; while it is transformed the even samples
/// come first and the odd ones after them.
class WaveletLine {
  public:
    /// @param level   which level this is, 1 the finest, for its scale
    WaveletLine(const Wavelet& wavelet, std::size_t length, int level);

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
    static void apply(const Row& row, std::size_t count, float sign, float* rows);
    void scale(float coarse, float detail, float* rows) const;

    std::size_t length_, coarse_count_;
    std::vector<Step> steps_;
    Wavelet::Scale scale_;
};

/// The same for one line, straight from the definition and in double precision: the truth for WaveletLine.
/// forward: samples in, coarse samples and then details out; inverse: the other way round. A line of one sample stays.
void forward_line_plain(const Wavelet& wavelet, int level, std::span<double> line);
void inverse_line_plain(const Wavelet& wavelet, int level, std::span<double> line);

/// The weights by which samples 0..count−1 of a polynomial sequence of degree < count give its value at `at`.
std::vector<double> extrapolation(std::size_t count, std::ptrdiff_t at);

}  // namespace hogel
