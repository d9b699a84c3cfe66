// SPDX-License-Identifier: Apache-2.0
#include "error_parameters.h"

namespace hogel::cli {

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

}  // namespace hogel::cli
