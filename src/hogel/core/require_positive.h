// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hogel/error.h"

namespace hogel::core {

/// Throws Error(code) about a parameter unless the value is positive and finite.
/// @param what    subject of the message: "light field"
/// @param member  name of the value in the message: "the wavelength"
void require_positive(double value, const char* parameter, ErrorCode code, const std::string& what, const char* member);

}  // namespace hogel::core
