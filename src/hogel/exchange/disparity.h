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

/// The disparity of each pixel [y][x] of a view: by how many pixels what it shows moves to the left from a view to the
/// one on its right, and, times the ratio of the spacings, up to the one below. Larger is nearer.
using DisparityMap = Array<float, 2>;

/// A map as another view sees it, `across` views to the right and `down` views below (fractions too). What comes into
/// sight is taken to be as far as what lies behind it.
DisparityMap moved(const DisparityMap& map, double across, double down, double spacing_ratio);

/// The disparity of all views of a set, of which one or more are known.
class Disparities {
  public:
    /// @param known  maps of views (row, column), at least one
    Disparities(std::vector<std::pair<std::pair<std::size_t, std::size_t>, DisparityMap>> known, double spacing_ratio,
                std::string origin, std::size_t kept);

    /// That of a view, or of one between views: the map of the nearest one that is known, moved there. Thread-safe.
    std::shared_ptr<const DisparityMap> at(double row, double column) const;
    /// Where it comes from: "gt_disp_lowres.pfm".
    const std::string& origin() const { return origin_; }
    bool is_estimate() const { return origin_ == estimate; }
    static constexpr const char* estimate = "an estimate";

  private:
    std::vector<std::pair<std::pair<std::size_t, std::size_t>, DisparityMap>> known_;
    double spacing_ratio_;
    std::string origin_;
    mutable work::LruCache<std::pair<double, double>, DisparityMap> moved_;
};

/// The disparity that comes with a set in its folder: PFM, EXR or NPY files with "disp" or "depth" in their names, of
/// the size of the views; one for the view in the middle, or as many as there are views, counted row by row. Depth is
/// that of points from the plane of the cameras, in metres, and needs the set's geometry. Where there are none, PNG,
/// PGM and TIFF files of whole numbers, of which `scale` are a metre or a pixel, and 0 is a pixel that is not known.
/// Nothing where there is no map. `kept` maps are held at a time. Throws Error(bad_input), naming the file, for samples
/// that are not finite or larger than pictures; Error(usage) for 16-bit maps without a scale.
std::shared_ptr<const Disparities> find_disparities(const std::filesystem::path& source, const ViewSet& set,
                                                    std::size_t kept, double scale = 0);

/// The disparity of the view in the middle, found by comparing it with those around it: for each pixel the one of
/// candidates up to `max_disparity` at which the half of them that agree best differ least.
DisparityMap estimate_disparity(const ViewSet& set, double max_disparity);
std::shared_ptr<const Disparities> estimated_disparities(const ViewSet& set, double max_disparity, std::size_t kept);

}  // namespace hogel::exchange
