// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/exchange.h"

namespace hogel::exchange {

/// Linear light of a stored number, and back: decode(encode(x)) = x for 0 <= x <= 1.
float decode(Transfer transfer, float stored);
float encode(Transfer transfer, float linear);

}  // namespace hogel::exchange
