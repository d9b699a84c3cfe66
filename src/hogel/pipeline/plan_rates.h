// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

#include "hogel/pipeline.h"
#include "hogel/resources.h"

namespace hogel {

/// Processor seconds per sample of a hologram for its synthesis. Measured on two cores of an AMD EPYC (Zen 5) with g++
/// 12, 2026-11-22 (docs/performance.md).
inline constexpr double seconds_a_sample = 5e-9;

inline double on_all_threads(double processor_seconds) {
    return processor_seconds / static_cast<double>(std::max<std::size_t>(thread_count(), 1));
}

/// Samples of one look of all holograms of a request.
double hologram_samples(std::span<const LightFieldGrid> faces, const HologramRequest& request);

}  // namespace hogel
