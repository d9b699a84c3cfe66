// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/image.h"
#include "hogel/pattern.h"
#include "hogel/progress.h"

namespace hogel {

/// Light source of a bench, in the focal plane of its collimator. The collimator has the focal length of the lenses.
struct LightSource {
    enum class Kind {
        laser,   ///< one point, at the wavelength of the pattern
        led,     ///< a disc of incoherent points with a Gaussian spectrum
        points,  ///< `points` incoherent points, evenly spread over a disc, at the wavelength of the pattern
    };
    Kind kind = Kind::laser;
    double size = 0;         ///< diameter of the disc, metres
    std::size_t points = 1;  ///< of Kind::points, at most max_source_points
    double wavelength = 0;   ///< of Kind::led: mean, metres
    double bandwidth = 0;    ///< of Kind::led: full width at half maximum of the spectrum, metres
};
inline constexpr std::size_t max_source_points = 4096;

/// Optical bench of a modulator (docs/modulators.md, "The bench"): a lens in front of the modulator, an aperture in its
/// focal plane, a second lens of the same focal length whose axis passes the middle of the aperture, and a film.
struct Bench {
    double focal_length = 0;  ///< of both lenses, metres
    /// The aperture. A radius of 0 is the largest that passes one order, half a cycle per pixel.
    Aperture aperture = {};
    double zero_order_stop = 0;  ///< radius of an opaque disc around frequency zero, cycles per pixel; 0: none
    double focus = 0;            ///< depth of the plane in focus behind the modulator, metres; negative: in front
    /// Share of a pixel's area that modulates, a square in its middle. The rest reflects with the amplitude 1.
    double fill_factor = 1;
    LightSource source = {};
};

/// Photograph of a pattern on a bench.
struct BenchPhotograph {
    /// One channel with the pixels of the modulator, each the mean intensity over its area. A mirror in place of the
    /// modulator has the intensity 1.
    Image picture;
    /// Speckle contrast on the film: the median of σ/mean of the intensity in windows of 32x32 film samples, over the
    /// windows with at least half the mean of the brightest; 0 without a window. Film samples are about λf/4R apart.
    double contrast = 0;
    double efficiency = 0;                    ///< share of the light on the modulator that passes the aperture
    double resolution = 0;                    ///< 0.61 λf/R, metres
    std::size_t points = 1, wavelengths = 1;  ///< of the source, in the computation
    bool is_converged = true;                 ///< false: a led needs more points than the computation takes
};

/// Photographs a pattern, the complex reflectance of each pixel, on a bench. Coherent light of each point and
/// wavelength is propagated by the angular spectrum ([K] 6.1.1); intensities add. The phases of the pattern are those
/// of its own wavelength λ0; at λ they are multiplied by λ0/λ. Memory: arrays of the panel, enlarged by the sideways
/// spread of light up to the plane in focus. Throws Error(usage) for an invalid bench, for pixels that are not square,
/// and for a focus so far away that light spreads over more than max_modulator_side pixels.
HOGEL_API BenchPhotograph photograph_on_bench(const FieldSource& pattern, const Bench& bench,
                                              const Progress& progress = {});

}  // namespace hogel
