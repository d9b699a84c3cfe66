// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hogel/export.h"

namespace hogel {

/// Returns untrusted text, such as metadata or a file name, as one line that is safe to print on a terminal. Valid
/// UTF-8 letters stay. White space becomes a blank. Other control characters, marks of writing direction and invalid
/// UTF-8 bytes become '?'. Text above 400 letters is cut to its first and last 200, with "..." between them.
HOGEL_API std::string printable(std::string_view text);

}  // namespace hogel
