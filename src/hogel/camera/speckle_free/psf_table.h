// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera.h"
#include "hogel/camera/speckle_free/psf_basis.h"

namespace hogel::camera::speckle_free {

/// The hogels of a stereogram as an eye sees them: hogel (s, t) is at plane.x(s), plane.y(t).
struct HogelGrid {
    Grid plane;
    std::size_t samples = 0;  ///< along a side of a hogel
    double wavelength = 0;
};

/// Half the width of the light of a pupil, in cycles per hogel: the widest anywhere on the hologram.
double half_band(const HogelGrid& hogels, Vec3 eye, double pupil);

/// The pairs (q_x, q_y) of waves whose spots are used: all but those in corners that send next to no light into the
/// pupil. For each q_x the q_y are consecutive.
struct Pairs {
    struct Range {
        std::size_t begin = 0, end = 0;
    };
    std::vector<Range> of_column;  ///< [q_x]
    std::size_t count = 0;         ///< in all
    /// With zeros, so that those of each hogel begin at a cache line.
    std::size_t padded_count() const { return PsfBasis::in_lanes(count); }

    Pairs(const PsfNodes& basis, double half_band);
};

/// Where the pixels of a picture lie among hogels along one axis, as far as they are on the hologram or on the
/// surroundings that are seen. A pixel around position u, in hogels, receives the light of hogels base − reach …
/// base + reach, and its place among them is one of a few.
struct PixelOffsets {
    struct Place {
        double offset = 0;  ///< u − base
        double width = 0;   ///< of what is on the hologram or its surroundings
    };
    std::vector<Place> places;
    std::vector<std::ptrdiff_t> base;  ///< [pixel]
    std::vector<std::size_t> place;    ///< [pixel], an index of places
    std::vector<float> seen;           ///< [pixel], the share of it that is on the hologram or its surroundings
    double width = 0;                  ///< of a whole pixel, in hogels
    std::size_t beside = 0;            ///< of the surroundings at either end, in hogels
};
/// Positions u = first + i · step of `pixels` pixels among `hogels` hogels and `beside` more at either end that are
/// dark. If more than `max_places` different places occur, they are rounded to this part of a hogel.
PixelOffsets pixel_offsets(std::size_t pixels, double first, double step, std::size_t hogels, std::size_t beside,
                           std::size_t max_places);

/// Places along an axis for which a table of spots takes 64 MB at most, from 4 to 32: wide spots, which need many
/// hogels, are smooth.
std::size_t max_places(const Pairs& pairs, std::size_t reach);

/// The means of a spot's film over the pixels at each place, the same wherever the spot is.
struct PixelMeans {
    Array<float, 2> down;    ///< [place · hogel][sample of the film]
    Array<float, 2> across;  ///< [sample of the film][place · hogel], with zeros up to a multiple of PsfBasis::lanes

    PixelMeans(const HogelGrid& hogels, const Camera& camera, double half_band, const PixelOffsets& columns,
               const PixelOffsets& rows);
};

/// PsfTable of waves on a camera's film, as means over pixels.
///
/// A wave with the light D(y_x − κ_x) D(y_y − κ_y) in the pupil's plane has on the film, at the distance x from its
/// hogel, in hogels, the intensity |∫ D D P e^{2πiκ·x} dκ|², with P the pupil's disc and the phase of the focus.
class PsfTable {
  public:
    /// The distance, in hogels, up to which spots are followed beside a hogel for cameras with this blur; what is
    /// farther away is the tail.
    static std::size_t reach(const HogelGrid& hogels, const Camera& camera, double half_band);

    /// Products of numbers that the constructor computes, about.
    static double products(const HogelGrid& hogels, const Camera& camera, const Pairs& pairs, double half_band,
                           const PixelOffsets& columns, const PixelOffsets& rows);

    /// @param x, y   the point of the hologram at which pupil and focus are seen
    /// @param means  for these columns and rows
    PsfTable(const HogelGrid& hogels, const Camera& camera, const PsfBasis& basis, const Pairs& pairs, double half_band,
             double x, double y, const PixelOffsets& columns, const PixelOffsets& rows, const PixelMeans& means);

    /// Hogels that light a pixel, along an axis.
    std::size_t taps() const { return 2 * reach_ + 1; }
    std::size_t reach() const { return reach_; }
    /// [place down][place across][hogel down][hogel across · pair]: by how much the spots of a hogel expose a pixel, in
    /// radiance.
    View<const float, 4> weights() const { return weights_; }
    /// [pair]: what a spot's light beyond these hogels exposes in all, pixel by pixel of the size of a hogel.
    std::span<const float> tails() const { return tails_; }

  private:
    std::size_t reach_;
    Array<float, 4> weights_;
    std::vector<float> tails_;
};

}  // namespace hogel::camera::speckle_free
