// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace hogel::view {

/// Opens an address with xdg-open. Returns false if there is no display or xdg-open cannot be started.
bool open_browser(const std::string& address);

}  // namespace hogel::view
