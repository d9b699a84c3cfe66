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

/// Serialises to one line.
std::string dump(const Json& json);

/// Returns the response to a failed request.
/// @param parameter  names from Error::parameter(); the page marks their controls
Response failure(unsigned status, const std::string& why, const std::vector<std::string>& parameter = {});
Response failure(const Error& error);
/// Returns a successful response.
Response answer_with(const Json& json);

/// Encodes a picture as a file in the format of the query.
std::string encode(const Photograph& photograph, const PictureQuery& query);
/// Returns the media type of that file, such as "image/png".
std::string type_of(const PictureQuery& query);
/// Describes a picture for the page. @param seconds  computing time so far
Json to_json(const Photograph& photograph, const PictureQuery& query, const Viewable& viewable, double seconds);
Json to_json(const Reading& reading, const std::string& id);
Json to_json(const FocusSearch& search);
Json to_json(const LevelCounts& levels);

/// Calls `work`; passes an error response to `refuse` if it throws.
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
