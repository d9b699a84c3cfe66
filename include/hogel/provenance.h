// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hogel/camera.h"
#include "hogel/export.h"

namespace hogel {

/// Keys and texts stored in a file, each key once: the version and the options that made it.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// The origin of a light field, field or picture. Functions that open a file read it, functions that derive a value
/// copy it, and functions that write a file store it.
struct Provenance {
    Metadata entries;              ///< such as {"scene", "pumpkin"}
    std::optional<Camera> camera;  ///< camera that took the picture, or one that suits the light field or field

    friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// Returns the entries of a value made from another: `now`, then `before`. The names of the earlier command and its
/// options get the prefix "source ", and so does any name of `before` that `now` has with another text.
HOGEL_API Metadata with_history(Metadata now, const Metadata& before);

/// Converts a provenance to the metadata of a file and back: its entries and, if it has a camera, one entry "camera".
/// An entry "camera" that cannot be parsed stays an entry.
HOGEL_API Metadata to_metadata(const Provenance& provenance);
HOGEL_API Provenance to_provenance(Metadata metadata);

/// Converts the radiance of rays that meet nothing to a metadata entry and back. Rendering adds the entry for a
/// background that is not black; without an entry the background is black. automatic_exposure() ignores such pixels.
HOGEL_API std::pair<std::string, std::string> background_entry(Rgb background);
HOGEL_API Rgb background_of(const Provenance& provenance);

/// Converts a camera to text with all digits and back: "eye 0 0 0.3 focus 0 0 0 pupil 0.005 picture 400 400 5e-05 5e-05
/// 0 0". Lengths are in metres. The focus is the depth and the two slopes of the plane in focus. The picture is the
/// grid: columns, rows, pitches, centre. parse_camera() returns nothing for text that is not a valid camera.
HOGEL_API std::string describe(const Camera& camera);
HOGEL_API std::optional<Camera> parse_camera(const std::string& text);

}  // namespace hogel
