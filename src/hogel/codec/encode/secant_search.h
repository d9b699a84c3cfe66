// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

namespace hogel::codec::encode {

// Finds an argument for which a decreasing function is within a band, in few evaluations: by the secant through the
// last two points, or by bisection of the remaining interval if the secant leaves it.
class Search {
  public:
    Search(double low, double high, double start, double slope) : low_(low), high_(high), next_(start), slope_(slope) {}

    double next() const { return next_; }
    // Stores the function's value at next(). Returns whether it is within the band.
    bool add(double value);
    double slope() const { return slope_; }
    // Return the arguments nearest to the band at which the function is above it, and below it.
    std::optional<double> above() const { return above_; }
    std::optional<double> below() const { return below_; }

  private:
    double low_, high_, next_, slope_;
    std::optional<double> above_, below_;
    std::optional<std::pair<double, double>> last_;
    int bracketed_ = 0;  // evaluations since the band was bracketed
};

}  // namespace hogel::codec::encode
