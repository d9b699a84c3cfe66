// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/light_field.h"

namespace hogel::bench {

/// A hogel's column and row in a light field.
struct HogelPlace {
    std::size_t s = 0, t = 0;
};

/// Rows of hogels spread over a light field, with their samples. They are rendered on all threads in tiles of the width
/// that the renderer prefers, with which an epipolar renderer reaches its full speed in little memory. The tiles are
/// reused in each run.
class HogelRows {
  public:
    HogelRows(const LightFieldSource& source, std::size_t rows);

    void render();
    std::size_t hogels() const { return places_.size() * source_.grid().hogels_s; }
    double rays() const { return static_cast<double>(hogels() * source_.grid().directions()); }
    /// `count` of the hogels, spread evenly over all of them.
    std::vector<HogelPlace> some(std::size_t count) const;
    /// A sample of one of the hogels; the light field must have three channels.
    Rgb sample(HogelPlace hogel, std::size_t v, std::size_t u) const;
    std::vector<LightFieldTile>& tiles() { return tiles_; }

  private:
    const LightFieldSource& source_;
    std::vector<std::size_t> places_;  // t
    std::vector<LightFieldTile> tiles_;
};

}  // namespace hogel::bench
