// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera.h"
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
/// cameras are taken fewer at a time, and the hologram window by window: what light falls more than 256 resolution
/// cells from its place is then lost at the windows' seams, a thousandth. Throws Error(usage) for a pupil that takes in
/// more than the field's pitch supports, or that cannot be done within the memory.
std::vector<Image> photograph(const FieldSource& hologram, std::span<const Camera> cameras,
                              const Progress& progress = {}, const PhotographOptions& options = {});

/// Throws what photograph() would throw at once, without a hologram to photograph: to be asked before one is made.
void require_photographs(const FieldGrid& hologram, std::span<const Camera> cameras,
                         const PhotographOptions& options = {});

/// Throws Error(usage) for a camera that makes no sense, or that looks at a hologram from directions to which its
/// samples send no light. photograph() shows there what a modulator of such samples shows, copies of the picture that
/// belongs elsewhere: right for a field that is known to have just these directions, and else a mistake.
void require_light_towards(const FieldGrid& hologram, const Camera& camera);

/// What the full camera can be told besides its cameras.
struct FullCameraOptions {
    ScratchOptions scratch;
    /// Metres from a thin lens ([K] 6.12) to a film parallel to it, with the focal length that the lens equation asks
    /// for: what spherical aberration, coma and astigmatism such a lens has, the picture shows. 0: a perfect lens.
    double film_distance = 0;
};

/// The same by the chain of [K] 6, with no approximation but that the hologram is a window of its own: plane waves to
/// the lens, of the directions between the hologram and the pupil alone, by which the copies that sampling makes stay
/// out; the opening; and from it back to the plane in focus, which is what a perfect lens shows on its film; or through
/// a thin lens on to the film itself. Cost: transforms of the hologram with room for the pupil around it; a tilted
/// plane in focus takes as much room again. Memory: what `scratch` allows, the rest in a file. Throws Error(usage) for
/// an eye in directions to which the hologram's samples send no light, and a tilted plane in focus with a thin lens.
std::vector<Image> photograph_fully(const FieldSource& hologram, std::span<const Camera> cameras,
                                    const Progress& progress = {}, const FullCameraOptions& options = {});

/// The waves whose intensities photograph_fully() shows, of one look and through a perfect lens: [y][x] at the points
/// in focus behind the pixels' centres, zero beside the hologram. Phases are relative to the spherical waves that go
/// from those points to the middle of the pupil, so light through the middle of the pupil alone has one phase. Not
/// scaled. Errors as there, and Error(usage) for a film distance.
std::vector<Array<std::complex<float>, 2>> waves_in_focus(const FieldSource& hologram, std::size_t look,
                                                          std::span<const Camera> cameras,
                                                          const Progress& progress = {},
                                                          const FullCameraOptions& options = {});

/// The same by direct summation: every sample of the hologram to every point of the pupil, every point of the pupil to
/// every pixel, no approximation but the scalar one. Cost: hologram samples × pupil points; for tests and small
/// holograms.
Image photograph_directly(const FieldSource& hologram, const Camera& camera, std::size_t pupil_points_across,
                          std::size_t subpixels = 1);

/// Width λR/A of the smallest detail on the hologram that a camera resolves, metres.
double resolution_cell(const Camera& camera, double wavelength);

}  // namespace hogel
