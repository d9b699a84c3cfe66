// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/light_field.h"

namespace hogel::bench {

/// How bright the surfaces of a dense light field are.
enum class Brightness {
    even,  ///< 0 to 1
    high,  ///< each ellipse its own, over a range of 10⁵
};

/// A light field for measuring coders: textured ellipses at various slants that hide each other, in front of a textured
/// ground. Hogels are so close together that what they show moves by at most two directions from one to the next. Each
/// sample is computed in closed form where it is read.
/// @param grid  only its counts matter; the light field has one channel
std::unique_ptr<LightFieldSource> make_dense_field(const LightFieldGrid& grid, Brightness brightness);

}  // namespace hogel::bench
