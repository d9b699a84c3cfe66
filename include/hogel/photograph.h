// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera.h"
#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/image.h"
#include "hogel/resources.h"

namespace hogel {

struct PhotographOptions {
    std::size_t memory = std::size_t{2} << 30;  ///< bytes that a photograph may use, besides the pictures
};

/// Photographs a hologram by wave optics with the narrow-band camera (docs/notation.md, section 4): the field is
/// demodulated towards the eye, low-passed to the band that enters the pupil and decimated, tile by tile, so holograms
/// of any size stream through; every focus and eye shares the pass. Intensities are averaged over the source's looks
/// and over each pixel's area, and come out in the units of radiance that the field carries (one channel). The returned
/// images are in the order of `cameras`. Memory: the decimated arrays, (4.4 D A/λR)² samples of 8 bytes an eye and
/// look, and 16 to 24 bytes for each of those samples of one eye's film. Where that is more than the options allow,
/// cameras are taken fewer at a time, and the hologram window by window: light that falls more than 256 resolution
/// cells from its place, a thousandth of it, is then lost at the windows' seams. Throws Error(usage) for a pupil that
/// takes in more than the field's pitch supports, or that cannot be done within the memory.
HOGEL_API std::vector<Image> photograph(const FieldSource& hologram, std::span<const Camera> cameras,
                                        const PhotographOptions& options = {}, const Progress& progress = {});

/// The same into `pictures`, one a camera, which keep their memory where they have the cameras' shapes. Throws
/// Error(usage) for another number of pictures, too.
HOGEL_API void photograph_into(const FieldSource& hologram, std::span<const Camera> cameras,
                               const PhotographOptions& options, std::span<Image> pictures,
                               const Progress& progress = {});

/// Throws the errors that photograph() throws before it begins, from the grid of a hologram that need not exist yet.
HOGEL_API void require_photographs(const FieldGrid& hologram, std::span<const Camera> cameras,
                                   const PhotographOptions& options = {});

/// Throws Error(usage) for an invalid camera, and for one that looks at a hologram from directions to which its
/// samples send no light. There photograph() shows what a modulator of such samples shows, copies of the picture that
/// belongs elsewhere: right only for a field that is known to have just these directions.
HOGEL_API void require_light_towards(const FieldGrid& hologram, const Camera& camera);

/// How photograph_by_plane_waves() works.
struct PlaneWaveCameraOptions {
    ScratchOptions scratch;
    /// Metres from a thin lens ([K] 6.12) to a film parallel to it, with the focal length of the lens equation: the
    /// picture shows the lens's spherical aberration, coma and astigmatism. 0: a perfect lens.
    double film_distance = 0;
};

/// Photographs a hologram by propagating its plane waves through the camera, the chain of [K] 6: to the lens, in the
/// directions between the hologram and the pupil alone, which leaves out the copies that sampling makes; through the
/// opening; and from it back to the plane in focus, which is what a perfect lens shows on its film, or through a thin
/// lens on to the film itself. The only approximation is that nothing lies beside the hologram. Units and order of the
/// images as photograph(). Cost: transforms of the hologram with room for the pupil around it; a tilted plane in focus
/// takes as much room again. Memory: what `scratch` allows, the rest in a file. Throws Error(usage) for an eye in
/// directions to which the hologram's samples send no light, and for a tilted plane in focus with a thin lens.
HOGEL_API std::vector<Image> photograph_by_plane_waves(const FieldSource& hologram, std::span<const Camera> cameras,
                                                       const PlaneWaveCameraOptions& options = {},
                                                       const Progress& progress = {});

/// The waves whose intensities photograph_by_plane_waves() shows, of one look and through a perfect lens: [y][x] at the
/// points in focus behind the pixels' centres, zero beside the hologram. Phases are relative to the spherical waves
/// that go from those points to the middle of the pupil, so light through the middle of the pupil alone has one phase.
/// Not scaled. Errors as there, and Error(usage) for a film distance.
HOGEL_API std::vector<Array<std::complex<float>, 2>> waves_in_focus(const FieldSource& hologram, std::size_t look,
                                                                    std::span<const Camera> cameras,
                                                                    const PlaneWaveCameraOptions& options = {},
                                                                    const Progress& progress = {});

/// Photographs a hologram by direct summation: every sample of the hologram to every point of the pupil, and every
/// point of the pupil to every pixel, with no approximation but scalar waves. Cost: hologram samples × pupil points;
/// for tests and small holograms.
HOGEL_API Image photograph_directly(const FieldSource& hologram, const Camera& camera, std::size_t pupil_points_across,
                                    std::size_t subpixels = 1);

/// Width λR/A of the smallest detail on the hologram that a camera resolves, metres.
HOGEL_API double resolution_cell(const Camera& camera, double wavelength);

}  // namespace hogel
