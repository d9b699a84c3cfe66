// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "hogel/compress.h"

namespace hogel::codec::encode {

// Sums over tiles coded with one step.
struct CodingOutcome {
    double signal = 0, error = 0, bytes = 0;
    double samples = 0;  // including uncounted ones

    double sqnr() const;
    void add(const CodingOutcome& other);
};

// Band for a figure: an SQNR, or the logarithm of the number of bytes. Both decrease with the logarithm of the step.
struct StepBand {
    double low, high;
    bool above_is_better;  // if no figure is in the band: whether to use the nearest one above it or the nearest
                           // below it
    double slope;          // expected
};

StepBand band_of_sqnr(double sqnr);
// @param bytes       maximum; for an embedded code the minimum, because the code is made slightly too long and then cut
// @param tolerance   allowed relative deficit, or for an embedded code excess
StepBand band_of_bytes(double bytes, double tolerance, bool embedded);

enum class StepFound {
    in_band,
    beside_band,  // the nearest figure on the better side; figures on the other side exist, too
    only_above,   // all figures are above the band
    only_below,   // all figures are below the band
};

// Searches for a step. The next search starts from the step found by the last one.
class StepSearch {
  public:
    using Code = std::function<CodingOutcome(double step)>;
    using Figure = std::function<double(const CodingOutcome&)>;

    // @param log_step   log2 of the first step
    StepSearch(double log_step, Figure figure) : log_step_(log_step), figure_(std::move(figure)) {}

    // Runs a search. The last coding uses the step that was found.
    StepFound run(const StepBand& band, const Code& code);
    double step() const;
    const CodingOutcome& outcome() const { return outcome_; }
    int passes() const { return passes_; }

  private:
    double code_at(double log_step, const Code& code);

    double log_step_;
    Figure figure_;
    std::optional<double> slope_;
    CodingOutcome outcome_;
    int passes_ = 0;
};

}  // namespace hogel::codec::encode
