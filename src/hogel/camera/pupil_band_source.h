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

/// An eye and the widest pupil, metres, through which it looks. A preview may leave out waves that pass far from the
/// pupil.
struct Viewpoint {
    Vec3 position;
    double pupil = 0;
    bool preview = false;
};

/// The narrow bands of eyes: [eye][look].
using PackedBands = std::vector<std::vector<PackedBand>>;

/// Draws the light of a part of a hologram towards several eyes.
class PupilBandSource {
  public:
    virtual ~PupilBandSource() = default;
    /// The sampling of the narrow band of an eye.
    virtual const narrow_band::BandGrid& band(std::size_t eye) const = 0;
    /// The memory that a look to an eye takes while it is drawn.
    virtual double bytes_per_look(std::size_t eye) const { return PackedBand::bytes(band(eye).plane); }
    /// The narrow bands of looks [first_look, first_look + looks), as from draw_narrow_bands(). They do not depend on
    /// the number of threads; those from samples are drawn by all processes of a team, and the first one has them.
    virtual PackedBands draw(std::size_t first_look, std::size_t looks, const Progress& progress) const = 0;
};

}  // namespace hogel::camera
