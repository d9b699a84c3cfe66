// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "hogel/compress.h"

namespace hogel::codec::encode {

// What coding tiles with a step gave.
struct CodingOutcome {
    double signal = 0, error = 0, bytes = 0, samples = 0;  // samples with those that do not count

    double sqnr() const;
    void add(const CodingOutcome& other);
};

// What the figure that is searched for must lie between: an SQNR, or the logarithm of the number of bytes. Both fall
// with the logarithm of the step.
struct StepBand {
    double low, high;
    bool above_is_better;  // of the nearest misses, the one above the band is the better; else the one below
    double slope;
};

StepBand band_of_sqnr(double sqnr);
// @param bytes       at most, at least where the stream is embedded: then it is made a little too long, and cut
// @param tolerance   how much of them may be missing
StepBand band_of_bytes(double bytes, double tolerance, bool embedded);

// Where the figures lay that a search saw, when it ended.
enum class StepFound {
    in_band,
    beside_band,  // the nearest to it on its better side; there are some on the other, too
    only_above,   // no step brings it down to the band
    only_below,   // or up to it
};

// Searches for a step. What it found last is where the next search goes on from.
class StepSearch {
  public:
    using Code = std::function<CodingOutcome(double step)>;
    using Figure = std::function<double(const CodingOutcome&)>;

    // @param place   logarithm of a step to begin with
    StepSearch(double place, Figure figure) : place_(place), figure_(std::move(figure)) {}

    // Ends with the coding of the step that was found.
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
