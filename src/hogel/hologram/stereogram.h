#pragma once

#include <cstdint>
#include <memory>

#include "hogel/lightfield/light_field.h"
#include "hogel/optics/field.h"

namespace hogel {

/// How a light field becomes fringes; docs/holograms.md compares them.
enum class Method {
    fourier,      ///< one FFT a hogel, hogels side by side: [K] (4.2)
    overlap_add,  ///< a window of at least two hogels' width around each hogel, all added up: Padmanaban et al. 2019
};

/// Which phases the waves of a hogel's directions have.
enum class Phases {
    random,    ///< independent for each look, hogel and direction; of points, where the method knows points
    fixed,     ///< independent for each look and direction, the same in all hogels; none, where the method knows points
    designed,  ///< the same in all hogels, chosen so that a uniform hogel's fringe has a flat modulus
    added,     ///< those of spherical waves from the points that the rays meet, each ray on the nearest frequency of
               ///< the hogel's Fourier transform: phase-added stereogram, Yamaguchi et al. 1993
    added_exactly,  ///< the same with each ray's own frequency: Kang et al. 2008
};

struct StereogramOptions {
    double wavelength = 633e-9;  ///< metres
    double pitch = 1e-6;         ///< Δ asked for, metres; rounded so that a hogel holds whole samples
    std::size_t channel = 0;     ///< channel of the light field that this wavelength shows
    std::size_t looks = 1;       ///< independent sets of random phases on offer
    std::uint64_t seed = 1;
    Method method = Method::fourier;
    Phases phases = Phases::random;
};

/// The grid of samples that a stereogram of this light field has: n_Δ = round(d/Δ) samples a hogel in each direction.
/// Throws Error(usage) when the light field's field of view exceeds the diffraction half-angle asin(λ/2Δ), naming the
/// pitch that would do; for added phases when the light field has fewer directions than a hogel shows, naming how many
/// would do; and for a method that does not have these phases.
FieldGrid stereogram_grid(const LightFieldGrid& light_field, const StereogramOptions& options);

/// Whether this needs the depth of every ray: added phases and overlapping windows do.
bool needs_depth(const StereogramOptions& options);

/// The holographic stereogram of a light field. Made on demand, region by region; the same samples whatever the region.
/// The light field must outlive the result. Throws Error(usage) where stereogram_grid does, and where depth is needed
/// that the light field does not have.
std::unique_ptr<FieldSource> make_stereogram(const LightFieldSource& light_field, const StereogramOptions& options);

}  // namespace hogel
