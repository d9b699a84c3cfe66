// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hogel/light_field.h"
#include "hogel/stereogram/hemicube_resampling.h"

namespace hogel::stereogram {

/// Resamples the directions of one hogel, as amplitudes, from the light field's uniform U, V to the frequency grid j/d
/// of the hogel's Fourier transform ([K] 4.1, Lucente's grid). Light fields sampled on that grid are not resampled.
///
/// The wave of frequency (f_x, f_y) = (j_x, j_y)/d is the ray (U,V) = −λ(f_x, f_y)/√(1 − λ²|f|²). It covers a lobe of
/// width 1/d in frequency and carries the mean of the interpolated (default: bilinear) light field over that lobe. It
/// is zero if the lobe is outside the field of view or |f| ≥ 1/λ.
class FrequencyGrid {
  public:
    /// @param samples  n_Δ, number of samples along a side of the hogel and of frequencies along a side of the grid
    FrequencyGrid(const LightFieldGrid& light_field, std::size_t samples, double wavelength,
                  Interpolation interpolation = Interpolation::linear);

    /// For several faces of a hemicube. A hogel's rays are those of all faces, face after face.
    FrequencyGrid(std::span<const LightFieldGrid> faces, std::size_t samples, double wavelength,
                  Interpolation interpolation = Interpolation::linear);

    /// Returns the grid of one line of a hologram with horizontal parallax only: frequencies along x, from one row of
    /// directions. Multiplies amplitudes by √(λ/d · λ/line_pitch), d = pitch of the hogels, all in metres. Lines with
    /// independent phases then have the right radiance in all vertical directions.
    /// @param faces  a front, optionally with left and right sides; each has one row of directions
    static FrequencyGrid of_line(std::span<const LightFieldGrid> faces, std::size_t samples, double line_pitch,
                                 double wavelength, Interpolation interpolation = Interpolation::linear);

    /// Converts the radiances L[v][u] of a hogel to the moduli of its DFT coefficients, (λ/d) √(L cos θ) / cos θ, in
    /// the order of a backward FFT: [j_y mod n][j_x mod n], rows running down. This is [K] (4.2) with a² = L cos θ, the
    /// radiant intensity of a unit area of radiance L, combined with the DFT's 1/n and Δ; see docs/notation.md.
    void amplitudes(std::span<const float> radiance, std::span<float> moduli) const;

    /// As amplitudes(), for an array of hogels, sixteen at once: radiances[hogel][v u] to moduli[hogel][j_y j_x].
    void amplitudes(View<const float, 2> radiances, View<float, 2> moduli) const;

    /// Returns the destination of row `row` of sixteen hogels, [j_x mod n][hogel]. Called when the previous row is
    /// complete.
    using RowDestination = std::function<float*(std::size_t row)>;
    /// As amplitudes(), for up to sixteen hogels, row by row for the rows with active frequencies. Row indices ascend,
    /// but for one jump back. Columns of hogels beyond the last are undefined. `of_roots`: the values are √L, see
    /// amplitudes_of_roots().
    void amplitudes_by_rows(View<const float, 2> radiances, bool of_roots, const RowDestination& destination) const;

    /// Converts amplitudes √L and averages them without squaring: λ/d · √(cos θ)/cos θ times the lobe's mean of √L. The
    /// map is linear, as basis fringes need, and darker than amplitudes() where the radiance varies within a lobe.
    void amplitudes_of_roots(View<const float, 2> roots, View<float, 2> moduli) const;

    std::size_t columns() const { return columns_; }  ///< frequencies along a row, n_Δ
    std::size_t rows() const { return rows_; }        ///< n_Δ, or 1 for a line
    std::size_t coefficients() const { return rows_ * columns_; }
    std::size_t rays() const { return rays_; }  ///< of a hogel, over all faces
    /// Returns for each row whether it has an active frequency.
    std::vector<bool> active_rows() const;

    // An active DFT coefficient: the directions that it averages, and their weights as an outer product.
    struct Lobe {
        std::uint32_t coefficient;
        std::uint32_t u0, v0;   // first direction, v0 counted from the band's first row
        std::uint32_t nu, nv;   // directions in each dimension
        std::uint32_t weights;  // index in weights_ of the first of its nu + nv weights
        float scale;            // (λ/d)² / cos θ, applied under the root
    };

  private:
    FrequencyGrid(const LightFieldGrid& light_field, std::size_t rows, std::size_t columns, double step_y,
                  double wavelength, Interpolation interpolation);
    FrequencyGrid(std::span<const LightFieldGrid> faces, std::size_t rows, std::size_t columns, double step_y,
                  double wavelength, Interpolation interpolation);
    void average(View<const float, 2> values, bool of_roots, View<float, 2> moduli) const;
    void average_run(std::size_t lobe, std::size_t count, View<const float, 2> transposed, bool of_roots,
                     float* out) const;

    // Consecutive whole rows of lobes and the rays that they use, few enough for the L2 cache.
    struct Band {
        std::size_t lobe0 = 0, lobes = 0;
        std::size_t ray0 = 0, rays = 0;
        std::size_t run0 = 0, runs = 0;
    };
    // Lobes with contiguous coefficients in a row.
    struct Run {
        std::uint32_t lobe, row, column, count;
    };
    void list_bands();
    void list_runs();
    std::uint32_t coefficient(std::size_t lobe) const {
        return lobes_.empty() ? resampling_.lobes[lobe].coefficient : lobes_[lobe].coefficient;
    }

    std::size_t rows_, columns_;
    std::size_t rays_;
    std::size_t row_length_;         // n_U
    HemicubeResampling resampling_;  // replaces lobes_ for several faces
    std::vector<Lobe> lobes_;
    std::vector<float> weights_;
    std::vector<Band> bands_;
    std::vector<Run> runs_;  // of the lobes of each band, in order
};

/// Returns whether a light field's directions are those of the hogels' Fourier transform at this wavelength.
bool is_frequency_grid(const LightFieldGrid& light_field, double wavelength);

}  // namespace hogel::stereogram
