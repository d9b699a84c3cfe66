// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hogel/export.h"

namespace hogel {

/// Text of strangers, from metadata and names of files, as one line of a terminal. Letters of UTF-8 stay. White space
/// becomes a blank; every other control character, marks that change the direction of writing, and bytes that are no
/// UTF-8 become '?'. Of more than 400 letters the first and the last 200 stay, with "..." between them.
HOGEL_API std::string printable(std::string_view text);

}  // namespace hogel
