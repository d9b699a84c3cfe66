// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hogel/field.h"
#include "hogel/light_field.h"

namespace hogel {

/// How a light field becomes fringes; docs/holograms.md compares them.
enum class Method {
    fourier,      ///< one FFT a hogel, hogels side by side: [K] (4.2)
    basis,        ///< a sum of basis fringes a hogel, weighted with the coefficients of a transform: [K] (3.24)
    overlap_add,  ///< a window of at least two hogels' width around each hogel, all added up: Padmanaban et al. 2019
};

/// Which phases the waves of a hogel's directions have.
enum class Phases {
    random,    ///< independent for each look, hogel and direction; of points, where the method knows points
    fixed,     ///< independent for each look and direction, the same in all hogels; none, where the method knows points
    designed,  ///< the same in all hogels, chosen so that a uniform hogel's fringe has a flat modulus
    phase_added,  ///< those of spherical waves from the points that the rays meet, each ray on the nearest frequency of
                  ///< the hogel's Fourier transform: phase-added stereogram, Yamaguchi et al. 1993
    phase_added_exact,  ///< the same with each ray's own frequency: Kang et al. 2008
};

/// What is averaged over the directions that a lobe of a hogel lights.
enum class LobeAverage {
    radiance,   ///< L: the lobe carries all their light
    amplitude,  ///< √L: linear in amplitudes as basis fringes are, and darker where L varies within a lobe
};

struct HologramOptions {
    double wavelength = 633e-9;  ///< metres
    double pitch = 1e-6;         ///< Δ asked for, metres; rounded so that a hogel holds whole samples
    std::size_t channel = 0;     ///< channel of the light field that this wavelength shows
    std::size_t looks = 1;       ///< independent sets of random phases on offer
    std::uint64_t seed = 1;
    Method method = Method::fourier;
    Phases phases = Phases::random;
    LobeAverage average = LobeAverage::radiance;  ///< method fourier; basis averages amplitudes
    /// Method basis: a name that hogel::transform() knows, or "pieces", Lucente's piecewise constant basis.
    std::string transform = "cdf97";
    /// Method basis: the smallest coefficients are left out, as many as carry about this share of a hogel's amplitude.
    double tolerance = 0;
    /// Method fourier without added phases: the hologram has horizontal parallax only, [K] 3.5 and (3.23). It consists
    /// of lines this far apart, metres, rounded so that a hogel holds whole lines; 0: it has both parallaxes. The light
    /// field then has one row of directions, on its sides left and right too where it has them, and every line shows it
    /// in all directions up and down that the lines' distance diffracts to.
    double line_pitch = 0;
};

/// The grid of samples that a stereogram of this light field has: n_Δ = round(d/Δ) samples a hogel in each direction.
/// Throws Error(usage) when the light field's field of view exceeds the diffraction half-angle asin(λ/2Δ), naming the
/// pitch that would do; for added phases when the light field has fewer directions than a hogel shows, naming how many
/// would do; and for a method that does not have these phases (basis: only those that all hogels share).
FieldGrid hologram_grid(const LightFieldGrid& light_field, const HologramOptions& options);

/// The same of the faces of a hemicube, the front first, which method fourier knows what to do with unless it adds
/// phases. Such a light field has all directions; the hologram shows those that its pitch diffracts to, and no other.
/// Throws Error(usage) for other methods, and where hogels or channels differ.
FieldGrid hologram_grid(std::span<const LightFieldGrid> faces, const HologramOptions& options);

/// Whether this needs the depth of every ray: added phases and overlapping windows do.
bool needs_depth(const HologramOptions& options);

/// The holographic stereogram of a light field. Made on demand, region by region; the same samples whatever the region.
/// The light field must outlive the result. Throws Error(usage) where hologram_grid does, and where depth is needed
/// that the light field does not have.
std::unique_ptr<FieldSource> make_hologram(const LightFieldSource& light_field, const HologramOptions& options);

/// The same of all faces of a hemicube, or of a front alone.
std::unique_ptr<FieldSource> make_hologram(std::span<const LightFieldSource* const> faces,
                                           const HologramOptions& options);

/// The stereogram of a light field that is known by coefficients, by method basis. Only those that are not zero cost
/// anything. The values of the source are not radiances but for each hogel and channel the coefficients of √L, an array
/// [n_V][n_U] transformed by options.transform in Pyramid::separate with its two axes as one group.
std::unique_ptr<FieldSource> make_hologram_of_coefficients(const LightFieldSource& coefficients,
                                                           const HologramOptions& options);

}  // namespace hogel
