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

/// Measurement at a point of a picture: the ray through it, and the sample where the ray crosses the hologram.
struct Reading {
    double x = 0, y = 0;              ///< intersection with the hologram, metres
    double across = 0, up = 0;        ///< direction behind the hologram, radians to the right and up
    bool inside = false;              ///< whether the viewable has a sample there; the members below are valid then
    std::array<float, 3> radiance{};  ///< of the nearest sample; equal for grey
    std::optional<double> depth;      ///< metres behind the hologram, if the light field stores it
    std::optional<double> bytes;      ///< compressed size of the hogel
    std::optional<double> phase;      ///< of the hologram's nearest sample, radians
};

/// Number of pixels at each level of a modulator that shows the middle of a hologram.
struct LevelCounts {
    std::string encoding;
    std::array<std::size_t, 256> counts{};
    std::size_t width = 0, height = 0;  ///< counted pixels, in the middle of the hologram
    double efficiency = 0;              ///< fraction of the light on the modulator that forms the wave of the hologram
};

/// A picture. By wave optics it is the mean of the looks so far.
struct Photograph {
    Image picture;               ///< linear light; with display=log its logarithm
    double exposure = 1;         ///< display factor
    std::size_t looks = 0;       ///< averaged looks; 0: by rays
    std::optional<double> psnr;  ///< waves compared with rays, decibels of display values
};

/// A light field or a hologram. photograph(), focus() and find_focus() are not thread-safe, except that one thread may
/// photograph by rays while another photographs by waves.
class Viewable {
  public:
    /// Receives successively better pictures; the last one is complete.
    using Shown = std::function<void(const Photograph&)>;

    virtual ~Viewable() = default;

    virtual double width() const = 0;  ///< of the hologram, metres
    virtual double height() const = 0;
    virtual bool has_rays() const = 0;
    /// Returns whether there is an original to compare with.
    virtual bool has_original() const { return false; }
    /// Returns the number of looks of pictures by wave optics; 0: there are no such pictures.
    virtual std::size_t looks() const = 0;
    /// Returns facts for the page, in SI units, as members of one object.
    virtual nlohmann::ordered_json facts() const = 0;
    /// Returns the automatic exposure of the front view. All pictures use it, which avoids flicker.
    virtual double exposure() const = 0;

    virtual Reading read(const PictureQuery& query, const PickPoint& point) const = 0;
    /// Returns the depth at a point, metres behind the hologram.
    virtual double focus(const PictureQuery& query, const PickPoint& point, const Progress& progress) = 0;
    /// Returns a picture of the data at a point. Throws Error(usage) for a kind that the viewable does not have.
    virtual Photograph inside(const PictureQuery& query, const PickPoint& point, const InsideQuery& inside,
                              const Progress& progress) = 0;
    /// Returns the sharpness of a hologram at many depths. Throws Error(usage) for a light field.
    virtual FocusSearch find_focus(const Progress& progress);
    /// Encodes the middle of the hologram (first wavelength, at most 1024 × 1024 samples) as a pattern for a modulator
    /// with 256 levels. Returns the number of pixels at each level. Throws Error(usage) for a light field.
    /// @param encoding  a name from encodings()
    virtual LevelCounts count_levels(const std::string& encoding, const Progress& progress);

    /// Returns the camera of `hogel photo` with the same options. Throws Error(usage).
    Camera camera(const PictureQuery& query) const;
    /// Throws Error(usage) if the viewable cannot show the query.
    void require(const PictureQuery& query) const;
    /// Takes the picture of `hogel photo` with the same options, or pictures of two viewpoints side by side. Throws
    /// Error(cancelled).
    void photograph(const PictureQuery& query, const Shown& shown, const Progress& progress);
    /// Returns the last picture that the other photograph() would report.
    Photograph photograph(const PictureQuery& query, const Progress& progress);

  protected:
    /// Receives the mean of the looks so far, and their number.
    using OnLooks = std::function<void(const Image&, std::size_t)>;
    /// Returns a picture by rays: of the original or the difference from it if `query.by` selects that.
    virtual Image by_rays(const PictureQuery& query, const Progress& progress) = 0;
    /// Reports the mean after each of the first `looks` looks of the hologram; 0: all.
    virtual void by_waves(const PictureQuery& query, std::size_t looks, const OnLooks& shown,
                          const Progress& progress) = 0;

  private:
    void photograph_eye(const PictureQuery& query, std::size_t looks, const Shown& shown, const Progress& progress);
    void photograph_eyes(const PictureQuery& query, const Shown& shown, const Progress& progress);
};

/// Returns the point (x, y) of the hologram seen at a point of the picture, metres.
std::pair<double, double> point_at(const Camera& camera, const PickPoint& point);
/// Returns the ray of a point, without samples.
Reading ray_at(const Camera& camera, const PickPoint& point);
/// For two pictures side by side, returns the query of the half that contains the point, and the point within it.
std::pair<PictureQuery, PickPoint> single_picture(const PictureQuery& query, const PickPoint& point);
/// Returns the magnitude of the difference of two pictures. A grey picture counts as equal channels.
Image difference(const Image& a, const Image& b);
/// Joins two pictures of equal height.
Image side_by_side(const Image& left, const Image& right);

}  // namespace hogel::view
