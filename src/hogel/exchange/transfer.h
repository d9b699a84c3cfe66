// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/exchange.h"

namespace hogel::exchange {

/// Converts a stored number to linear light, and back: decode(encode(x)) = x for 0 <= x <= 1.
float decode(Transfer transfer, float stored);
float encode(Transfer transfer, float linear);

}  // namespace hogel::exchange
