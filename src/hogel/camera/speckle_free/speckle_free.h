// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/camera/speckle_free/wave_powers.h"
#include "hogel/photograph.h"

namespace hogel::camera::speckle_free {

/// Photographs the mean of infinitely many looks of a stereogram whose waves have independent random phases: the sum of
/// the intensities of all waves, without speckle. The spots of a hogel's waves on the film are sums of those of a few
/// waves (PsfBasis), so each hogel is worth some eighty numbers to an eye, which all focuses share, and a pixel is the
/// product of those of the hogels around it and a table of spots. Light that falls beyond five resolution cells beside
/// a hogel's picture is spread as the diffraction of the pupil's rim, by the third power of the distance.
///
/// Pictures are added to. Memory: the numbers of all hogels for all eyes, or of bands of rows of hogels. Throws
/// Error(usage) as photograph() does.
void photograph(const FieldSource& hologram, const WavePowers& waves, std::span<const Camera> cameras,
                const SpeckleFreeCamera& model, std::span<Image> pictures, const Progress& progress);

/// Resources of photograph(): the numbers, and products of numbers and spots.
Plan plan(const FieldGrid& hologram, const WavePowers::Counts& counts, std::span<const Camera> cameras,
          const SpeckleFreeCamera& model);

}  // namespace hogel::camera::speckle_free
