// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "hogel/codec/encode/step_search.h"
#include "hogel/compress.h"

namespace hogel::codec::encode {

// What a CompressionTarget asks for, and refusals of what cannot be had. All refusals are Error(usage).

// Refuses numbers that make no sense.
void check(const CompressionTarget& target);

// Whether a target bounds the error of every sample.
bool is_exact(const CompressionTarget& target);

// A step that may meet the target, to begin a search with.
// @param rms   root mean square of the signal
double likely_step(const CompressionTarget& target, double rms);

// The bytes of a file of a rate. Refuses more than samples can hold.
double bytes_of_rate(const PixelsPerBit& target, double rays, double samples);

// @param bytes     that were asked for
// @param nearest   bytes of the file that is nearest to it
[[noreturn]] void refuse_rate(const PixelsPerBit& target, double bytes, std::uint64_t nearest);

// Refuses a quality for whose steps levels or floats are too short, so that errors are many times as large as the step.
void check_quality(const CompressionTarget& target, const CodingOutcome& outcome, double step,
                   const std::string& coder);

}  // namespace hogel::codec::encode
