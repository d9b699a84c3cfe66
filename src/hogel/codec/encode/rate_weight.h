// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel::codec::encode {

// Rate weight λ: the squared error equivalent to one bit, in squared steps.
constexpr float lambda = 0.18f;

}  // namespace hogel::codec::encode
