#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/image/camera.h"
#include "hogel/image/image.h"
#include "hogel/optics/field.h"

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

/// The same by direct summation: every sample of the hologram to every point of the pupil, every point of the pupil to
/// every pixel, no approximation but the scalar one. Cost: hologram samples × pupil points; for tests and small
/// holograms.
Image photograph_directly(const FieldSource& hologram, const Camera& camera, std::size_t pupil_points_across,
                          std::size_t subpixels = 1);

/// Width λR/A of the smallest detail on the hologram that a camera resolves, metres.
double resolution_cell(const Camera& camera, double wavelength);

}  // namespace hogel
