// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera.h"
#include "hogel/camera/speckle_free/psf_basis.h"

namespace hogel::camera::speckle_free {

/// Positions of the hogels of a stereogram: hogel (s, t) is at plane.x(s), plane.y(t).
struct HogelGrid {
    Grid plane;
    std::size_t samples = 0;  ///< along a side of a hogel
    double wavelength = 0;
};

/// Returns half the width of the light of a pupil, in cycles per hogel: the maximum over the hologram.
double half_band(const HogelGrid& hogels, Vec3 viewpoint, double pupil);

/// Pairs (q_x, q_y) of node waves along the two axes. Omits pairs in the corners, which send next to no light into the
/// pupil. The q_y of each q_x are consecutive.
struct NodePairs {
    struct Range {
        std::size_t begin = 0, end = 0;
    };
    std::vector<Range> ranges;  ///< [q_x]
    std::size_t count = 0;      ///< total
    /// Count padded with zeros, so that the pairs of each hogel begin at a cache line.
    std::size_t padded_count() const { return PsfBasis::padded_to_lanes(count); }

    NodePairs(const PsfNodes& basis, double half_band);
};

/// Positions of a picture's pixels among hogels along one axis, clipped to the hologram and the visible surroundings. A
/// pixel around position u, in hogels, receives the light of hogels base − support … base + support. Its weights depend
/// only on its entry; many pixels share one.
struct PixelOffsets {
    struct Entry {
        double offset = 0;  ///< u − base
        double width = 0;   ///< width on the hologram or its surroundings, in hogels
    };
    std::vector<Entry> entries;
    std::vector<std::ptrdiff_t> base;  ///< [pixel]
    std::vector<std::size_t> entry;    ///< [pixel], an index of entries
    std::vector<float> visible;        ///< [pixel], the share of its width on the hologram or its surroundings
    double width = 0;                  ///< of a whole pixel, in hogels
    std::size_t border = 0;            ///< of the surroundings at either end, in hogels
};
/// Returns positions u = first + i · step of `pixels` pixels among `hogels` hogels and `border` empty ones at either
/// end. If there are more than `max_offsets` different offsets, they are rounded to 1/max_offsets of a hogel.
PixelOffsets pixel_offsets(std::size_t pixels, double first, double step, std::size_t hogels, std::size_t border,
                           std::size_t max_offsets);

/// Returns the number of offsets along an axis, from 4 to 32, for which a PSF table takes at most 64 MB. Wide PSFs,
/// which need many hogels, are smooth and need few offsets.
std::size_t max_offsets(const NodePairs& pairs, std::size_t support);

/// Matrices that average a PSF on the film over the pixels at each offset, the same for every PSF.
struct PixelMeans {
    Array<float, 2> down;  ///< [entry · hogel][sample of the film]
    Array<float, 2>
        across;  ///< [sample of the film][entry · hogel], padded with zeros to a multiple of PsfBasis::lanes

    PixelMeans(const HogelGrid& hogels, const Camera& camera, double half_band, const PixelOffsets& columns,
               const PixelOffsets& rows);
};

/// PSFs of waves on a camera's film, as means over pixels.
///
/// A wave with the light D(y_x − κ_x) D(y_y − κ_y) in the pupil's plane has the intensity |∫ D D P e^{2πiκ·x} dκ|² on
/// the film at the distance x from its hogel, in hogels. P is the pupil's disc with the phase of the focus.
class PsfTable {
  public:
    /// Returns the support, in hogels beside a hogel, of the PSFs of a camera; light beyond is the tail.
    static std::size_t support(const HogelGrid& hogels, const Camera& camera, double half_band);

    /// Returns the approximate number of products that the constructor computes.
    static double products(const HogelGrid& hogels, const Camera& camera, const NodePairs& pairs, double half_band,
                           const PixelOffsets& columns, const PixelOffsets& rows);

    /// @param x, y   the point of the hologram that defines pupil and focus
    /// @param means  for these columns and rows
    PsfTable(const HogelGrid& hogels, const Camera& camera, const PsfBasis& basis, const NodePairs& pairs,
             double half_band, double x, double y, const PixelOffsets& columns, const PixelOffsets& rows,
             const PixelMeans& means);

    /// Returns the number of hogels in the support of a pixel, along an axis.
    std::size_t taps() const { return 2 * support_ + 1; }
    std::size_t support() const { return support_; }
    /// Returns the radiance of a pixel due to a hogel's PSF: [entry down][entry across][hogel down][hogel across ·
    /// pair].
    View<const float, 4> weights() const { return weights_; }
    /// Returns the total exposure by the tail of a PSF, on pixels of the size of a hogel: [pair].
    std::span<const float> tails() const { return tails_; }

  private:
    std::size_t support_;
    Array<float, 4> weights_;
    std::vector<float> tails_;
};

}  // namespace hogel::camera::speckle_free
