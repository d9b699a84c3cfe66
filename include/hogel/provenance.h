// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hogel/camera.h"
#include "hogel/export.h"

namespace hogel {

/// Keys and texts that are kept inside a file, each key once: the options and the version that made it.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Where a light field, a field or a picture comes from. It travels with the value: what opens a file reads it, what
/// makes one value from another hands it on, and what writes a file keeps it there.
struct Provenance {
    Metadata entries;              ///< such as {"scene", "pumpkin"}
    std::optional<Camera> camera;  ///< that took a picture, or that suits a light field or a field

    friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// The entries of something that was made from something else: `now`, then all of `before`. An entry of `before` whose
/// key is there already gets "source " in front of it, as often as makes it different, unless the texts are equal.
HOGEL_API Metadata with_history(Metadata now, const Metadata& before);

/// What files keep of a provenance: its entries and, if it has a camera, one entry "camera". And back; an entry
/// "camera" that cannot be read remains an entry.
HOGEL_API Metadata to_metadata(const Provenance& provenance);
HOGEL_API Provenance to_provenance(Metadata metadata);

/// A camera in words, with all digits: "eye 0 0 0.3 focus 0 0 0 pupil 0.005 picture 400 400 5e-05 5e-05 0 0": metres,
/// the depth and the two slopes of the plane in focus, and the grid of the picture (columns, rows, pitches, middle).
/// And back; nothing where a text is no camera that validate() accepts.
HOGEL_API std::string describe(const Camera& camera);
HOGEL_API std::optional<Camera> parse_camera(const std::string& text);

}  // namespace hogel
