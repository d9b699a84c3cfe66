// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hogel/camera/narrow_band/band_grid.h"
#include "hogel/field.h"

namespace hogel::camera::narrow_band {

/// A narrow band computed from the samples of a hologram: the demodulated field, low-passed and decimated by `factor`.
struct NarrowBand : BandGrid {
    std::size_t factor = 1;   ///< samples of the hologram per sample of the band, in x and in y
    std::vector<float> taps;  ///< the low-pass: band sample b is Σ_k taps[k] · hologram sample (first_tap(b) + k)

    /// Throws Error(usage) if the field is sampled too coarsely to separate the pupil's light from the rest.
    NarrowBand(const FieldGrid& hologram, Vec3 viewpoint, double pupil);

    /// Returns the position of band sample `index`, in samples of the hologram; the same for columns and rows.
    double hologram_index(std::size_t index) const;
    /// Returns the hologram sample at the first tap of band sample `index`; it may be before the first sample.
    std::ptrdiff_t first_tap(std::size_t index) const;

    /// Samples of the band beyond either end of the hologram.
    static constexpr std::size_t margin = 5;
    /// Size of the tiles in which the hologram is read: wide enough to share column weights among many columns, small
    /// enough for the processor's caches. It does not depend on the source, so that photographs of a hologram from a
    /// file and from its synthesis are the same to the byte.
    static constexpr std::size_t tile_width = 512, tile_height = 384;
};

/// Computes several narrow bands of looks first_look to first_look + looks − 1 of a hologram (a look is one set of
/// random phases), in one pass over the hologram. Returns bands[viewpoint][look][row][column]: the field demodulated
/// towards the viewpoint, low-passed and decimated by NarrowBand::factor. The result does not depend on the number of
/// threads. With MPI, only the root receives it. Memory: the result, and per thread a strip of the hologram of at most
/// eight tiles across and two down.
std::vector<std::vector<Array<std::complex<float>, 2>>> compute_narrow_bands(const FieldSource& hologram,
                                                                             std::span<const NarrowBand> narrow_bands,
                                                                             std::size_t first_look, std::size_t looks,
                                                                             const Progress& progress = {});

}  // namespace hogel::camera::narrow_band
