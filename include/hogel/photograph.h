// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera.h"
#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/resources.h"

namespace hogel {

/// Source of the pupil-band field.
enum class BandSource {
    automatic,      ///< hogel_spectra if known and cheaper, otherwise samples
    hogel_spectra,  ///< directly from the hogel spectra of a stereogram, without computing samples
    samples,        ///< from the samples of the field
};

/// The band camera (docs/notation.md, section 4): demodulates the field towards the viewpoint, low-passes it to the
/// pupil band, and decimates it. It works tile by tile, so holograms of any size can be streamed. One pass over the
/// hologram serves all cameras.
///
/// Memory: the decimated arrays, (4.4 D A/λR)² samples of 8 bytes per viewpoint and look, and about as much again for
/// the film of one viewpoint, which is 192 resolution cells λR/A wider. D is the side of the hologram, A the pupil, R
/// the distance of the viewpoint. A film also covers the area beside the hologram that pictures show. If that exceeds
/// `memory`, cameras are processed in smaller batches and the hologram in windows. Light farther than 256 resolution
/// cells from its point, about a thousandth, is then lost at the seams of windows.
///
/// photograph() throws Error(usage) for a pupil that receives more directions than the field's pitch supports, for a
/// pupil that does not resolve two points on opposite edges of the hologram, and if `memory` is too small.
struct BandCamera {
    std::size_t memory = std::size_t{4} << 30;  ///< bytes, without the pictures
    BandSource source = BandSource::automatic;
    /// Whether the hologram is behind a diffuser that spreads the light of each row of samples (a line) vertically, as
    /// in displays with horizontal parallax only ([K] 3.9). A line is coherent only along x: heights within it, and
    /// different lines, add as intensities. All heights have the radiance of the field towards the viewpoint, for any
    /// pitch in y. Cost: lines with overlapping light are photographed one by one, each as a hologram with 12 rows per
    /// resolution cell. Not with BandSource::hogel_spectra.
    bool vertical_diffuser = false;
    /// Whether to compute a preview from hogel spectra. It skips waves outside the pupil, which contribute only through
    /// edge diffraction, and uses coarser films. No effect on samples.
    bool preview = false;
};

/// Computes speckle-free photographs, the mean of infinitely many looks: the sum of the intensities of all waves, as
/// ideal time multiplexing shows. Only for stereograms made on demand with independent random phases of their waves
/// (Fourier with Phases::random); photograph() throws Error(usage) for others.
struct SpeckleFreeCamera {
    std::size_t memory = std::size_t{4} << 30;  ///< bytes, without the pictures
};

/// Propagates the plane waves of a hologram through the camera, the full chain of [K] 6. The waves travel to the lens,
/// restricted to the directions between the hologram and the pupil, which removes the copies due to sampling. They pass
/// the opening and then travel back to the plane in focus, which a perfect lens images on its film, or through a thin
/// lens to the film. The only approximation is that the field is zero beside the hologram.
///
/// Cost: Fourier transforms of the hologram padded by the pupil; twice that area for a tilted plane in focus. Memory:
/// as `scratch` permits, the rest in a file. photograph() throws Error(usage) for a viewpoint in directions to which
/// the hologram's pitch does not diffract, for a pupil that resolves fewer than four points side by side on the
/// hologram, and for a tilted plane in focus with a thin lens.
struct PlaneWaveCamera {
    ScratchOptions scratch;
    /// Distance from the lens to a film parallel to it, metres. 0: an ideal lens that images the plane in focus without
    /// aberrations. Otherwise a thin lens ([K] 6.12) with spherical aberration, coma and astigmatism; its focal length
    /// follows from the lens equation.
    double film_distance = 0;
};

/// Sums directly over every sample of the hologram, every point of the pupil and every pixel, with no approximation but
/// scalar waves. Cost: hologram samples × pupil points. For tests and small holograms.
struct DirectCamera {
    /// Points along a diameter of the pupil, on rings; more than two per cycle of the light of any two hologram points.
    std::size_t pupil_points = 64;
    std::size_t subpixels = 1;  ///< points across a pixel, by Gauss quadrature
};

/// Models of the wave-optical camera for holograms. Light fields have RayCamera.
using CameraModel = std::variant<BandCamera, SpeckleFreeCamera, PlaneWaveCamera, DirectCamera>;

/// Photographs a hologram by wave optics, one image per camera. Intensities are averaged over the source's looks and
/// over each pixel's area. Images have one channel, in the field's units of radiance. Throws Error(usage) as the model
/// says, and for an invalid camera.
HOGEL_API std::vector<Image> photograph(const FieldSource& hologram, std::span<const Camera> cameras,
                                        const CameraModel& model = BandCamera(), const Progress& progress = {});
/// Photographs with one camera.
HOGEL_API Image photograph(const FieldSource& hologram, const Camera& camera, const CameraModel& model = BandCamera(),
                           const Progress& progress = {});

/// Photographs into `pictures`, one per camera, and reuses their memory if they have the cameras' shapes. Throws as
/// photograph() does, and Error(usage) for another number of pictures.
HOGEL_API void photograph_into(const FieldSource& hologram, std::span<const Camera> cameras, const CameraModel& model,
                               std::span<Image> pictures, const Progress& progress = {});

/// Throws the errors that photograph() throws before it begins. It needs only the grid of the hologram.
HOGEL_API void require_photographs(const FieldGrid& hologram, std::span<const Camera> cameras,
                                   const CameraModel& model = BandCamera());

/// Estimates the resources to photograph existing holograms, without the cost of reading them. With a vertical diffuser
/// the time grows with the number of lines within 32 resolution cells plus the blur. Models other than BandCamera are
/// planned as a default BandCamera. Throws Error(usage) as require_photographs() does.
HOGEL_API Plan plan_photographs(std::span<const FieldGrid> holograms, std::size_t looks,
                                std::span<const Camera> cameras, const CameraModel& model = BandCamera());

/// Throws Error(usage) for an invalid camera, and for one in directions to which the pitch of the samples does not
/// diffract. In such directions photograph() shows what a modulator with these samples shows: copies (higher orders) of
/// pictures from other directions. That is correct only for a field known to have just these directions.
/// @param vertical_diffuser  whether the field is visible from all heights, see BandCamera
HOGEL_API void require_light_towards(const FieldGrid& hologram, const Camera& camera, bool vertical_diffuser = false);

/// Returns the complex waves that a PlaneWaveCamera with a perfect lens squares, for one look: one array [y][x] per
/// camera. Samples are at the points of the plane in focus that the pixels' centres show, zero far beside the hologram.
/// Phases are relative to spherical waves from those points to the centre of the pupil, so light through the centre
/// alone has a constant phase. Values are not scaled to radiance. Throws as photograph() with a PlaneWaveCamera, and
/// Error(usage) for a film distance.
HOGEL_API std::vector<Array<std::complex<float>, 2>> waves_in_focus(const FieldSource& hologram, std::size_t look,
                                                                    std::span<const Camera> cameras,
                                                                    const PlaneWaveCamera& model = {},
                                                                    const Progress& progress = {});

/// Photographs holograms of one or three wavelengths from successive viewpoints, for interactive use. Pictures are
/// those of photograph(). It caches data common to all viewpoints (the amplitudes of a stereogram's waves, and the
/// waves of the first look) and the pupil-band field of the last viewpoint. A new viewpoint then costs only its own
/// band. Another focus, picture or slightly narrower pupil at the same viewpoint costs only the films.
///
/// A photograph can be stopped at any time. The completed looks are kept, and the next photograph from the same
/// viewpoint continues with the others. Not thread-safe.
class HOGEL_API EyePhotographer {
  public:
    /// Computes the data common to all viewpoints. Half of the model's memory is for it, half for the band of the last
    /// viewpoint. Supports BandCamera without a diffuser, and SpeckleFreeCamera, which shows one picture, as the mean
    /// of 0 looks. Throws Error(usage) for other models and other numbers of holograms.
    explicit EyePhotographer(Fields holograms, const CameraModel& model = BandCamera(), const Progress& progress = {});
    /// Photographs the holograms of another photographer with another model, and shares its data common to all
    /// viewpoints. Use both on the same thread. Throws Error(usage) as the other constructor does.
    EyePhotographer(const EyePhotographer& other, const CameraModel& model);
    ~EyePhotographer();
    EyePhotographer(EyePhotographer&&) noexcept;
    EyePhotographer& operator=(EyePhotographer&&) noexcept;

