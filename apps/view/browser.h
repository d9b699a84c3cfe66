// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace hogel::view {

/// Opens an address in the desktop's browser with xdg-open, where there is a desktop. Returns whether it was asked to.
bool open_browser(const std::string& address);

}  // namespace hogel::view
