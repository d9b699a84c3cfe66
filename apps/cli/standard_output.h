// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace hogel::cli {

/// Thrown where nobody reads the standard output any more. The program then ends without a word, as SIGPIPE ends
/// others.
struct ClosedPipe {};

/// Throws ClosedPipe, or Error(cannot_write), after a write to the standard output that failed; errno says why.
void require_written(bool written);
/// Writes to the standard output. Throws as require_written() does.
void write_standard_output(const std::string& text);

}  // namespace hogel::cli
