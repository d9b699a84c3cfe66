// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hogel/parts.h"

namespace hogel::core {

/// Returns the row of parts() with that name, which must exist.
const Part& part(std::string_view name);

/// Throws Error(not_built_in) with a message that names the missing part and its build option.
/// @param what  beginning of the message, such as "the renderer 'raytrace'"
[[noreturn]] void refuse_without(std::string_view part, const std::string& what);

/// Calls refuse_without() if the part is not built in. Call it before work that needs the part.
void require_part(std::string_view part, const std::string& what);

}  // namespace hogel::core
