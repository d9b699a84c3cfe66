// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/light_field.h"

namespace hogel::bench {

struct HogelIndex {
    std::size_t s = 0, t = 0;
};

/// Rows of hogels spread over a light field, with their samples. All threads render them in tiles of the renderer's
/// preferred width, for full speed in little memory. The tiles are reused in each run.
class HogelRows {
  public:
    HogelRows(const LightFieldSource& source, std::size_t rows);

    void render();
    std::size_t hogels() const { return rows_.size() * source_.grid().hogels_s; }
    double rays() const { return static_cast<double>(hogels() * source_.grid().directions()); }
    /// Returns `count` of the hogels, spread evenly over all of them.
    std::vector<HogelIndex> subset(std::size_t count) const;
    /// Returns a sample of one of the hogels; the light field must have three channels.
    Rgb sample(HogelIndex hogel, std::size_t v, std::size_t u) const;
    std::vector<LightFieldTile>& tiles() { return tiles_; }

  private:
    const LightFieldSource& source_;
    std::vector<std::size_t> rows_;  // t of each row
    std::vector<LightFieldTile> tiles_;
};

}  // namespace hogel::bench
