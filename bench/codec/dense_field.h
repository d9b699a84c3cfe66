// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/light_field.h"

namespace hogel::bench {

enum class Brightness {
    even,  ///< 0 to 1
    high,  ///< different for each ellipse, over a range of 10⁵
};

/// Returns a light field for measuring coders: textured ellipses at various slants that occlude each other, in front of
/// a textured background. Hogels are so dense that disparities are at most two directions. Samples are computed in
/// closed form when they are read.
/// @param grid  only its counts are used; the light field has one channel
std::unique_ptr<LightFieldSource> make_dense_field(const LightFieldGrid& grid, Brightness brightness);

}  // namespace hogel::bench
