// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hogel/error.h"

namespace hogel::cli {

/// The names in Error::parameter().
std::vector<std::string> names_of_parameters(const std::string& parameters);

/// Calls the work. An Error(usage) that names no parameter gets this one: "hogels, directions".
template <class Work>
auto with_parameter(const std::string& parameter, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        if (!error.parameter().empty()) throw;
        throw Error(error.code(), parameter, error.what());
    }
}

/// Calls the work. An Error about the parameter `name` becomes one about `local`, which is what the command calls it,
/// or empty if the command does not set it here.
template <class Work>
auto with_renamed_parameter(std::string_view name, std::string_view local, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        std::string renamed;
        for (const std::string& each : names_of_parameters(error.parameter())) {
            const std::string_view called = each == name ? local : std::string_view(each);
            if (!called.empty()) renamed.append(renamed.empty() ? "" : ", ").append(called);
        }
        throw Error(error.code(), renamed, error.what());
    }
}

}  // namespace hogel::cli
