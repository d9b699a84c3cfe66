// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hogel/camera.h"
#include "hogel/export.h"

namespace hogel {

/// Keys and texts stored inside a file, each key once: the version and the options that made it.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// The origin of a light field, a field or a picture. It is passed on with the value: functions that open a file read
/// it, functions that make one value from another copy it, and functions that write a file store it.
struct Provenance {
    Metadata entries;              ///< for example {"scene", "pumpkin"}
    std::optional<Camera> camera;  ///< the one that took a picture, or one that suits a light field or a field

    friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// The entries of a value made from another: `now`, then `before`, where "source " precedes the names of the earlier
/// command and its options, and any name that is taken with another text.
HOGEL_API Metadata with_history(Metadata now, const Metadata& before);

/// Converts a provenance to the metadata of a file and back: its entries and, if it has a camera, one entry "camera".
/// An entry "camera" that cannot be parsed remains an entry.
HOGEL_API Metadata to_metadata(const Provenance& provenance);
HOGEL_API Provenance to_provenance(Metadata metadata);

/// The entry that says which radiance rays have that meet nothing, which what renders a scene adds for a background
/// that is not black; and that radiance again, black where there is no such entry. automatic_exposure() passes it over.
HOGEL_API std::pair<std::string, std::string> background_entry(Rgb background);
HOGEL_API Rgb background_of(const Provenance& provenance);

/// Converts a camera to a text with all digits and back: "eye 0 0 0.3 focus 0 0 0 pupil 0.005 picture 400 400 5e-05
/// 5e-05 0 0". Lengths are in metres; the focus is the depth and the two slopes of the plane in focus; the picture is
/// its grid (columns, rows, pitches, centre). parse_camera() returns nothing for a text that is not a camera accepted
/// by validate().
HOGEL_API std::string describe(const Camera& camera);
HOGEL_API std::optional<Camera> parse_camera(const std::string& text);

}  // namespace hogel
