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

/// Resamples the directions of one hogel from the light field's uniform U, V to the frequency grid j/d of the hogel's
/// Fourier transform ([K] 4.1, Lucente's grid), as amplitudes. A light field that is already sampled on that grid is
/// not resampled.
///
/// The wave of frequency (f_x, f_y) = (j_x, j_y)/d is the ray (U,V) = −λ(f_x, f_y)/√(1 − λ²|f|²). It lights a lobe of
/// width 1/d in frequency, so it carries the mean of the (by default bilinearly interpolated) light field over that
/// lobe. It is zero if the lobe is outside the field of view or |f| ≥ 1/λ.
class FrequencyGrid {
  public:
    /// @param samples   n_Δ, samples along a side of the hogel and frequencies along a side of the grid
    FrequencyGrid(const LightFieldGrid& light_field, std::size_t samples, double wavelength,
                  Interpolation between = Interpolation::linear);

    /// From several faces of a hemicube. The rays of a hogel are those of all faces, one after the other.
    FrequencyGrid(std::span<const LightFieldGrid> faces, std::size_t samples, double wavelength,
                  Interpolation between = Interpolation::linear);

    /// The grid of one line of a hologram with horizontal parallax only, whose light field has one row of directions:
    /// frequencies along x alone. The amplitude has the factor √(λ/d · λ/line_pitch), so that lines with independent
    /// phases have the right radiance in all vertical directions. `faces` is a front, optionally with the sides left
    /// and right, which also have one row.
    static FrequencyGrid of_line(std::span<const LightFieldGrid> faces, std::size_t samples, double line_pitch,
                                 double wavelength, Interpolation between = Interpolation::linear);

    /// Converts the radiances L[v][u] of a hogel into the moduli of its DFT coefficients, in the order in which a
    /// backward FFT takes them ([j_y mod n][j_x mod n], rows running down): (λ/d) √(L cos θ) / cos θ. This is [K] (4.2)
    /// with a² = L cos θ, the radiant intensity of a unit area of radiance L, and with the DFT's 1/n and Δ combined;
    /// see docs/notation.md.
    void amplitudes(std::span<const float> radiance, std::span<float> moduli) const;

    /// amplitudes() for many hogels, radiances[hogel][v u] to moduli[hogel][j_y j_x], sixteen at once.
    void amplitudes(View<const float, 2> radiances, View<float, 2> moduli) const;

    /// Returns the destination of a row of frequencies of sixteen hogels, [j_x mod n][hogel]. The previous row is
    /// complete when it is called for the next one.
    using PlaceOfRow = std::function<float*(std::size_t row)>;
    /// amplitudes() for up to sixteen hogels, row by row for the frequencies that carry light. Rows are in order,
    /// except for one jump. Columns of hogels beyond the last are undefined. If `of_roots`, the values are roots: see
    /// amplitudes_of_roots().
    void amplitudes_by_rows(View<const float, 2> radiances, bool of_roots, const PlaceOfRow& place) const;

    /// Converts amplitudes √L instead of radiances, averaged without squaring: λ/d · √(cos θ)/cos θ times the lobe's
    /// mean of √L. This map is linear, as basis fringes need; it is darker than amplitudes() where the radiance varies
    /// within a lobe.
    void amplitudes_of_roots(View<const float, 2> roots, View<float, 2> moduli) const;

    std::size_t columns() const { return columns_; }  ///< frequencies along a row, n_Δ
    std::size_t rows() const { return rows_; }        ///< n_Δ, or 1 for a line
    std::size_t coefficients() const { return rows_ * columns_; }
    std::size_t rays() const { return rays_; }  ///< of a hogel, over all faces
    /// Whether each row has any frequency that carries light.
    std::vector<bool> active_rows() const;

    // A DFT coefficient that carries light: the directions that it averages and their weights, as an outer product.
    struct Lobe {
        std::uint32_t coefficient;
        std::uint32_t u0, v0;   // first direction, v0 counted from the band's first row
        std::uint32_t nu, nv;   // directions in each dimension
        std::uint32_t weights;  // index in weights_ of the first of its nu + nv weights
        float scale;            // (λ/d)² / cos θ, applied under the root
    };

  private:
    FrequencyGrid(const LightFieldGrid& light_field, std::size_t rows, std::size_t columns, double step_up,
                  double wavelength, Interpolation between);
    FrequencyGrid(std::span<const LightFieldGrid> faces, std::size_t rows, std::size_t columns, double step_up,
                  double wavelength, Interpolation between);
    void average(View<const float, 2> values, bool of_roots, View<float, 2> moduli) const;
    void average_run(std::size_t lobe, std::size_t count, View<const float, 2> beside, bool of_roots, float* out) const;

    // Consecutive whole rows of lobes with the range of the light field that they use, few enough for the first caches.
    struct Band {
        std::size_t lobe0 = 0, lobes = 0;
        std::size_t ray0 = 0, rays = 0;
        std::size_t run0 = 0, runs = 0;
    };
    // A run of lobes whose coefficients are contiguous in a row.
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
    HemicubeResampling resampling_;  // used instead of lobes if there are several faces
    std::vector<Lobe> lobes_;
    std::vector<float> weights_;
    std::vector<Band> bands_;
    std::vector<Run> runs_;  // of the lobes of each band, in order
};

/// Whether a light field's directions are those of the hogels' Fourier transform at this wavelength.
bool is_frequency_grid(const LightFieldGrid& light_field, double wavelength);

}  // namespace hogel::stereogram
