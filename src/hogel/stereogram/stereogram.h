// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hogel/field.h"
#include "hogel/light_field.h"
#include "hogel/stereogram/hogel_synthesis.h"

namespace hogel::stereogram {

/// Window that multiplies the samples of a hogel.
enum class HogelWindow {
    none,
    hann,  ///< ½ + ½ cos 2π(j−c)/n
};

/// Layout of hogels side by side, or of windows around them.
struct HogelLayout {
    FieldGrid grid;                     ///< of the hologram
    std::size_t columns = 0, rows = 0;  ///< samples of a hogel, or of its window
    std::size_t overlap = 1;            ///< width and height of a window in hogels
    HogelWindow window = HogelWindow::none;

    std::size_t across() const { return columns / overlap; }  ///< samples from hogel to hogel
    std::size_t down() const { return rows / overlap; }

    /// Returns the hogels with samples in a region, which must not be empty.
    HogelRange range_of(const Region& region) const {
        const std::size_t s0 = region.x0 / across(), t0 = region.y0 / down();
        return {s0, t0, (region.x0 + region.width - 1) / across() + 1 - s0,
                (region.y0 + region.height - 1) / down() + 1 - t0};
    }
};

/// Rays of hogels that are read on demand, all channels at once, so that several colours can share them.
struct HogelRays {
    std::span<const LightField::Source> faces;
    bool with_depth = false;
    std::size_t bytes_a_hogel = 0;
    /// Reads the rays of a range, one tile per face.
    std::function<void(const HogelRange& range, std::vector<LightFieldTile>& tiles)> read;
    /// Prepares the hogels of tiles, as Hogels::prepare().
    std::function<void(std::span<const LightFieldTile> tiles, View<float, 2> prepared)> prepare;
};

/// Hogels of a stereogram. Each is the sum of the waves of its Fourier transform.
struct Hogels : HogelLayout {
    const HogelWaves* waves = nullptr;  ///< null if the waves are unknown
    /// Computes the values that `waves` needs of a range, [hogel][waves->prepared_size()], row-major.
    std::function<void(const HogelRange& range, View<float, 2> prepared)> prepare;
    /// Prepared values of all hogels of the grid, row-major, if they are stored; otherwise empty.
    View<const float, 2> kept = {};
    std::optional<HogelRays> rays = {};
};

/// Hologram computed from hogels on demand. Cameras may compute pupil bands without its samples.
class Stereogram : public FieldSource {
  public:
    const Stereogram* stereogram() const final { return this; }
    /// Returns the hogels. Valid as long as this object, until keep_amplitudes() stores more.
    virtual Hogels hogels() const = 0;
    /// Computes and stores the amplitudes of the waves, which all looks share, if they take at most `memory` bytes.
    /// Returns the number of bytes stored. Must not run while the field is read.
    virtual std::size_t keep_amplitudes(std::size_t /*memory*/) const { return 0; }
};

}  // namespace hogel::stereogram
