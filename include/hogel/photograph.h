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

/// Source of the light in the band of a pupil.
enum class BandSource {
    automatic,      ///< hogel_spectra where they are known and that costs less, otherwise samples
    hogel_spectra,  ///< the spectra of a stereogram's hogels, without computing samples
    samples,        ///< the samples of the field
};

/// The band camera (docs/notation.md, section 4): the field is demodulated towards the eye, low-passed to the band that
/// enters the pupil, and decimated. It works tile by tile, so that holograms of any size can be streamed, and one pass
/// over the hologram serves all cameras.
///
/// Memory: the decimated arrays, (4.4 D A/λR)² samples of 8 bytes for each eye and look, and about as much again for
/// one eye's film that is 192 resolution cells λR/A wider, with D the side of the hologram, A the pupil, R the eye's
/// distance; the film has what pictures show beside the hologram, too. If that exceeds `memory`, cameras are processed
/// fewer at a time and the hologram in windows; then the thousandth of the light that falls more than 256 resolution
/// cells from its point is lost at the seams of windows.
///
/// photograph() throws Error(usage) for a pupil that receives more directions than the field's pitch supports, for one
/// that does not resolve two points on opposite edges of the hologram, and for a photograph that needs more memory than
/// allowed.
struct BandCamera {
    std::size_t memory = std::size_t{4} << 30;  ///< bytes that a photograph may use, without the pictures
    BandSource source = BandSource::automatic;
    /// Whether the hologram stands behind a diffuser that spreads the light of each row of samples, a line, to all
    /// heights, as displays with horizontal parallax only do ([K] 3.9). A line is coherent along x only: heights within
    /// it, and different lines, add as intensities. All heights are seen with the radiance of the field towards the
    /// eye, whatever the pitch in y. Cost: lines whose light overlaps are photographed one by one, each as a hologram
    /// with 12 rows to a resolution cell. Not from hogel spectra.
    bool vertical_diffuser = false;
    /// A quick look from hogel spectra: it skips waves outside the pupil, which contribute only through edge
    /// diffraction, and films are coarser. No effect on samples.
    bool preview = false;
};

/// Photographs the mean of infinitely many looks, without speckle: the sum of the intensities of all waves, which ideal
/// time multiplexing shows. For stereograms that are made on demand and whose waves have independent random phases,
/// Fourier with Phases::random; photograph() throws Error(usage) for others.
struct SpeckleFreeCamera {
    std::size_t memory = std::size_t{4} << 30;  ///< bytes that a photograph may use, without the pictures
};

/// Propagates the plane waves of a hologram through the camera, the full chain of [K] 6: to the lens, restricted to the
/// directions between the hologram and the pupil, which removes the copies due to sampling; through the opening; then
/// either back to the plane in focus, which a perfect lens images on its film, or through a thin lens to the film. The
/// only approximation is that the field is zero beside the hologram. Cost: Fourier transforms of the hologram padded by
/// the pupil, and twice that area for a tilted plane in focus. Memory: as `scratch` allows, the rest in a file.
/// photograph() throws Error(usage) for an eye in directions beyond those to which the hologram's pitch diffracts, for
/// a pupil that resolves fewer than four points side by side on the hologram, and for a tilted plane in focus with a
/// thin lens.
struct PlaneWaveCamera {
    ScratchOptions scratch;
    /// Metres from a thin lens ([K] 6.12) to a film parallel to it; the lens equation gives the focal length. The
    /// picture then shows the lens's spherical aberration, coma and astigmatism. 0: a perfect lens.
    double film_distance = 0;
};

/// Sums directly, from every sample of the hologram to every point of the pupil and from there to every pixel, with no
/// approximation but scalar waves. Cost: hologram samples × pupil points. For tests and small holograms.
struct DirectCamera {
    /// Points along a diameter of the pupil, on rings; they must be closer together than half a cycle of the light of
    /// any two points of the hologram.
    std::size_t pupil_points = 64;
    std::size_t subpixels = 1;  ///< points across a pixel, by Gauss' quadrature
};

