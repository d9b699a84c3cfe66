// SPDX-License-Identifier: Apache-2.0
#include "hogel/parameters.h"

#include <algorithm>

namespace hogel {

std::vector<std::string> names_of_parameters(const std::string& parameters) {
    constexpr std::string_view separator = ", ";
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin < parameters.size();) {
        const std::size_t end = std::min(parameters.find(separator, begin), parameters.size());
        names.push_back(parameters.substr(begin, end - begin));
        begin = end + separator.size();
    }
    return names;
}

std::string renamed_parameters(const std::string& parameters,
                               std::span<const std::pair<std::string_view, std::string_view>> names) {
    std::string renamed;
    for (const std::string& name : names_of_parameters(parameters)) {
        std::string_view local = name;
        for (const auto& [from, to] : names)
            if (from == name) local = to;
        if (!local.empty()) renamed.append(renamed.empty() ? "" : ", ").append(local);
    }
    return renamed;
}

}  // namespace hogel
