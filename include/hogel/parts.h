// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hogel/export.h"

namespace hogel {

/// An optional part of the library. A function that needs a part missing from this build throws Error(not_built_in).
struct Part {
    std::string name;    ///< "Embree"
    std::string text;    ///< what it adds, one line
    std::string option;  ///< CMake option that builds it in: "HOGEL_EMBREE=ON"
    bool built_in = false;
};

/// Returns all optional parts, built in or not.
HOGEL_API const std::vector<Part>& parts();

}  // namespace hogel
