// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "hogel/image.h"
#include "hogel/pipeline.h"
#include "view/query.h"

namespace hogel::view {

/// What is known of the ray that a spot of a picture shows.
struct Reading {
    double x = 0, y = 0;              ///< where it crosses the hologram, metres
    double across = 0, up = 0;        ///< its direction behind the hologram, radians to the right and up
    bool inside = false;              ///< whether the light field has it; the rest is known then
    std::array<float, 3> radiance{};  ///< of the nearest sample; equal for grey
    std::optional<double> depth;      ///< metres behind the hologram, where the light field knows it
};

/// A light field that is looked at: its samples in memory, in the order that eyes want them.
class Subject {
  public:
    /// Reads `shown`, which is `light_field` or some hogels of it; readings come from `light_field` itself.
    Subject(LightField light_field, LightField shown, std::size_t memory, const Progress& progress);

    const LightFieldGrid& grid() const { return light_field_.grid(); }
    const LightFieldGrid& shown() const { return shown_; }
    bool has_depth() const { return light_field_.has_depth(); }
    /// The automatic exposure of the view from the front, the same for all, so that nothing flickers.
    double exposure() const { return exposure_; }

    /// The camera of `hogel photo` with those options. Throws Error(usage).
    Camera camera(const View& view) const;
    /// The picture that `hogel photo --geometric` takes, in linear light; with display=log its logarithm; of two eyes
    /// both pictures. One at a time. Throws Error(cancelled).
    Image photograph(const View& view, const Progress& progress);
    /// The factor with which it is shown.
    double exposure(const View& view) const {
        return view.logarithmic ? 1 : view.exposure > 0 ? view.exposure : exposure_;
    }

    Reading read(const View& view, const Spot& spot) const;
    /// The depth of what lies at a spot: as the light field knows it, otherwise where a few pixels around the spot are
    /// sharpest.
    double focus(const View& view, const Spot& spot, const Progress& progress);

  private:
    double sharpest(const View& view, const Spot& spot, const Progress& progress);

    LightField light_field_;
    LightFieldGrid shown_;
    RayPhotographer photographer_;
    double exposure_ = 1;
};

/// The step between hogels at which a light field's samples fit into `memory` as halves.
std::size_t step_that_fits(const LightFieldGrid& grid, std::size_t memory);
/// The step for a first look, which is read in a moment; 1 where the whole is.
std::size_t step_of_first_look(const LightFieldGrid& grid);

}  // namespace hogel::view
