// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hogel/compress.h"
#include "session.h"

namespace hogel::cli {

/// What coding a light field with some quality came to. Speeds are in million samples a second of one core, counted in
/// processor time, so that other work beside it matters little.
struct RatePoint {
    double pixels_per_bit, sqnr, encoding, decoding;
};

/// A coder at several qualities, from the best to the worst.
struct RateCurve {
    std::string name;
    std::vector<RatePoint> points;

    /// Interpolation the points: straight in the logarithms of all but the SQNR. Nothing where they do not reach.
    std::optional<RatePoint> at(double sqnr) const;
    std::optional<RatePoint> at_rate(double pixels_per_bit) const;
};

/// From one SQNR to another.
struct QualityRange {
    double low, high;
};

/// One of our coders, with steps that halve until the whole range is covered.
/// @param go_on   asked on the way
/// Throws Error(cancelled) once that says no.
RateCurve measure_method(const LightFieldBuffer& field, const CodingMethod& method, const QualityRange& range,
                         const Progress& go_on);

/// Coders that other programs have.
std::vector<std::string> peer_names();
/// A peer on a light field of one channel: zfp on the array of floats; OpenEXR on all hogels as one picture of floats;
/// the others, openjpeg by its own programs and the rest by way of ffmpeg, on the hogels as pictures, row by row and
/// back, of 10 bits for video and 16 for still pictures. Nothing where the program is not
/// installed or lacks the coder. Throws Error(cancelled) once `go_on`, asked before each quality, says no.
std::optional<RateCurve> measure_peer(const LightFieldBuffer& field, const std::string& name, const QualityRange& range,
                                      const Progress& go_on);

}  // namespace hogel::cli
