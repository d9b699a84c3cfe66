// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera.h"
#include "hogel/camera/narrow_band/band_grid.h"
#include "hogel/camera/packed_band.h"
#include "hogel/camera/sine_grid.h"
#include "hogel/core/object_pool.h"
#include "hogel/image.h"
#include "hogel/math/split_fft.h"
#include "hogel/optics/lines.h"

namespace hogel::camera::film {

/// Samples of a film per resolution cell. The intensity behind a pupil varies by at most one period per cell, so two
/// samples represent it; TwelvePoint interpolates between a few more.
inline constexpr double samples_a_cell = 2.4;
/// Returns the number of film samples per resolution cell. A preview has fewer: its pixels, wider than a cell, average
/// the finest speckle.
constexpr double film_samples(bool preview) { return preview ? 1.6 : samples_a_cell; }

/// One axis of an exposed film. The transform to the film covers the period of the sines; only the shown samples, first
/// … first + count − 1, are stored.
struct FilmAxis {
    std::size_t size = 0;  ///< number of samples of the transform
    std::size_t first = 0, count = 0;
    double low = 0, step = 0;  ///< direction sine of the first stored sample, and its step between samples
};

struct FilmSize {
    SineGrid sines;                           ///< at which the band is resampled
    std::ptrdiff_t reach_x = 0, reach_y = 0;  ///< radius of the pupil, in steps of the transform's frequencies
    FilmAxis x, y;
    /// Columns and rows of the sines that the band reaches, [begin, end).
    std::size_t active_left = 0, active_right = 0, active_low = 0, active_high = 0;
    std::size_t band_rows = 0;

    /// @param shown  film_area()
    FilmSize(const narrow_band::BandGrid& band, const FieldGrid& hologram, const Rectangle& shown, double pupil,
             double blur, double samples = samples_a_cell);
    /// Return the bytes of a pupil wave, and the peak memory of Film::pupil_wave() and expose() in addition to their
    /// results.
    double pupil_bytes() const;
    double work_bytes() const;
    double intensity_bytes() const;
};

using PupilWave = Array<math::PackedComplex, 2>;

/// Film of a viewpoint, from its narrow band to photographs (docs/notation.md section 4). The band is resampled to
/// direction sines, and one transform leads to the pupil. For each focus and size of the pupil a mask with a defocus
/// phase follows, and a transform back to the film.
///
/// The pupil covers a quarter of the band in x and in y, so its wave is small, and both transforms are limited to it.
/// The period of the sines is wide enough that no light that a camera follows wraps around (SpreadWindow). Only the
/// sines that the band reaches and the shown part of the film are computed. Each step works on all threads.
class Film {
  public:
    /// @param shown    film_area() of these cameras, metres: the hologram and the visible surroundings
    /// @param pupil    largest pupil diameter of these cameras, metres; at most that of the band
    /// @param blur     largest defocus_blur() of these cameras, direction sines
    /// @param samples  number of film samples per resolution cell
    Film(const narrow_band::BandGrid& band, const FieldGrid& hologram, const Rectangle& shown, double pupil,
         double blur, double samples = samples_a_cell);

    /// Returns an unexposed film: blocks of sixteen columns, [column / 16][row · 16 + column mod 16].
    Array<float, 2> unexposed() const {
        return Array<float, 2>({optics::blocks_of(size_.x.count), size_.y.count * optics::block_lines});
    }

    /// Returns the wave over the pupil, at frequencies −reach … reach of a transform of the sines: blocks of sixteen
    /// rows, [row / 16][column][row mod 16], zero beyond the last row.
    PupilWave pupil_wave(const PackedBand& band) const;

    /// Adds the intensities of several looks, each given by its pupil wave, to a camera's film with the shape of
    /// unexposed(). All looks share the computation of the lens.
    void expose(std::span<const PupilWave> pupil_waves, const Camera& camera, View<float, 2> intensity) const;

    /// Adds a camera's picture, in radiance, of the part `shown` of the hologram plane, within the film.
    /// @param weight  factor of the intensities: the reciprocal of the number of summed looks
    void develop(View<const float, 2> blocks, const Camera& camera, const Rectangle& shown, double weight,
                 Image& picture) const;

  private:
    // Arrays reused for each look, because the system would clear new ones.
    struct Scratch {
        // [active sine x / 16][row of the band / 16][sine x mod 16][part][row mod 16]
        Array<float, 3> columns;
        Array<float, 2> half;          // [frequency y / 16][active sine x][part][frequency y mod 16]
        Array<float, 2> film_columns;  // [column of the film / 16][frequency y][part][column mod 16]
    };

    // A camera's lens for light from the middle of a part of the film, and the weight of the part in the film's light.
    struct Node {
        Array<float, 2> lens;  // [row / 16][column][part][row mod 16], of the rows and columns below
        std::ptrdiff_t reach_x = 0;
        std::size_t first_block = 0;  // of rows
        Array<float, 1> share_x;      // padded to a multiple of sixteen
        std::vector<float> share_y;
    };

    void resample_rows(const PackedBand& band, std::vector<char>& is_active, Scratch& scratch) const;
    void transform_columns(const std::vector<char>& is_active, Scratch& scratch) const;
    void expose_node(const PupilWave& pupil_wave, const Node& node, View<float, 2> intensity) const;

    narrow_band::BandGrid band_;
    FieldGrid hologram_;
    FilmSize size_;
    math::SplitFft fft_x_, fft_y_;            // of the sines
    math::SplitFft film_fft_x_, film_fft_y_;  // of the film
    // Indices at which the transforms store the frequencies and film samples that are kept.
    std::vector<std::uint32_t> frequencies_x_, frequencies_y_, film_x_, film_y_;
    std::unique_ptr<core::ObjectPool<Scratch>> scratch_;
};

}  // namespace hogel::camera::film
