// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hogel::core {

/// Bounds of JSON that parse_json() accepts. Values are numbers, texts, literals, arrays and objects.
constexpr std::size_t max_json_values = std::size_t{1} << 22, max_json_depth = 100;

/// Parses JSON from a file. Time and memory grow linearly with the length of the text.
/// @param reject  Receives the first fault, such as "its JSON has an error at byte 7", and must throw. Faults are wrong
///                syntax, numbers out of range, a key that occurs twice in an object (readers differ in which they
///                take), more than max_json_values values, and nesting deeper than max_json_depth.
/// Throws what `reject` throws, and Error(cancelled) when the work of this thread is to stop.
nlohmann::json parse_json(std::string_view text, const std::function<void(const std::string& fault)>& reject);

}  // namespace hogel::core
