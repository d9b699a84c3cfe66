// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "hogel/resources.h"

/// Processor seconds per operation, for cost estimates. Measured on an AMD EPYC (Zen 5) with g++ 12 in November 2026.
namespace hogel::core::rates {

// On two cores, 2026-11-22 (docs/performance.md): a ray of `epi`, and the increment per million triangles; a ray that
// gathers reflected light (440e-9 for the pumpkin, 490e-9 for the church).
inline constexpr double ray = 1.9e-9, ray_and_million_triangles = 2.0e-9, gathered_ray = 450e-9;
// A sample compressed by the coder hogel to 40 dB, including the search for the quantiser step: 126e-9 for the pumpkin
// and 251e-9 for the church, at 48 x 48 directions. Not measured for other coders.
inline constexpr double coded_sample = 190e-9;
// Synthesis of a hologram sample, and an operation counted by propagation_method().
inline constexpr double hologram_sample = 5e-9, propagation_operation = 0.35e-9;

// View sets, 81 photographs of 960x640 (docs/exchange.md): a sample read from PNG and stored as a half float; a sample
// encoded as PNG; a sample of an interpolated view, 9x9 to 17x17 views of 512x512 pixels.
inline constexpr double imported_sample = 15e-9, exported_sample = 150e-9, interpolated_sample = 80e-9;

// Photographs by rays in three colours, one thread on an idle machine, 200 x 200 hogels, 16 x 16 to 800 x 800 pixels:
// per (pupil point, hogel), and per (pupil point, pixel).
inline constexpr double seen_hogel = 13e-9, seen_pixel = 2.7e-9;

// Photographs of holograms, on two threads of one core under load, 2026-11-23; from hogel spectra 2026-11-28 and -29. A
// hologram sample, for the pupil band of one viewpoint.
inline constexpr double sample_and_eye = 1.8e-9;
// From hogel spectra, per wave: its amplitude, once; its phase, per look; its contribution, per look and viewpoint.
inline constexpr double amplitude = 1e-9, wave = 0.25e-9, wave_and_eye = 0.15e-9;
// A sample of a pupil band, per look; a sample of a film, per look and photograph; for speckle-free photographs, a
// product of a hogel coefficient and a PSF sample.
inline constexpr double band_sample = 15e-9, film_sample = 10e-9, product = 0.04e-9;
// Mostly dark sets of lines behind a vertical diffuser (decision 0088): a sample of the direction sines; of the film.
inline constexpr double sine_of_lines = 1.3e-9, film_sample_of_lines = 0.9e-9;

/// Returns the wall time on all threads, seconds.
inline double on_all_threads(double processor_seconds) {
    return processor_seconds / static_cast<double>(std::max<std::size_t>(thread_count(), 1));
}

}  // namespace hogel::core::rates
