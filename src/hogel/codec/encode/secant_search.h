// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

namespace hogel::codec::encode {

// Finds where a falling function is within a band, from as few values as possible: by the secant through the last two
// places, or the middle of what is known to be too far on either side when the secant leads out of it.
class Search {
  public:
    Search(double low, double high, double start, double slope) : low_(low), high_(high), next_(start), slope_(slope) {}

    // Where to look next.
    double next() const { return next_; }
    // The function's value there. Returns true when it is within the band.
    bool tell(double value);
    double slope() const { return slope_; }
    // The places nearest to the band from both sides: above it (too small a place) and below.
    std::optional<double> above() const { return above_; }
    std::optional<double> below() const { return below_; }

  private:
    double low_, high_, next_, slope_;
    std::optional<double> above_, below_;
    std::optional<std::pair<double, double>> last_;
    int told_ = 0;
};

}  // namespace hogel::codec::encode
