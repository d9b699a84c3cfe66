// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

// Measurements, each of one part of the library on inputs that it makes itself. Each prints a table or a few lines.
namespace hogel::bench {

struct CameraStudy {
    std::size_t samples = 6144;  ///< across the hologram of the narrow-band measurement
    std::size_t rounds = 3;
};
/// Speed of the cameras and of propagation on fields of noise in memory, against the bare Fourier transforms that they
/// need. Prints for each the best time of the rounds, in brackets the processor time:
///   - the speed of reading a hologram into the narrow band; - a photograph of 1024 × 1024 pixels after a new focus,
///   from a film of about as many samples; - 2048 × 2048 samples to another plane; - a photograph of 4096 × 4096
///   samples by the full camera.
void study_camera(const CameraStudy& study);

struct HologramStudy {
    std::size_t samples = 256;         ///< along a side of the hologram
    std::size_t looks = 2;             ///< photographs of independent phases that are averaged
    std::vector<std::string> methods;  ///< names as in the table; empty: all
};
/// Quality of the photograph and time of every hologram method on the same scenes: a small patch, a wide surface of one
/// radiance, a textured plane tilted by 15 degrees, and a near plane that hides half of a far one, at depths from −20
/// to 20 mm. The hologram has a pitch of 3 µm at 633 nm. The camera has a lens of 3 mm, 100 mm away, focused on the
/// middle of the scene or on the near plane. The reference is the same camera by rays. PSNR and SSIM are limited by
/// speckle, alike for all methods. Seconds: processor time of one hologram.
void study_hologram(const HologramStudy& study);

struct DetailStudy {
    std::size_t looks = 64;  ///< independent phases whose intensities are averaged
    double period = 120e-6;  ///< of the texture, metres
};
/// How much detail photographs of holograms have away from the plane: PSNR of a textured plane in focus, at depths from
/// −10 to 10 mm, against the exact picture, for `fourier` and the methods with phases of points. The hologram has 256 ×
/// 256 samples of 3 µm at 633 nm, the camera a pupil of 4 mm, 100 mm away, and pixels of 12.5 µm.
void study_detail(const DetailStudy& study);

struct EyeStudy {
    std::string scene = "pumpkin";  ///< a name in scenes()
    std::size_t hogels = 400;       ///< along a side; the hologram and its directions are the defaults of hogel make
    std::size_t looks = 1;
    std::size_t rounds = 3;
};
/// The eye camera beside the narrow-band camera, which computes all samples, with the same phases, from a light field
/// in memory: of 532 nm, for eyes over the cone that the field of view covers, focuses and pupils, and for each method
/// that knows its hogels' waves. Prints PSNR and maximum error of display values, and wall and processor time, the
/// least of rounds in turns; then those of a new eye of EyePhotographer, in full and as a preview, of another focus of
/// the same eye, and of the mean of infinitely many looks in three colours.
void study_eye(const EyeStudy& study);

struct RaysStudy {
    std::string scene = "pumpkin";  ///< a name in scenes()
    std::size_t hogels = 400;       ///< along a side of a hologram with the size and angles of hogel make
    std::size_t directions = 32;    ///< along a side
    std::size_t pixels = 512;       ///< along a side of the picture
    std::size_t pictures = 40;      ///< from eyes that walk over the cone of directions
    std::vector<std::size_t> pupil_samples{1, 4, 16, 64};
};
/// Photographs by rays of a light field in memory, as a viewer takes them: each from another eye and with another
/// focus, with a pupil of 4 mm, into the memory of the picture before; by photograph(), and by RayPhotographer from
/// floats and from halves. Prints pictures a second, the median and the longest wall time of a picture, and its
/// processor time.
void study_rays(const RaysStudy& study);

struct PatternStudy {
    std::size_t samples = 512;  ///< along a side of the hologram
    std::size_t iterations = 40;
};
/// Quality of the photograph, light efficiency and time of every encoding for a modulator, of the same hologram: a wavy
/// picture 10 mm behind a hologram with a pitch of 8 µm at 633 nm, made of hogels of 16 samples whose light fills 15 %
/// of what the pitch diffracts to. The photograph of the pattern's order, rotated to straight ahead, through a lens of
/// 3 mm, 300 mm away, is compared with that of the light field by rays, both scaled to the same mean. So is the
/// photograph of the complex field itself: its speckle limits every encoding.
void study_pattern(const PatternStudy& study);

struct StereogramStudy {
    std::size_t samples = 4096;  ///< along a side of the hologram
    std::size_t rounds = 5;
};
/// Speed of plain stereograms, on one thread, beside the bare Fourier transforms that they need. For each size of hogel
/// prints million samples per second of processor time, the best of the rounds: of the stereogram with random phases,
/// from a light field of noise in memory to a field in memory, whose directions fill what the pitch diffracts to; and
/// of the transforms of as many squares of that size, one after the other over a whole hologram, in place.
void study_stereogram(const StereogramStudy& study);

struct FringeStudy {
    std::string scene = "pumpkin";
    std::string transform = "ai33";
    std::string only;  ///< measures kinds of holograms whose name holds this text
    std::size_t rounds = 5;
};
/// Basis fringes against Fourier transforms, [K] fig. 4.1b, on one thread, from coefficients of the directions: sums of
/// fringes by the number of coefficients that each hogel keeps, beside inverting the transform, resampling and one
/// Fourier transform a hogel or line. Prints nanoseconds a sample of processor time, the best of the rounds, which
/// alternate; up to how many coefficients fringes are faster; and how many the light field of a scene needs.
void study_fringes(const FringeStudy& study);

struct FourierStudy {
    std::size_t rounds = 9;
};
/// Speed of Fourier transforms in place: many lines of one length, squares of the size of hogels, large arrays. Prints
/// nanoseconds a sample by the clock, the best of the rounds, beside those of FFTW on one thread where it is installed,
/// with plans that it estimates and plans that it measures. All alternate in every round.
void study_fourier(const FourierStudy& study);

struct SpeedStudy {
    std::string scene =
        "sphere";  ///< sphere: displaced, behind the hologram; sheets: eight, the first hides the others
    std::size_t triangles = 20000;
    std::size_t hogels = 64, directions = 256;  ///< along a side
    std::size_t tile = 0;                       ///< hogels that are rendered at once, in a row; 0: the whole row
    std::size_t rounds = 5;
    std::vector<std::string> algorithms;  ///< empty: all
};
/// Samples a second of renderers, with all channels of a ray counted as one sample: per second of wall time and of
/// processor time, medians over the rounds. The renderers alternate in every round, so that other work on the machine
/// affects all alike.
void study_speed(const SpeedStudy& study);

}  // namespace hogel::bench
