// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hogel::core {

/// Limits of JSON that parse_json() accepts. Values are numbers, strings, literals, arrays and objects.
constexpr std::size_t max_json_values = std::size_t{1} << 22, max_json_depth = 100;

/// Parses JSON in time and memory linear in its length. Throws what `reject` throws, and Error(cancelled) on a stop
/// request.
/// @param reject  receives the first fault, such as "its JSON has an error at byte 7", and must throw. Faults are wrong
///                syntax, numbers out of range, duplicate keys of an object (parsers differ in which value they use),
///                more than max_json_values values, and nesting deeper than max_json_depth.
nlohmann::json parse_json(std::string_view text, const std::function<void(const std::string& fault)>& reject);

}  // namespace hogel::core
