// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <strings.h>

#include <algorithm>
#include <string>
#include <vector>

namespace hogel::core {

/// Returns the names of devices, each followed by its aliases.
template <class Device>
std::vector<std::string> device_names(const std::vector<Device>& devices) {
    std::vector<std::string> names;
    for (const Device& device : devices) {
        names.push_back(device.name);
        names.insert(names.end(), device.aliases.begin(), device.aliases.end());
    }
    return names;
}

/// Returns the device of this name, else the first with this alias, in upper or lower case; null if there is none.
template <class Device>
const Device* find_device(const std::vector<Device>& devices, const std::string& name) {
    const auto is_asked = [&](const std::string& word) { return strcasecmp(word.c_str(), name.c_str()) == 0; };
    auto found = std::ranges::find_if(devices, is_asked, &Device::name);
    if (found == devices.end())
        found = std::ranges::find_if(
            devices, [&](const Device& device) { return std::ranges::any_of(device.aliases, is_asked); });
    return found == devices.end() ? nullptr : &*found;
}

}  // namespace hogel::core
