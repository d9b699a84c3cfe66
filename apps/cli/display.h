// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

#include "hogel/array.h"
#include "hogel/image.h"

namespace hogel::cli {

/// Intensities as their logarithm: four decades below the brightest become the greys from black to white of a display.
Image logarithmic(const Image& intensities);

/// The phases of a field as greys of a display, black at −π and white at π.
Image phases(View<const std::complex<float>, 2> field);

}  // namespace hogel::cli
