// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hogel/error.h"

namespace hogel::cli {

/// The names in Error::parameter().
std::vector<std::string> names_of_parameters(const std::string& parameters);

/// The same with other names, see with_renamed_parameters().
std::string renamed_parameters(const std::string& parameters,
                               std::span<const std::pair<std::string_view, std::string_view>> names);

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

/// Calls the work. In parameters of an Error the first name of each pair becomes the second, which is what the command
/// calls it, or several, "hogels, size", or empty if the command does not set it here.
template <class Work>
auto with_renamed_parameters(std::initializer_list<std::pair<std::string_view, std::string_view>> names,
                             const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code(), renamed_parameters(error.parameter(), names), error.what());
    }
}

}  // namespace hogel::cli
