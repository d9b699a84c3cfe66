// SPDX-License-Identifier: Apache-2.0
#include "result.h"

#include <fmt/format.h>

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
        [](const auto& content) -> Json {
            using Content = std::remove_cvref_t<decltype(content)>;
            if constexpr (std::same_as<Content, ResultList>) {
                Json list = Json::array();
                for (const ResultValue& each : content) list.push_back(json_of(each));
                return list;
            } else if constexpr (std::same_as<Content, Result>) {
                return json_of(content);
            } else {
                return content;
            }
        },
        value.get());
}

}  // namespace

// The JSON library escapes only control characters below 32. Escapes those from 127 to 159 too, which terminals
// interpret; they occur only in strings.
std::string to_json(const Result& result) {
    const std::string plain = json_of(result).dump(2, ' ', false, Json::error_handler_t::replace);
    std::string text;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const unsigned code = static_cast<unsigned char>(plain[i]);
        const unsigned next = i + 1 < plain.size() ? static_cast<unsigned char>(plain[i + 1]) : 0;
        if (code == 0x7F)
            text += "\\u007f";
        else if (code == 0xC2 && next < 0xA0)
            text += fmt::format("\\u{:04x}", static_cast<unsigned char>(plain[++i]));
        else
            text += plain[i];
    }
    return text;
}

}  // namespace hogel::cli
