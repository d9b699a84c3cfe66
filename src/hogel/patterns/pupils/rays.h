// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/light_field.h"
#include "hogel/patterns/pupils/film.h"
#include "hogel/patterns/pupils/pupil.h"

namespace hogel::patterns {

/// Photographs of a light field through pupils, by rays: sums of its views, each shifted to the depth in focus. Keeps
/// one channel in memory, as one picture of all hogels per direction.
class PupilRays {
  public:
    /// Throws Error(usage) for a fixed focal plane, and unless the light field has hogels and directions enough.
    PupilRays(const LightFieldSource& light_field, std::size_t channel, double wavelength, double pixel_pitch);

    const PupilRange& range() const { return range_; }
    /// Returns the pupil that passes all directions, with the hologram plane in focus.
    /// Computes the mean radiance through a pupil at the samples of a film.
    void photograph(const Pupil& pupil, const PupilFilm& film, Array<float, 2>& radiance) const;

  private:
    struct Direction {
        double u = 0, v = 0;  // tangents
        double x = 0, y = 0;  // frequencies, cycles per pixel, to the right and downwards
    };
    struct Shifted {
        const float* view;
        float weight;
        double columns, rows;  // from a sample in focus to the view's hogel
    };
    void read_views(const LightFieldSource& light_field, std::size_t channel);
    std::vector<Shifted> views_through(const Pupil& pupil) const;

    LightFieldGrid grid_;
    std::vector<Direction> directions_;  // [v][u]
    Array<float, 4> views_;              // [v][u][t][s]
    PupilRange range_;
    double cell_ = 0;  // distance of directions, cycles per pixel
};

}  // namespace hogel::patterns
