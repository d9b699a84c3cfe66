// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hogel/array.h"
#include "hogel/exchange/view_set.h"
#include "hogel/work/lru_cache.h"

namespace hogel::exchange {

/// Disparity of each pixel [y][x] of a view, in pixels: the shift to the left from a view to its right neighbour. The
/// shift up to the view below is the disparity times the ratio of the spacings. Larger values are nearer.
using DisparityMap = Array<float, 2>;

/// Returns the map as seen by another view, `across` views to the right and `down` views below (may be fractions).
/// Disoccluded pixels take the disparity of the background.
DisparityMap moved(const DisparityMap& map, double across, double down, double spacing_ratio);

/// Disparity of all views of a set, derived from one or more known maps.
class Disparities {
  public:
    /// @param known   maps of views (row, column), at least one
    /// @param kept    number of moved maps that are cached
    Disparities(std::vector<std::pair<std::pair<std::size_t, std::size_t>, DisparityMap>> known, double spacing_ratio,
                std::string origin, std::size_t kept);

    /// Returns the map of a view, or of a position between views: the nearest known map, moved there. Thread-safe.
    std::shared_ptr<const DisparityMap> at(double row, double column) const;
    const std::string& origin() const { return origin_; }
    bool is_estimate() const { return origin_ == estimate; }
    static constexpr const char* estimate = "an estimate";

  private:
    std::vector<std::pair<std::pair<std::size_t, std::size_t>, DisparityMap>> known_;
    double spacing_ratio_;
    std::string origin_;
    mutable work::LruCache<std::pair<double, double>, DisparityMap> moved_;
};

/// Loads the disparity maps in the folder of a set: PFM, EXR or NPY files with "disp" or "depth" in their names and the
/// size of the views. There is either one map, for the middle view, or one for each view, row by row. Depth is measured
/// from the camera plane in metres and needs the set's geometry. If there are no such files, reads PNG, PGM and TIFF
/// files of integers, with `scale` codes per metre or pixel; 0 marks an unknown pixel. Returns null if there is no map.
/// Caches `kept` maps. Throws Error(bad_input), naming the file, for values that are not finite or exceed the picture
/// size; Error(usage) for 16-bit maps without a scale.
std::shared_ptr<const Disparities> find_disparities(const std::filesystem::path& source, const ViewSet& set,
                                                    std::size_t kept, double scale = 0);

/// Estimates the disparity of the middle view by comparison with the views around it. Each pixel takes the candidate,
/// up to `max_disparity` pixels, with the lowest mean difference over the better half of the views.
DisparityMap estimate_disparity(const ViewSet& set, double max_disparity);
std::shared_ptr<const Disparities> estimated_disparities(const ViewSet& set, double max_disparity, std::size_t kept);

}  // namespace hogel::exchange
