// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "hogel/compress.h"

namespace hogel::codec::encode {

// Sums over tiles that were coded with a step.
struct CodingOutcome {
    double signal = 0, error = 0, bytes = 0;
    double samples = 0;  // with those that do not count

    double sqnr() const;
    void add(const CodingOutcome& other);
};

// The band in which a figure must lie: an SQNR, or the logarithm of the number of bytes. Both fall with the logarithm
// of the step.
struct StepBand {
    double low, high;
    bool above_is_better;  // where nothing is in the band, the nearest figure above it is taken, otherwise below it
    double slope;          // expected
};

StepBand band_of_sqnr(double sqnr);
// @param bytes       at most; for an embedded code at least, as it is made a little too long and cut
// @param tolerance   fraction that may be missing, or be too much
StepBand band_of_bytes(double bytes, double tolerance, bool embedded);

// How a search ended.
enum class StepFound {
    in_band,
    beside_band,  // at the nearest figure on the better side; there are some on the other side, too
    only_above,   // no step gives a figure as low as the band
    only_below,   // no step gives a figure as high as the band
};

// Searches for a step. A further search starts from the step that was found.
class StepSearch {
  public:
    using Code = std::function<CodingOutcome(double step)>;
    using Figure = std::function<double(const CodingOutcome&)>;

    // @param place   logarithm of the step to start with
    StepSearch(double place, Figure figure) : place_(place), figure_(std::move(figure)) {}

    // The last coding is that of the step that was found.
    StepFound run(const StepBand& band, const Code& code);
    double step() const;
    const CodingOutcome& outcome() const { return outcome_; }
    int passes() const { return passes_; }

  private:
    double code_at(double place, const Code& code);

    double place_;
    Figure figure_;
    std::optional<double> slope_;
    CodingOutcome outcome_;
    int passes_ = 0;
};

}  // namespace hogel::codec::encode
