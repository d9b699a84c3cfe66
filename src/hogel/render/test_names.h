// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

namespace hogel::render {

/// Names of tests have no hyphens.
inline std::string test_name(std::string name) {
    std::ranges::replace(name, '-', '_');
    return name;
}

}  // namespace hogel::render
