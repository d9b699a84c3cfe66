// SPDX-License-Identifier: Apache-2.0
#include "result.h"

#include <nlohmann/json.hpp>

namespace hogel::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ResultValue& value);

Json json_of(const Result& result) {
    Json object = Json::object();
    for (const auto& [name, value] : result) object[name] = json_of(value);
    return object;
}

Json json_of(const ResultValue& value) {
    return std::visit(
        [](const auto& held) -> Json {
            using Held = std::remove_cvref_t<decltype(held)>;
            if constexpr (std::same_as<Held, ResultList>) {
                Json list = Json::array();
                for (const ResultValue& each : held) list.push_back(json_of(each));
                return list;
            } else if constexpr (std::same_as<Held, Result>) {
                return json_of(held);
            } else {
                return held;
            }
        },
        value.get());
}

}  // namespace

std::string to_json(const Result& result) {
    return json_of(result).dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hogel::cli
