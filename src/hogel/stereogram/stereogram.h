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

/// The window with which the samples of a hogel are multiplied.
enum class HogelWindow {
    none,
    hann,  ///< ½ + ½ cos 2π(j−c)/n
};

/// Hogels side by side, or windows around them.
struct HogelLayout {
    FieldGrid grid;                     ///< of the hologram
    std::size_t columns = 0, rows = 0;  ///< samples of a hogel, or of its window
    std::size_t overlap = 1;            ///< hogels that a window is wide and high
    HogelWindow window = HogelWindow::none;

    std::size_t across() const { return columns / overlap; }  ///< samples from hogel to hogel
    std::size_t down() const { return rows / overlap; }

    /// The hogels that have samples in a region, which is not empty.
    HogelRange range_of(const Region& region) const {
        const std::size_t s0 = region.x0 / across(), t0 = region.y0 / down();
        return {s0, t0, (region.x0 + region.width - 1) / across() + 1 - s0,
                (region.y0 + region.height - 1) / down() + 1 - t0};
    }
};

/// The rays from which hogels are made, where several colours may share them: rays that are made on demand, for all
/// channels together.
struct HogelRays {
    std::span<const LightField::Source> faces;
    bool with_depth = false;
    std::size_t bytes_a_hogel = 0;
    /// Reads the rays of a range, one tile for each face.
    std::function<void(const HogelRange& range, std::vector<LightFieldTile>& tiles)> read;
    /// Prepares the hogels of tiles, as Hogels::prepare().
    std::function<void(std::span<const LightFieldTile> tiles, View<float, 2> prepared)> prepare;
};

/// The hogels of a stereogram, each of which is the sum of the waves of its Fourier transform.
struct Hogels : HogelLayout {
    const HogelWaves* waves = nullptr;  ///< null: they are not known
    /// Computes what `waves` needs of a range, [hogel][waves->prepared_size()], row by row.
    std::function<void(const HogelRange& range, View<float, 2> prepared)> prepare;
    /// The prepared values of all hogels of the grid, row by row, where they are kept; otherwise no elements.
    View<const float, 2> kept = {};
    std::optional<HogelRays> rays = {};
};

/// A hologram that is made of hogels on demand. A camera may compute its light from the hogels, without the samples.
class Stereogram : public FieldSource {
  public:
    const Stereogram* stereogram() const final { return this; }
    /// Valid as long as this object, and until keep_amplitudes() keeps more.
    virtual Hogels hogels() const = 0;
    /// Computes what all looks share, the amplitudes of the waves, and keeps it, if that takes at most
    /// `memory` bytes. Not to be called while the field is read. Returns the bytes that are kept.
    virtual std::size_t keep_amplitudes(std::size_t /*memory*/) const { return 0; }
};

}  // namespace hogel::stereogram
