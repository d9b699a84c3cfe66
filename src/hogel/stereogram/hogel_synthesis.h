// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <complex>
#include <memory>
#include <span>

#include "hogel/hologram.h"
#include "hogel/stereogram/hogel_tiles.h"
#include "hogel/stereogram/in_band_rows.h"

namespace hogel::stereogram {

/// A hogel and a look.
struct HogelKey {
    std::size_t s = 0, t = 0;  ///< column and row of the hogel
    std::size_t look = 0;
};

/// Bytes of the synthesis of a hologram of so many hogels, of which all threads compute parts.
double synthesis_bytes(const FieldGrid& hologram, std::size_t hogels);

/// The step from the rays of a hogel that all looks share.
class HogelPreparation {
  public:
    virtual ~HogelPreparation() = default;
    /// The number of values per hogel that prepare() computes.
    virtual std::size_t prepared_size() const = 0;
    /// Prepares several hogels at once.
    /// @param radiances  [hogel][n_V n_U] of this wavelength
    /// @param depths     [hogel][n_V n_U], or empty if the method needs no depth
    /// @param prepared   [hogel][prepared_size()]
    virtual void prepare(View<const float, 2> radiances, View<const float, 2> depths,
                         View<float, 2> prepared) const = 0;
};

/// Computes the waves, as many as it has samples, of which a hogel is the sum.
class HogelWaves : public virtual HogelPreparation {
  public:
    /// The waves of a hogel, in blocks of sixteen rows of frequencies: [row / 16][column][part][row mod 16] with
    /// frequencies 0 … n−1, the parts real and imaginary, zero in rows beyond the last. The hogel's samples, before a
    /// window, are their backward transform; their phases are counted from the first sample.
    /// @param prepared  by prepare()
    /// @param rows      that are needed; blocks without any of them may be left as they are
    /// @param waves     size() values, aligned to a cache line
    virtual void waves(std::span<const float> prepared, const HogelKey& place, const InBandRows& rows,
                       float* waves) const = 0;
    /// |waves|² in blocks of sixteen rows [row / 16][column][row mod 16], zero in rows beyond n: powers_size() values.
    /// Only if the waves are independent.
    virtual void powers(std::span<const float> /*prepared*/, float* /*powers*/) const {}
    /// Whether hogels are squares without a window, of which the phases of all waves of all hogels are random and
    /// independent.
    virtual bool independent() const { return false; }

    /// Whether waves of a row may have light, in any hogel.
    virtual bool has_light(std::size_t /*row*/) const { return true; }

    /// The number of hogels or looks that are lanes of vectors.
    static constexpr std::size_t lanes = rows_at_once;
    /// Whether the functions below compute waves.
    virtual bool has_lanes() const { return false; }
    /// The phases of some hogels or looks, at most `lanes`.
    virtual SeriesOfLanes series_of_lanes(std::span<const HogelKey>) const { return {}; }
    /// Stores what hogels have prepared for sixteen rows, at most one hogel for each lane, as row_of_lanes() takes it:
    /// its part of powers_size() · lanes values. Rows without light may be left as they are.
    /// @param row       the first one, a multiple of sixteen
    /// @param gathered  all values
    virtual void gather_lanes(std::span<const float* const>, std::size_t /*row*/, float* /*gathered*/) const {}
    /// One row of waves of hogels or looks side by side, [column][part][lane], with phases counted from the middle of
    /// the hogel.
    /// @param shared    whether all are looks of one hogel
    /// @param prepared  of that hogel, or from gather_lanes(); aligned to a cache line
    virtual void row_of_lanes(const SeriesOfLanes&, std::size_t /*row*/, bool /*shared*/, const float* /*prepared*/,
                              float* /*waves*/) const {}
    static constexpr std::size_t block_rows = 16;
    static std::size_t powers_size(std::size_t samples) { return size(samples, samples) / 2; }
    static std::size_t size(std::size_t rows, std::size_t columns) {
        return (rows + block_rows - 1) / block_rows * block_rows * columns * 2;
    }
};

/// Stores all waves of a hogel, [row][column], in the layout of HogelWaves::waves(), but for blocks without any of
/// `needed`.
inline void store_waves(View<const std::complex<float>, 2> plain, const InBandRows& needed, float* waves) {
    constexpr std::size_t together = HogelWaves::block_rows;
    const std::size_t rows = plain.extent(0), columns = plain.extent(1);
    for (std::size_t first = 0; first < rows; first += together) {
        if (!needed.has_any(first, together, rows)) continue;
        float* block = waves + 2 * first * columns;
        const std::size_t end = std::min(rows, first + together);
        if (end < first + together) std::fill_n(block, 2 * together * columns, 0.0f);
        for (std::size_t row = first; row < end; ++row) {
            float* to = block + row - first;
            for (std::size_t column = 0; column < columns; ++column, to += 2 * together) {
                to[0] = plain(row, column).real();
                to[together] = plain(row, column).imag();
            }
        }
    }
}

/// Computes the n×n samples of a hogel from its rays in two steps, the first of which is shared by all looks. Each
/// synthesis defines whether phases are counted from the hogel's centre or from its first sample.
class HogelSynthesis : public virtual HogelPreparation {
  public:
    virtual void synthesise(std::span<const float> prepared, const HogelKey& place,
                            View<std::complex<float>, 2> hogel) const = 0;
    /// As synthesise(), but writes row y to to + y·to_row; `scratch` is a buffer of the hogel's shape.
    virtual void synthesise_to(std::span<const float> prepared, const HogelKey& place,
                               View<std::complex<float>, 2> scratch, std::complex<float>* to,
                               std::size_t to_row) const {
        synthesise(prepared, place, scratch);
        for (std::size_t y = 0; y < scratch.extent(0); ++y)
            std::copy_n(&scratch(y, 0), scratch.extent(1), to + y * to_row);
    }
    /// The hogels' waves, if each hogel is the Fourier transform of as many waves as it has samples; otherwise null.
    /// They may be prepared in another way than samples.
    virtual const HogelWaves* hogel_waves() const { return nullptr; }
};

/// Amplitudes on the frequency grid j/d with random, fixed or designed phases, then one FFT: [K] (4.2). The rays of a
/// hogel are those of all faces, face after face.
std::unique_ptr<HogelSynthesis> make_fourier_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                       const HologramOptions& options, const Fourier& method);

/// Horizontal parallax only: one independent FFT for each line of a hogel, [K] (3.23).
std::unique_ptr<HogelSynthesis> make_line_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                    std::size_t lines, const HologramOptions& options,
                                                    const Lines& method);

/// The meaning of the values of rays that a synthesis receives.
enum class RayValues {
    radiance,
    coefficients,  ///< of a transform of √L over the directions of each hogel
};

/// A sum of basis fringes weighted with coefficients: [K] (3.24). The rays of a hogel, or their coefficients, are those
/// of all faces, face after face. Throws Error(usage) for a transform that does not exist and for fringes that would
/// not fit into memory. Defined in thesis/fringes.
/// @param rows  samples of a hogel from top to bottom; for horizontal parallax only, its lines
std::unique_ptr<HogelSynthesis> make_basis_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                     std::size_t rows, const HologramOptions& options,
                                                     const Basis& method, RayValues values);

/// One plane wave per ray, with the phase of a spherical wave from the point that the ray meets.
std::unique_ptr<HogelSynthesis> make_phase_added_synthesis(const LightFieldGrid& light_field, std::size_t samples,
                                                           const HologramOptions& options, bool exact);

}  // namespace hogel::stereogram
