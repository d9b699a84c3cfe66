// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "command_line.h"
#include "hogel/requests.h"

namespace hogel::cli {

inline constexpr const char* view_summary = "Look around in a light field, a hologram or a scene, in a browser";

/// The options of `hogel view`. hogel reads them to refuse what is wrong, and the viewer, a program of its own that
/// hogel then becomes, to act on them.
void add_view_options(Command& command, ViewerParameters& options);

}  // namespace hogel::cli
