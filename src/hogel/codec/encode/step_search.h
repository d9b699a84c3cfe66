// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "hogel/compress.h"

namespace hogel::codec::encode {

// Sums over tiles coded with one step.
struct CodingOutcome {
    double signal = 0, error = 0, bytes = 0;
    double samples = 0;  // including those that do not count

    double sqnr() const;
    void add(const CodingOutcome& other);
};

// The band in which a figure must lie. A figure is an SQNR or the logarithm of the number of bytes; both fall with the
// logarithm of the step.
struct StepBand {
    double low, high;
    bool above_is_better;  // if no figure is in the band: whether the nearest one above it is taken, or the nearest
                           // below it
    double slope;          // expected
};

StepBand band_of_sqnr(double sqnr);
// @param bytes       maximum; for an embedded code the minimum, because the code is made a little too long and then cut
// @param tolerance   fraction by which the number may fall short, or for an embedded code exceed
StepBand band_of_bytes(double bytes, double tolerance, bool embedded);

// The outcome of a search.
enum class StepFound {
    in_band,
    beside_band,  // the nearest figure on the better side; figures on the other side exist, too
    only_above,   // all figures are above the band
    only_below,   // all figures are below the band
};

// Searches for a step. The next search starts from the step that this one found.
class StepSearch {
  public:
    using Code = std::function<CodingOutcome(double step)>;
    using Figure = std::function<double(const CodingOutcome&)>;

    // @param place   logarithm of the step to start with
    StepSearch(double place, Figure figure) : place_(place), figure_(std::move(figure)) {}

    // Runs a search. The last coding is the one with the step that was found.
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
