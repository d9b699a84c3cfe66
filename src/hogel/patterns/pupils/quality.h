// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/patterns/pupils/camera.h"

namespace hogel::patterns {

/// Measures patterns by the photographs of a camera; see hogel::pupil_quality().
PupilQuality pupil_quality(std::span<const Pattern> patterns, const PupilCamera& camera, const PatternOptions& options,
                           const Progress& progress = {});

}  // namespace hogel::patterns
