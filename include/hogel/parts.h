// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hogel/export.h"

namespace hogel {

/// A part of the library that a build may lack. What needs a part that is missing throws Error(not_built_in).
struct Part {
    std::string name;       ///< "Embree"
    std::string text;       ///< what it brings, one line
    std::string option;     ///< of CMake, which builds it in: "HOGEL_EMBREE=ON"
    bool built_in = false;  ///< whether this build has it
};

/// All optional parts, those that are built in and those that are not.
HOGEL_API const std::vector<Part>& parts();

}  // namespace hogel