/// How the light of a hologram is followed to the film. Light fields have RayCamera.
using CameraModel = std::variant<BandCamera, SpeckleFreeCamera, PlaneWaveCamera, DirectCamera>;

/// Photographs a hologram by wave optics. Intensities are averaged over the source's looks and over each pixel's area.
/// The images have one channel, in the field's units of radiance, and the order of `cameras`. Throws Error(usage) for
/// an invalid camera, and as the model says.
HOGEL_API std::vector<Image> photograph(const FieldSource& hologram, std::span<const Camera> cameras,
                                        const CameraModel& model = BandCamera(), const Progress& progress = {});
/// The same by one camera.
HOGEL_API Image photograph(const FieldSource& hologram, const Camera& camera, const CameraModel& model = BandCamera(),
                           const Progress& progress = {});

/// As photograph() into `pictures`, one per camera, whose memory is reused if they have the cameras' shapes. Also
/// throws Error(usage) for another number of pictures.
HOGEL_API void photograph_into(const FieldSource& hologram, std::span<const Camera> cameras, const CameraModel& model,
                               std::span<Image> pictures, const Progress& progress = {});

/// Throws the errors that photograph() throws before it begins, given only the grid of the hologram, which need not
/// exist yet.
HOGEL_API void require_photographs(const FieldGrid& hologram, std::span<const Camera> cameras,
                                   const CameraModel& model = BandCamera());

/// Resources to photograph holograms that exist already, without the cost of reading them; behind a vertical diffuser
/// too, where the time grows with the number of lines within 32 resolution cells and the blur. Other models are planned
/// as BandCamera(), with its default memory. Throws Error(usage) as require_photographs() does.
HOGEL_API Plan plan_photographs(std::span<const FieldGrid> holograms, std::size_t looks,
                                std::span<const Camera> cameras, const CameraModel& model = BandCamera());

/// Throws Error(usage) for an invalid camera, and for one in directions beyond those to which the pitch of the samples
/// diffracts. In such directions photograph() shows what a modulator with these samples shows, copies (higher orders)
/// of pictures from other directions, which is correct only for a field that is known to have just these directions.
/// @param vertical_diffuser  whether the field is seen from all heights, see BandCamera
HOGEL_API void require_light_towards(const FieldGrid& hologram, const Camera& camera, bool vertical_diffuser = false);

/// The complex waves whose intensities a PlaneWaveCamera shows, for one look and a perfect lens: one array
/// [y][x] per camera, at the points of the plane in focus that the pixels' centres show, zero far beside the hologram.
/// Phases are relative to spherical waves from those points to the centre of the pupil, so light through the centre
/// alone has a constant phase. Values are not scaled to radiance. Throws as photograph() does with a PlaneWaveCamera,
/// and Error(usage) for a film distance.
HOGEL_API std::vector<Array<std::complex<float>, 2>> waves_in_focus(const FieldSource& hologram, std::size_t look,
                                                                    std::span<const Camera> cameras,
                                                                    const PlaneWaveCamera& model = {},
                                                                    const Progress& progress = {});

/// Photographs of holograms of one or three wavelengths from one eye after the other, for interactive use. It keeps
/// what all eyes share, the amplitudes of the waves of a stereogram and the waves of the first look, and the light in
/// the pupil of the last eye, so that a new eye costs only that eye, and a new focus or picture of the same eye, or a
/// slightly narrower pupil, only the films. Pictures are those of photograph().
///
/// A photograph can be stopped at any time: the looks of its eye that were drawn before are kept, and asking for the
/// same eye again continues with the others. For one thread at a time.
class HOGEL_API EyePhotographer {
  public:
    /// Computes what all eyes share. Half of the model's memory is for it, half for the light of the last eye. Throws
    /// Error(usage) for other numbers of holograms, and for models other than BandCamera, without a diffuser, and
    /// SpeckleFreeCamera, which shows a picture once, as the mean of 0 looks.
    explicit EyePhotographer(Fields holograms, const CameraModel& model = BandCamera(), const Progress& progress = {});
    /// Photographs the holograms of another photographer by another model, and shares with it what all eyes share. Both
    /// are for the same thread. Throws Error(usage) as the other constructor does.
    EyePhotographer(const EyePhotographer& other, const CameraModel& model);
    ~EyePhotographer();
    EyePhotographer(EyePhotographer&&) noexcept;
    EyePhotographer& operator=(EyePhotographer&&) noexcept;

