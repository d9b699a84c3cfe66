// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "hogel/resources.h"

/// Processor seconds of what plans count: the only place that knows them. Measured on an AMD EPYC (Zen 5) with g++ 12
/// in November 2026.
namespace hogel::core::rates {

// On two cores, 2026-11-22 (docs/performance.md): a ray of `epi`, and what a million triangles add to it; a ray that
// gathers reflected light (440e-9 for the pumpkin, 490e-9 for the church).
inline constexpr double ray = 1.9e-9, ray_and_million_triangles = 2.0e-9, gathered_ray = 450e-9;
// A sample that the coder hogel compresses to 40 dB, including the search for the step: 126e-9 for the pumpkin and
// 251e-9 for the church, at 48 x 48 directions. Other coders were not measured.
inline constexpr double coded_sample = 190e-9;
// A sample of a hologram, for its synthesis, and an operation that propagation_method() counts.
inline constexpr double hologram_sample = 5e-9, propagation_operation = 0.35e-9;

// Sets of views, 81 photographs of 960x640 (docs/exchange.md): a sample that is read from PNG files and written as a
// half float; one that is encoded as PNG; and one of a view between views, of 9x9 views of 512x512 pixels made 17x17.
inline constexpr double imported_sample = 15e-9, exported_sample = 150e-9, interpolated_sample = 80e-9;

// Photographs by rays in three colours, by one thread with nothing else on it, of 200 x 200 hogels and pictures of
// 16 x 16 to 800 x 800 pixels: a point of the pupil and hogel, and a point of the pupil and pixel.
inline constexpr double seen_hogel = 13e-9, seen_pixel = 2.7e-9;

// Photographs of holograms, on two threads of one core, 2026-11-23 and, from hogels, 2026-11-28 and -29, other programs
// beside it. A sample of a hologram, for the narrow band of one eye.
inline constexpr double sample_and_eye = 1.8e-9;
// From hogels. A wave: its amplitude, once; its phase, for each look; and its light, for each look and eye.
inline constexpr double amplitude = 1e-9, wave = 0.25e-9, wave_and_eye = 0.15e-9;
// A sample of a band, for each look; one of a film, for each look and photograph; and a product of a number of a hogel
// with a spot, of the mean of infinitely many looks.
inline constexpr double band_sample = 15e-9, film_sample = 10e-9, product = 0.04e-9;
// A sample of the sines and one of the film of a set of lines behind a vertical diffuser, most of which are dark
// (decision 0088).
inline constexpr double sine_of_lines = 1.3e-9, film_sample_of_lines = 0.9e-9;

/// Wall time.
inline double on_all_threads(double processor_seconds) {
    return processor_seconds / static_cast<double>(std::max<std::size_t>(thread_count(), 1));
}

}  // namespace hogel::core::rates
