// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hogel/parts.h"

namespace hogel::core {

/// The row of parts() with that name, which must exist.
const Part& part(std::string_view name);

/// Throws Error(not_built_in), which says what cannot be done and the build option that brings it. `what` is the
/// beginning of the message, such as "the renderer 'raytrace'".
[[noreturn]] void refuse_without(std::string_view part, const std::string& what);

/// refuse_without(), if the part is not built in. To be called before work that will need it.
void require_part(std::string_view part, const std::string& what);

}  // namespace hogel::core
