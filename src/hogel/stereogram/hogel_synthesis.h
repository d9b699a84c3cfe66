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

struct HogelKey {
    std::size_t s = 0, t = 0;  ///< column and row of the hogel
    std::size_t look = 0;
};

/// Returns the bytes that the synthesis of a hologram of `hogels` hogels needs on all threads.
double synthesis_bytes(const FieldGrid& hologram, std::size_t hogels);

/// First step of a synthesis: values per hogel that all looks share.
class HogelPreparation {
  public:
    virtual ~HogelPreparation() = default;
    /// Returns the number of values per hogel that prepare() computes.
    virtual std::size_t prepared_size() const = 0;
    /// Prepares several hogels at once. Thread-safe.
    /// @param radiances  [hogel][n_V n_U] of this wavelength
    /// @param depths     [hogel][n_V n_U], metres; empty if the method needs no depth
    /// @param prepared   [hogel][prepared_size()]
    virtual void prepare(View<const float, 2> radiances, View<const float, 2> depths,
                         View<float, 2> prepared) const = 0;
};

/// Source of the waves of hogels. A hogel is the Fourier transform of its waves, one for each of its samples.
class HogelWaves : public virtual HogelPreparation {
  public:
    /// Computes the waves of a hogel in blocks of sixteen rows of frequencies, [row / 16][column][part][row mod 16]:
    /// frequencies 0 … n−1, parts real and imaginary, zero in rows beyond the last. Their backward transform is the
    /// hogel's samples without a window. Phases are counted from the first sample.
    /// @param prepared  by prepare()
    /// @param rows      needed rows; blocks without any of them may stay unchanged
    /// @param waves     size() values, aligned to a cache line
    virtual void waves(std::span<const float> prepared, const HogelKey& key, const InBandRows& rows,
                       float* waves) const = 0;
    /// Computes |waves|², [row / 16][column][row mod 16], zero in rows beyond n: powers_size() values. Needs
    /// independent().
    virtual void powers(std::span<const float> /*prepared*/, float* /*powers*/) const {}
    /// Returns whether hogels are squares without a window and all waves of all hogels have independent random phases.
    virtual bool independent() const { return false; }

    /// Returns whether a row of waves may be nonzero in any hogel.
    virtual bool has_light(std::size_t /*row*/) const { return true; }

    /// Number of hogels or looks in the lanes of a vector.
    static constexpr std::size_t lanes = rows_at_once;
    /// Returns whether the functions below are supported.
    virtual bool has_lanes() const { return false; }
    /// Returns the random phases of at most `lanes` hogels or looks.
    virtual SeriesOfLanes series_of_lanes(std::span<const HogelKey>) const { return {}; }
    /// Gathers sixteen rows of the prepared values of at most `lanes` hogels, in the form that row_of_lanes() takes.
    /// Writes only the part of these rows in `gathered`, an array of powers_size() · lanes values. Rows without light
    /// may stay unchanged.
    /// @param row       index of the first row, a multiple of sixteen
    /// @param gathered  values of all rows
    virtual void gather_lanes(std::span<const float* const>, std::size_t /*row*/, float* /*gathered*/) const {}
    /// Computes one row of waves of hogels or looks side by side, [column][part][lane]. Phases are counted from the
    /// middle of the hogel.
    /// @param shared    whether all lanes are looks of one hogel
    /// @param prepared  values of that hogel, or of gather_lanes(); aligned to a cache line
    virtual void row_of_lanes(const SeriesOfLanes&, std::size_t /*row*/, bool /*shared*/, const float* /*prepared*/,
                              float* /*waves*/) const {}
    static constexpr std::size_t block_rows = 16;
    static std::size_t powers_size(std::size_t samples) { return size(samples, samples) / 2; }
    static std::size_t size(std::size_t rows, std::size_t columns) {
        return (rows + block_rows - 1) / block_rows * block_rows * columns * 2;
    }
};

/// Stores the waves of a hogel, [row][column], in the layout of HogelWaves::waves(). Skips blocks without needed rows.
inline void store_waves(View<const std::complex<float>, 2> plain, const InBandRows& needed, float* waves) {
    constexpr std::size_t block_rows = HogelWaves::block_rows;
    const std::size_t rows = plain.extent(0), columns = plain.extent(1);
    for (std::size_t first = 0; first < rows; first += block_rows) {
        if (!needed.has_any(first, block_rows, rows)) continue;
        float* block = waves + 2 * first * columns;
        const std::size_t end = std::min(rows, first + block_rows);
        if (end < first + block_rows) std::fill_n(block, 2 * block_rows * columns, 0.0f);
        for (std::size_t row = first; row < end; ++row) {
            float* to = block + row - first;
            for (std::size_t column = 0; column < columns; ++column, to += 2 * block_rows) {
                to[0] = plain(row, column).real();
                to[block_rows] = plain(row, column).imag();
            }
        }
    }
}

/// Computes the n×n samples of a hogel from its rays in two steps; the first is shared by all looks. Each synthesis
/// defines whether phases are counted from the hogel's centre or from its first sample.
class HogelSynthesis : public virtual HogelPreparation {
  public:
    virtual void synthesise(std::span<const float> prepared, const HogelKey& key,
                            View<std::complex<float>, 2> hogel) const = 0;
    /// As synthesise(), but writes row y to to + y·to_stride; `scratch` is a buffer of the hogel's shape.
    virtual void synthesise_to(std::span<const float> prepared, const HogelKey& key,
                               View<std::complex<float>, 2> scratch, std::complex<float>* to,
                               std::size_t to_stride) const {
        synthesise(prepared, key, scratch);
        for (std::size_t y = 0; y < scratch.extent(0); ++y)
            std::copy_n(&scratch(y, 0), scratch.extent(1), to + y * to_stride);
    }
    /// Returns the source of the hogels' waves, or null if hogels are not sums of one wave per sample. Its prepared
    /// values may differ from those of this synthesis.
    virtual const HogelWaves* hogel_waves() const { return nullptr; }
};

/// Makes a synthesis by one FFT per hogel from amplitudes on the frequency grid j/d, with random, fixed or designed
/// phases: [K] (4.2). A hogel's rays are those of all faces, face after face.
std::unique_ptr<HogelSynthesis> make_fourier_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                       const HologramOptions& options, const Fourier& method);

/// Makes a synthesis with horizontal parallax only, by one independent FFT per line of a hogel: [K] (3.23).
std::unique_ptr<HogelSynthesis> make_line_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                    std::size_t lines, const HologramOptions& options,
                                                    const Lines& method);

/// Meaning of the ray values that a synthesis receives.
enum class RayValues {
    radiance,
    coefficients,  ///< of a transform of √L over the directions of each hogel
};

/// Makes a synthesis by sums of basis fringes weighted with coefficients: [K] (3.24). A hogel's rays, or their
/// coefficients, are those of all faces, face after face. Throws Error(usage) for an unknown transform and for fringes
/// that do not fit into memory. Defined in thesis/fringes.
/// @param rows  samples of a hogel from top to bottom; for horizontal parallax only, its lines
std::unique_ptr<HogelSynthesis> make_basis_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                     std::size_t rows, const HologramOptions& options,
                                                     const Basis& method, RayValues values);

/// Makes a synthesis by one plane wave per ray, with the phase of a spherical wave from the point that the ray meets.
std::unique_ptr<HogelSynthesis> make_phase_added_synthesis(const LightFieldGrid& light_field, std::size_t samples,
                                                           const HologramOptions& options, bool exact);

}  // namespace hogel::stereogram
