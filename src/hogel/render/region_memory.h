#pragma once

#include <string_view>

#include "hogel/lightfield/light_field.h"

namespace hogel {

/// What a renderer allocates to render a region of hogels at once, besides the tile that takes its values: the depth
/// buffer of `simplex`, `simplex-strip`, `simplex3d` and `oblique`, in bytes. Nothing for those whose memory does not
/// grow with the region.
double depth_buffer_bytes(std::string_view algorithm, const LightFieldGrid& grid, const HogelRange& region);

}  // namespace hogel
