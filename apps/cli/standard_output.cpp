// SPDX-License-Identifier: Apache-2.0
#include "standard_output.h"

#include <cerrno>
#include <cstdio>

#include "hogel/error.h"

namespace hogel::cli {

void require_written(bool written) {
    if (written) return;
    if (errno == EPIPE) throw ClosedPipe();
    throw Error(ErrorCode::cannot_write, "cannot write to the standard output");
}

void write_standard_output(const std::string& text) {
    require_written(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

}  // namespace hogel::cli
