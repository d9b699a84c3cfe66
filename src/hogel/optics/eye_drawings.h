// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "hogel/optics/eye_light.h"
#include "hogel/photograph.h"

namespace hogel::optics {

/// The drawing of a part of a field towards eyes: from its hogels if it knows them, that costs less and `from` allows
/// it, otherwise from its samples. Throws Error(usage) where hogels are asked for and cannot be used.
/// @param window  the part as a field of its own; it and `whole` must live as long as the drawing
std::unique_ptr<EyeDrawing> draw_eyes(const FieldSource& whole, const Region& part, const FieldSource& window,
                                      std::span<const Eye> eyes, LightFrom from);

}  // namespace hogel::optics
