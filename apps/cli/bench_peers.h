// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench_codec.h"

namespace hogel::cli {

/// OpenEXR's lossy compression of all hogels as one picture of floats.
/// @param compression   dwaa or dwab
/// Nothing where this OpenEXR lacks it. Throws Error(cancelled) once `go_on` says no.
std::optional<RateCurve> measure_openexr(const LightFieldBuffer& field, const std::string& compression,
                                         const QualityRange& range, const Progress& go_on);

}  // namespace hogel::cli
