// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera/narrow_band/band_grid.h"
#include "hogel/camera/packed_band.h"
#include "hogel/field.h"

namespace hogel::camera {

/// Position of a lens and the diameter of its widest pupil, metres. A preview may skip waves far outside the pupil.
struct Viewpoint {
    Vec3 position;
    double pupil = 0;
    bool preview = false;
};

/// Indexed by [viewpoint][look].
using PackedBands = std::vector<std::vector<PackedBand>>;

/// Source of the pupil bands of a part of a hologram, for several viewpoints.
class PupilBandSource {
  public:
    virtual ~PupilBandSource() = default;
    virtual const narrow_band::BandGrid& band(std::size_t viewpoint) const = 0;
    /// Returns the bytes that one look takes during synthesis.
    virtual double bytes_per_look(std::size_t viewpoint) const { return PackedBand::bytes(band(viewpoint).plane); }
    /// Synthesises the bands of looks [first_look, first_look + looks), as compute_narrow_bands() does. The result does
    /// not depend on the number of threads. All ranks share the computation from samples, and only the root receives
    /// the result.
    virtual PackedBands synthesize(std::size_t first_look, std::size_t looks, const Progress& progress) const = 0;
};

}  // namespace hogel::camera
