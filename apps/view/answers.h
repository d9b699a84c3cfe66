// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hogel/error.h"
#include "view/server.h"
#include "view/viewable.h"

namespace hogel::view {

using Json = nlohmann::ordered_json;

inline constexpr const char* json_type = "application/json";

/// A line.
std::string dump(const Json& json);

/// @param parameter  names of Error::parameter(), by which the page marks its controls
Response failure(unsigned status, const std::string& why, const std::vector<std::string>& parameter = {});
Response failure(const Error& error);
/// An answer of a job, by which a page learns of it too.
Response answer_with(const Json& json);

/// The file of a picture in the view's format.
std::string encode(const Photograph& photograph, const View& view);
/// The type of that file: "image/png".
std::string type_of(const View& view);
/// What the page is told of it. @param seconds  that it took so far
Json to_json(const Photograph& photograph, const View& view, const Viewable& viewable, double seconds);
Json to_json(const Reading& reading, const std::string& id);
Json to_json(const FocusSearch& search);
Json to_json(const LevelCounts& levels);

/// Does the work of a job, which throws nothing then; gives `refuse` the answer that says what went wrong.
template <class Work, class Refuse>
void attempt(const Work& work, const Refuse& refuse) {
    try {
        work();
    } catch (const Error& error) {
        refuse(failure(error));
    } catch (const std::exception& error) {
        refuse(failure(500, error.what()));
    }
}

}  // namespace hogel::view
