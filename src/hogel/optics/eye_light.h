// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/field.h"
#include "hogel/optics/narrow_band/band_grid.h"
#include "hogel/optics/packed_band.h"

namespace hogel::optics {

/// An eye and the widest pupil, metres, through which it looks. A preview may leave out waves that pass far from the
/// pupil.
struct Eye {
    Vec3 position;
    double pupil = 0;
    bool preview = false;
};

/// The narrow bands of eyes: [eye][look].
using PackedBands = std::vector<std::vector<PackedBand>>;

/// Draws the light of a part of a hologram towards several eyes.
class EyeDrawing {
  public:
    virtual ~EyeDrawing() = default;
    /// The sampling of the narrow band of an eye.
    virtual const narrow_band::BandGrid& band(std::size_t eye) const = 0;
    /// The memory that a look to an eye takes while it is drawn.
    virtual double look_bytes(std::size_t eye) const { return PackedBand::bytes(band(eye).plane); }
    /// The narrow bands of looks [first_look, first_look + looks), as from draw_narrow_bands(). They do not depend on
    /// the number of threads; those from samples are drawn by all processes of a team, and the first one has them.
    virtual PackedBands draw(std::size_t first_look, std::size_t looks, const Progress& progress) const = 0;
};

/// The powers |wave|² of the waves of hogels side by side.
class WavePowers {
  public:
    virtual ~WavePowers() = default;
    /// Hogels across and down, and the samples along a side of one, which are as many as its waves.
    struct Counts {
        std::size_t across = 0, down = 0, samples = 0;
    };
    virtual Counts counts() const = 0;
    /// The powers of a part of the hogels, row by row: [hogel][row / 16][column][row mod 16] with frequencies 0 … n−1,
    /// zero in rows beyond n.
    /// @param part  counted in hogels
    virtual void read_powers(const Region& part, View<float, 2> out) const = 0;
};

/// A source of fields that knows the light towards an eye without computing its samples: a stereogram, of whose hogels
/// each sends an eye no more than a few numbers.
class EyeLight {
  public:
    virtual ~EyeLight() = default;
    /// The light of a part of the hologram; null where computing the samples costs less. Hogels that the part cuts
    /// belong to it.
    virtual std::unique_ptr<EyeDrawing> eye_drawing(const Region& part, std::span<const Eye> eyes) const = 0;
    /// The same for several colours of a hologram, of which this is one, if they need the same rays and these are not
    /// in memory: rays are made once for all colours. The bands of all eyes of the first colour, then of the next.
    /// Otherwise null.
    virtual std::unique_ptr<EyeDrawing> eye_drawing_of_colours(std::span<const EyeLight* const> /*colours*/,
                                                               const Region& /*part*/,
                                                               std::span<const Eye> /*eyes*/) const {
        return nullptr;
    }
    /// Computes what all eyes and looks share, the amplitudes of the waves, and keeps it, if that takes at most
    /// `memory` bytes. Not to be called while the field is read. Returns the bytes that are kept.
    virtual std::size_t keep_amplitudes(std::size_t memory) const = 0;
    /// Keeps the waves of the first look too, if amplitudes are kept; then this look of another eye takes less time. As
    /// keep_amplitudes().
    virtual std::size_t keep_waves(std::size_t /*memory*/) const { return 0; }
    /// The powers of the waves of all hogels if their phases are random and independent, so that the mean of infinitely
    /// many looks is a sum of their intensities; otherwise null.
    virtual const WavePowers* wave_powers() const { return nullptr; }
};

}  // namespace hogel::optics