    /// Receives the mean of the first `looks` looks, in all colours.
    using Shown = std::function<void(const Image& picture, std::size_t looks)>;

    /// The mean of all looks. Calls `shown` after each of them, so that the first is seen at once and speckle fades.
    /// Throws Error(usage) as photograph() does, and Error(cancelled).
    Image photograph(const Camera& camera, const Shown& shown = {}, const Progress& progress = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Width λR/A of the smallest detail on the hologram that a camera resolves, metres.
HOGEL_API double resolution_cell(const Camera& camera, double wavelength);

/// The camera that photographs light fields by geometric optics.
struct RayCamera {
    std::size_t pupil_samples = 64;  ///< points of the pupil, spread evenly over the disc
};

/// Photographs a light field by geometric optics, one image per camera. A pixel is the mean radiance, over the pupil,
/// of the rays that meet at the pixel's point of the plane in focus. This is the reference with which photographs of
/// holograms are compared. Rays are interpolated linearly in all four dimensions; rays outside the hologram or the
/// field of view are black. In a hemicube a ray is looked up in the first face that has its direction. Memory: one
/// picture per camera and a tile of hogels. Cost: pupil samples × (hogels + pixels) per camera. Throws Error(usage) for
/// a camera that makes no sense, and for a tilted plane in focus.
HOGEL_API std::vector<Image> photograph(const LightField& light_field, std::span<const Camera> cameras,
                                        const RayCamera& model = {}, const Progress& progress = {});
/// The same by one camera.
HOGEL_API Image photograph(const LightField& light_field, const Camera& camera, const RayCamera& model = {},
                           const Progress& progress = {});

/// As photograph() into `pictures`, one per camera, whose memory is reused if they have the cameras' shapes. Also
/// throws Error(usage) for another number of pictures.
HOGEL_API void photograph_into(const LightField& light_field, std::span<const Camera> cameras, const RayCamera& model,
                               std::span<Image> pictures, const Progress& progress = {});

/// Resources to photograph a light field by rays, without the cost of reading it.
HOGEL_API Plan plan_ray_photographs(std::span<const LightFieldGrid> faces, std::span<const Camera> cameras,
                                    const RayCamera& model = {});

/// Options of RayPhotographer.
struct RayPhotographerOptions {
    std::size_t memory = std::size_t{2} << 30;  ///< bytes for the samples of the light field
};

/// Photographs a light field by rays from one eye after the other, for interactive use. It keeps all samples in memory,
/// ordered by direction, because an eye sees neighbouring hogels in nearly the same direction: floats if they fit,
/// otherwise halves (binary16). Pictures are those of photograph(), to the last bit from floats. For one thread at a
/// time.
class HOGEL_API RayPhotographer {
  public:
    /// Reads the whole light field. One with the sides of a hemicube or with directions uniform in sines is kept and
    /// read as it is, by each photograph. Throws Error(usage) if halves need more than options.memory, naming what they
    /// need.
    explicit RayPhotographer(LightField light_field, const RayPhotographerOptions& options = {},
                             const Progress& progress = {});
    ~RayPhotographer();
    RayPhotographer(RayPhotographer&&) noexcept;
    RayPhotographer& operator=(RayPhotographer&&) noexcept;

    /// Throws Error(usage) as hogel::photograph() does, and Error(cancelled).
    Image photograph(const Camera& camera, const RayCamera& model = {}, const Progress& progress = {});
    /// As photograph() into `picture`, whose memory is reused if it has the camera's shape.
    void photograph_into(const Camera& camera, const RayCamera& model, Image& picture, const Progress& progress = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace hogel
