#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/lightfield/light_field.h"

namespace hogel {

/// What a light field is between its samples.
enum class Between {
    linear,    ///< linear interpolation
    constant,  ///< the nearest sample: pieces as large as a sample's cell
};

/// Resamples the directions of one hogel from the light field's uniform U, V to the frequency grid j/d of the hogel's
/// Fourier transform ([K] 4.1, Lucente's grid), as amplitudes.
///
/// The wave of frequency (f_x, f_y) = (j_x, j_y)/d is the ray (U,V) = −λ(f_x, f_y)/√(1 − λ²|f|²). It lights a lobe of
/// width 1/d in frequency, so it carries the mean of the (by default bilinearly interpolated) light field over that
/// lobe. Where the lobe lies outside the field of view, or |f| ≥ 1/λ, there is nothing.
class FrequencyGrid {
  public:
    /// @param samples   n_Δ, samples along a side of the hogel and frequencies along a side of the grid
    FrequencyGrid(const LightFieldGrid& light_field, std::size_t samples, double wavelength,
                  Between between = Between::linear);

    /// Turns the radiances L[v][u] of a hogel into the moduli of its DFT coefficients, in the order in which a backward
    /// FFT wants them ([j_y mod n][j_x mod n], rows running down): (λ/d) √(L cos θ) / cos θ.
    /// This is [K] (4.2) with a² = L cos θ, the radiant intensity of a piece of surface of radiance L, and with the
    /// DFT's 1/n and Δ drawn together; see docs/notation.md.
    void amplitudes(std::span<const float> radiance, std::span<float> moduli) const;

    /// The same for many hogels, radiances[hogel][v u] to moduli[hogel][j_y j_x], sixteen at once.
    void amplitudes(View<const float, 2> radiances, View<float, 2> moduli) const;

    /// From amplitudes √L instead of radiances, which are averaged as they are: λ/d · √(cos θ)/cos θ times the lobe's
    /// mean of √L. A linear map, which basis fringes need; darker than amplitudes() where the radiance varies in a
    /// lobe.
    void amplitudes_of_roots(View<const float, 2> roots, View<float, 2> moduli) const;

    std::size_t samples() const { return samples_; }

    // A DFT coefficient that carries light: the directions that it averages and their weights, as an outer product.
    struct Lobe {
        std::uint32_t coefficient;
        std::uint32_t u0, v0;   // first direction
        std::uint32_t nu, nv;   // directions in each dimension
        std::uint32_t weights;  // where in weights_ its nu + nv weights begin
        float scale;            // (λ/d)² / cos θ, applied under the root
    };

  private:
    void average(View<const float, 2> values, bool of_roots, View<float, 2> moduli) const;

    std::size_t samples_;
    std::size_t row_length_;  // n_U
    std::vector<Lobe> lobes_;
    std::vector<float> weights_;
};

}  // namespace hogel
