// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "hogel/focus.h"
#include "hogel/image.h"
#include "hogel/pipeline.h"
#include "view/query.h"

namespace hogel::view {

/// What is known of the ray that a spot of a picture shows, and of the hologram where it crosses it.
struct Reading {
    double x = 0, y = 0;              ///< where it crosses the hologram, metres
    double across = 0, up = 0;        ///< its direction behind the hologram, radians to the right and up
    bool inside = false;              ///< whether the subject has it; the rest is known then
    std::array<float, 3> radiance{};  ///< of the nearest sample; equal for grey
    std::optional<double> depth;      ///< metres behind the hologram, where the light field knows it
    std::optional<double> bytes;      ///< that the hogel takes in a compressed file
    std::optional<double> phase;      ///< of the hologram's nearest sample, radians
};

/// How often a modulator shows each of its levels.
struct LevelCounts {
    std::string encoding;
    std::array<std::size_t, 256> counts{};
    std::size_t width = 0, height = 0;  ///< pixels that were looked at, in the middle of the hologram
    double efficiency = 0;              ///< share of the light on the modulator that goes into the hologram's wave
};

/// A picture, or the mean of the looks so far.
struct Photograph {
    Image picture;               ///< in linear light; with display=log its logarithm
    double exposure = 1;         ///< the factor with which it is shown
    std::size_t looks = 0;       ///< of waves
    std::optional<double> psnr;  ///< of waves beside rays, where both are shown: decibels of display values
};

/// What is looked at: a light field or a hologram. photograph(), focus() and find_focus() are for one thread at a time,
/// but rays may be photographed beside waves.
class Viewable {
  public:
    /// Receives pictures that become better; the last one is whole.
    using Shown = std::function<void(const Photograph&)>;

    virtual ~Viewable() = default;

    virtual double width() const = 0;  ///< of the hologram, metres
    virtual double height() const = 0;
    virtual bool has_rays() const = 0;
    /// Whether there is something beside which its errors are seen.
    virtual bool has_original() const { return false; }
    /// The number of looks by waves; 0: there are no waves.
    virtual std::size_t looks() const = 0;
    /// Facts for the page, in SI units, as members of one object.
    virtual nlohmann::ordered_json facts() const = 0;
    /// The automatic exposure of the view from the front, the same for all, so that nothing flickers.
    virtual double exposure() const = 0;

    virtual Reading read(const View& view, const PickPoint& point) const = 0;
    /// The depth of what lies at a spot.
    virtual double focus(const View& view, const PickPoint& point, const Progress& progress) = 0;
    /// A picture of what lies under a spot that is no photograph. Throws Error(usage) for what the subject has not.
    virtual Photograph inside(const View& view, const PickPoint& point, const Inside& inside,
                              const Progress& progress) = 0;
    /// How sharp the whole is at many depths. Throws Error(usage) for a subject whose depths are known.
    virtual FocusSearch find_focus(const Progress& progress);
    /// The levels of a modulator that shows a hologram, encoded by a row of encodings(). Throws Error(usage) for a
    /// subject that is none.
    virtual LevelCounts count_levels(const std::string& encoding, const Progress& progress);

    /// The camera of `hogel photo` with those options. Throws Error(usage).
    Camera camera(const View& view) const;
    /// Throws Error(usage) for a view that no picture shows.
    void require(const View& view) const;
    /// Shows the pictures that `hogel photo` takes; of two eyes both. Throws Error(cancelled).
    void photograph(const View& view, const Shown& shown, const Progress& progress);
    /// The last of them.
    Photograph photograph(const View& view, const Progress& progress);

  protected:
    /// Receives the mean of so many looks.
    using OnLooks = std::function<void(const Image&, std::size_t)>;
    /// A picture by rays; where `view.by` says so, that of the original, or the difference from it.
    virtual Image by_rays(const View& view, const Progress& progress) = 0;
    /// The first looks of the hologram, each of which is shown; `looks` 0: all.
    virtual void by_waves(const View& view, std::size_t looks, const OnLooks& shown, const Progress& progress) = 0;

  private:
    void photograph_eye(const View& view, std::size_t looks, const Shown& shown, const Progress& progress);
    void photograph_eyes(const View& view, const Shown& shown, const Progress& progress);
};

/// The point of the hologram that a spot of a picture looks through.
std::pair<double, double> point_at(const Camera& camera, const PickPoint& point);
/// The ray of a spot, without what a subject knows of it.
Reading ray_at(const Camera& camera, const PickPoint& point);
/// The eye that a spot of two pictures side by side belongs to, or the method, and the spot in its picture.
std::pair<View, PickPoint> in_one_picture(const View& view, const PickPoint& point);
/// The magnitude of the difference of two pictures; grey beside colour counts as that grey in all of its channels.
Image difference(const Image& a, const Image& b);
/// Two pictures of one height as one.
Image side_by_side(const Image& left, const Image& right);

}  // namespace hogel::view
