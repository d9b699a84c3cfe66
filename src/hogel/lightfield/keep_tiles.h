#pragma once

#include <memory>

#include "hogel/lightfield/light_field.h"

namespace hogel {

/// The same light field, for readers whose tiles suit the source badly, such as narrow ones of a renderer that is fast
/// in long rows: it is read in tiles that suit, and those used last are kept, `bytes` of them at most. Where the tiles
/// that a reader asks for would not fit, it reads from the source itself. Depths are kept if `with_depth`, else read
/// from the source.
std::unique_ptr<LightFieldSource> keep_tiles(std::unique_ptr<LightFieldSource> source, double bytes,
                                             bool with_depth = false);

}  // namespace hogel
