// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "command_line.h"
#include "hogel/requests.h"

namespace hogel::cli {

inline constexpr const char* view_summary = "View a light field, a hologram or a scene in a browser";

/// Declares the options of `hogel view`. hogel parses them to report errors, then executes the viewer, which parses
/// them again.
void add_view_options(Command& command, ViewerParameters& options);

}  // namespace hogel::cli
