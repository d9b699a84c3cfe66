// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/require_positive.h"

#include <fmt/format.h>

#include <cmath>

namespace hogel::core {

void require_positive(double value, const char* parameter, ErrorCode code, const std::string& what,
                      const char* member) {
    if (!(std::isfinite(value) && value > 0))
        throw Error(code, parameter, fmt::format("{}: {} is {}, but must be positive and finite", what, member, value));
}

}  // namespace hogel::core
