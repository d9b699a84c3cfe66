// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel::codec::encode {

// The rate weight λ: the squared error that a bit is worth, in squared steps.
constexpr float lambda = 0.18f;

}  // namespace hogel::codec::encode
