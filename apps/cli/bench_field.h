// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/light_field.h"

namespace hogel::cli {

/// Light fields that are made for measuring coders: textured ellipses that hide each other, at all slants, in front of
/// a textured ground, seen by hogels so close together that what they show moves by two directions at most from one to
/// the next. In closed form, so any size costs nothing to keep.
enum class Brightness {
    even,  ///< 0 to 1
    high,  ///< ellipses of their own brightness each, over a range of 10⁵
};

/// One channel; of the grid only the counts matter.
std::unique_ptr<LightFieldSource> make_dense_field(const LightFieldGrid& grid, Brightness brightness);

}  // namespace hogel::cli
