// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "hogel/light_field.h"

namespace hogel::cli {

/// Where a hogel stands in a light field.
struct HogelPlace {
    std::size_t s = 0, t = 0;
};

/// Rows of hogels spread over a light field, and their samples, rendered in parts as long as the renderer prefers on
/// all threads: what an epipolar renderer needs to show how fast it is, and no more. The memory is kept from run to
/// run.
class HogelRows {
  public:
    HogelRows(const LightFieldSource& source, std::size_t rows);

    void render();
    std::size_t hogels() const { return places_.size() * source_.grid().hogels_s; }
    double rays() const { return static_cast<double>(hogels() * source_.grid().directions()); }
    /// So many of the hogels, spread evenly over all of them.
    std::vector<HogelPlace> some(std::size_t count) const;
    /// Of one of the hogels; of three channels.
    Rgb sample(HogelPlace hogel, std::size_t v, std::size_t u) const;
    std::vector<LightFieldTile>& tiles() { return tiles_; }

  private:
    const LightFieldSource& source_;
    std::vector<std::size_t> places_;  // t
    std::vector<LightFieldTile> tiles_;
};

/// Seconds that work took: by the clock, and of processor time on all threads together.
struct Times {
    double wall = 0, processor = 0;
};
Times time_of(const std::function<void()>& work);

double median(std::vector<double> values);

}  // namespace hogel::cli
