// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/codec/rate_curve.h"

namespace hogel::bench {

/// Returns the names of coders of other projects.
std::vector<std::string> coder_peers();

/// Measures a peer on a light field of one channel:
///   - zfp codes the array of floats;
///   - OpenEXR codes all hogels as one picture of floats;
///   - the others code hogels as pictures, in rows of alternating direction, of 10 bits for video and 16 bits for still
///     pictures. OpenJPEG is run by its own programs, the rest by ffmpeg.
/// @param name  one of coder_peers()
/// Returns nothing if the program is not installed or lacks the coder. Throws Error(cancelled) after an interrupt.
std::optional<RateCurve> measure_coder_peer(const LightFieldBuffer& field, const std::string& name,
                                            const QualityRange& range);

/// Measures OpenEXR's lossy compression, dwaa or dwab; otherwise as measure_coder_peer().
std::optional<RateCurve> measure_openexr(const LightFieldBuffer& field, const std::string& compression,
                                         const QualityRange& range);

}  // namespace hogel::bench
