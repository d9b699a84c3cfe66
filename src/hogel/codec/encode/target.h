// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "hogel/codec/encode/step_search.h"
#include "hogel/coding/histogram_rule.h"
#include "hogel/compress.h"

namespace hogel::codec::encode {

// Evaluates a CompressionTarget, and refuses impossible ones with Error(usage).

// Refuses numbers out of range.
void check(const CompressionTarget& target);

// Returns whether a target bounds the error of every sample.
bool is_exact(const CompressionTarget& target);

// Returns an estimate of the step that meets the target, as the start of a search.
// @param rms   root mean square of the signal
double likely_step(const CompressionTarget& target, double rms);

// Returns the size in bytes of a file with a rate. Refuses a size that the samples cannot fill.
double bytes_of_rate(const PixelsPerBit& target, double rays, double samples);

// Returns the step that the target's rule yields for `bits` bits of coefficients. The rule must not be search.
double step_by_rule(const PixelsPerBit& target, ZerotreeSymbols symbols, const coding::MagnitudeHistogram& magnitudes,
                    double bits);

// @param bytes     the requested size
// @param nearest   size of the nearest possible file
[[noreturn]] void refuse_rate(const PixelsPerBit& target, double bytes, std::uint64_t nearest);

// Refuses a quality that needs a step too small for levels or floats: errors would be many times larger than the step.
void check_quality(const CompressionTarget& target, const CodingOutcome& outcome, double step,
                   const std::string& coder);

}  // namespace hogel::codec::encode
