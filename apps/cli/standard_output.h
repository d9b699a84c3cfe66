// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace hogel::cli {

/// Thrown if the standard output is a closed pipe. The program then ends without a message, as with SIGPIPE.
struct ClosedPipe {};

/// Throws ClosedPipe or Error(cannot_write) if `written` is false, according to errno.
void require_written(bool written);
/// Writes to the standard output. Throws as require_written() does.
void write_standard_output(const std::string& text);

}  // namespace hogel::cli