    /// Receives the mean of the first `looks` looks, in all colours.
    using Shown = std::function<void(const Image& picture, std::size_t looks)>;

    /// Returns the mean of all looks. Calls `shown` after each look, so that a first picture appears at once and its
    /// speckle fades. Throws Error(usage) as photograph() does, and Error(cancelled).
    Image photograph(const Camera& camera, const Shown& shown = {}, const Progress& progress = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Returns the width λR/A of the smallest detail on the hologram that a camera resolves, metres.
HOGEL_API double resolution_cell(const Camera& camera, double wavelength);

/// Camera model of photographs of light fields by geometric optics.
struct RayCamera {
    std::size_t pupil_samples = 64;  ///< points of the pupil, evenly distributed over the disc
};

/// Photographs a light field by geometric optics, one image per camera. A pixel is the mean radiance, over the pupil,
/// of the rays that meet at its point of the plane in focus. This is the reference for photographs of holograms. Rays
/// are interpolated linearly in all four dimensions; rays outside the hologram or the field of view are black. In a
/// hemicube a ray is looked up in the first face that contains its direction. Memory: one picture per camera and a tile
/// of hogels. Cost: pupil samples × (hogels + pixels) per camera. Throws Error(usage) for an invalid camera, and for a
/// tilted plane in focus.
HOGEL_API std::vector<Image> photograph(const LightField& light_field, std::span<const Camera> cameras,
                                        const RayCamera& model = {}, const Progress& progress = {});
/// Photographs with one camera.
HOGEL_API Image photograph(const LightField& light_field, const Camera& camera, const RayCamera& model = {},
                           const Progress& progress = {});

/// Photographs into `pictures`, one per camera, and reuses their memory if they have the cameras' shapes. Throws as
/// photograph() does, and Error(usage) for another number of pictures.
HOGEL_API void photograph_into(const LightField& light_field, std::span<const Camera> cameras, const RayCamera& model,
                               std::span<Image> pictures, const Progress& progress = {});

/// Estimates the resources to photograph a light field by rays, without the cost of reading it.
HOGEL_API Plan plan_ray_photographs(std::span<const LightFieldGrid> faces, std::span<const Camera> cameras,
                                    const RayCamera& model = {});

/// Options of RayPhotographer.
struct RayPhotographerOptions {
    std::size_t memory = std::size_t{2} << 30;  ///< bytes for the samples of the light field
};

/// Photographs a light field by rays from successive viewpoints, for interactive use. It keeps all samples in memory,
/// ordered by direction, because a viewpoint sees neighbouring hogels in nearly the same direction. Samples are floats
/// if they fit, otherwise halves (binary16). Pictures are those of photograph(), bit for bit with floats. For one
/// thread.
class HOGEL_API RayPhotographer {
  public:
    /// Reads the full light field. A light field with hemicube sides or directions uniform in sines is not copied; each
    /// photograph reads it. Throws Error(usage) if halves exceed options.memory; the message has their size.
    explicit RayPhotographer(LightField light_field, const RayPhotographerOptions& options = {},
                             const Progress& progress = {});
    ~RayPhotographer();
    RayPhotographer(RayPhotographer&&) noexcept;
    RayPhotographer& operator=(RayPhotographer&&) noexcept;

    /// Photographs with one camera. Throws Error(usage) as hogel::photograph() does, and Error(cancelled).
    Image photograph(const Camera& camera, const RayCamera& model = {}, const Progress& progress = {});
    /// Photographs into `picture`, and reuses its memory if it has the camera's shape.
    void photograph_into(const Camera& camera, const RayCamera& model, Image& picture, const Progress& progress = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace hogel
