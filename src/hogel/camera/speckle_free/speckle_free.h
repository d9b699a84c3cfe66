// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/camera/speckle_free/wave_powers.h"
#include "hogel/photograph.h"

namespace hogel::camera::speckle_free {

/// Photographs the mean of infinitely many looks of a stereogram with independent random phases: the sum of the
/// intensities of all waves, without speckle. PsfBasis expands the PSFs of a hogel's waves in those of a few node
/// waves. A hogel then has about eighty numbers per viewpoint, which all focuses share. A pixel is the product of the
/// numbers of the hogels around it and a table of PSFs. Light beyond five resolution cells from a hogel's picture is
/// spread like the diffraction at the pupil's rim, by the third power of the distance.
///
/// Adds to `pictures`. Memory: the numbers of all hogels for all viewpoints, or of bands of rows of hogels. Throws
/// Error(usage) as photograph() does.
void photograph(const FieldSource& hologram, const WavePowers& waves, std::span<const Camera> cameras,
                const SpeckleFreeCamera& model, std::span<Image> pictures, const Progress& progress);

Plan plan(const FieldGrid& hologram, const WavePowers::Counts& counts, std::span<const Camera> cameras,
          const SpeckleFreeCamera& model);

}  // namespace hogel::camera::speckle_free
