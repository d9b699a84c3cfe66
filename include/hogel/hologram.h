// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/light_field.h"
#include "hogel/table.h"

namespace hogel {

/// A wavelength, and the channel of the light field that it shows.
struct Channel {
    double wavelength = 633e-9;  ///< metres
    std::size_t index = 0;

    friend bool operator==(const Channel&, const Channel&) = default;
};

/// Returns one wavelength (metres) that shows channel 0.
HOGEL_API std::vector<Channel> mono(double wavelength);

/// Returns the colour channel of a picture for a wavelength (metres): 0 red, from 580 nm; 1 green, from 490 nm; 2 blue.
constexpr std::size_t channel_of(double wavelength) {
    if (wavelength >= 580e-9) return 0;
    return wavelength >= 490e-9 ? 1 : 2;
}

/// Returns three wavelengths (metres) that show channels 0, 1 and 2.
HOGEL_API std::vector<Channel> rgb(double red, double green, double blue);

/// Phases of the plane waves of a hogel, for methods with phases that do not depend on the scene.
enum class Phases {
    random,    ///< independent for each look, hogel and direction
    fixed,     ///< independent for each look and direction, the same in all hogels
    designed,  ///< the same in all hogels, chosen to give the fringe of a uniform hogel a constant modulus
};

/// Phases of basis fringes, which are computed once and shared by all hogels.
enum class SharedPhases { fixed, designed };

/// Phases of surface points.
enum class PointPhases {
    random,  ///< independent for each look and point
    fixed,   ///< all zero
};

/// Quantity averaged over a lobe, the range of directions lit by one frequency of a hogel.
enum class LobeAverage {
    radiance,   ///< L: the lobe has all light of its directions
    amplitude,  ///< √L: linear in amplitude as basis fringes are; darker where L varies within a lobe
};

/// One FFT per hogel, hogels side by side: [K] (4.2). Supports hemicubes.
struct Fourier {
    Phases phases = Phases::random;
    LobeAverage average = LobeAverage::radiance;

    friend bool operator==(const Fourier&, const Fourier&) = default;
};

/// Horizontal parallax only, with one FFT per line of a hogel: [K] 3.5 and (3.23). The light field must have one row of
/// directions in every face. Each line sends it to all vertical directions to which the line pitch diffracts.
struct Lines {
    /// Distance of lines, metres, rounded to a whole number of lines per hogel. 0: the pitch of the samples.
    double line_pitch = 0;
    Phases phases = Phases::random;
    LobeAverage average = LobeAverage::radiance;

    friend bool operator==(const Lines&, const Lines&) = default;
};

/// A sum of basis fringes per hogel, weighted with the coefficients of a transform of its amplitudes √L: [K] (3.24).
/// Supports hemicubes; each face is transformed separately.
struct Basis {
    /// Name of a transform, such as "haar" or "cdf97", or "pieces" for Lucente's piecewise constant basis.
    std::string transform = "cdf97";
    /// Fraction of a hogel's amplitude to drop: the smallest coefficients that carry about this fraction are left out.
    double tolerance = 0;
    SharedPhases phases = SharedPhases::fixed;
    /// Horizontal parallax only, with this distance of lines as in Lines::line_pitch. Empty: full parallax.
    std::optional<double> line_pitch = {};

    friend bool operator==(const Basis&, const Basis&) = default;
};

/// One plane wave per ray, with the phase of a spherical wave from the visible point of the ray. Needs depth.
struct PhaseAdded {
    /// false: the nearest frequency of the hogel's Fourier transform (phase-added stereogram, Yamaguchi et al. 1993);
    /// true: the exact frequency of the ray (Kang et al. 2008).
    bool exact = false;

    friend bool operator==(const PhaseAdded&, const PhaseAdded&) = default;
};

/// Sum of overlapping windows around hogels, at least two hogels wide (OLAS, Padmanaban et al. 2019). Needs depth.
struct OverlapAdd {
    PointPhases phases = PointPhases::random;

    friend bool operator==(const OverlapAdd&, const OverlapAdd&) = default;
};

struct HologramOptions;

/// A method that a program defines. Add it as a row of hologram_methods() to find it by name.
struct OwnMethod {
    std::string name;
    bool needs_depth = false;
    /// Makes the hologram of a light field on a grid from hologram_grid(). Its read() follows the rules of FieldSource.
    std::function<std::shared_ptr<const FieldSource>(const LightField& light_field, const FieldGrid& grid,
                                                     const HologramOptions& options)>
        make;

    friend bool operator==(const OwnMethod& a, const OwnMethod& b) { return a.name == b.name; }
};

/// Methods that turn a light field into a hologram; docs/holograms.md compares them.
using HologramMethod = std::variant<Fourier, Lines, Basis, PhaseAdded, OverlapAdd, OwnMethod>;

/// Returns the distance of lines (metres) of a method with horizontal parallax only; none for other methods.
HOGEL_API std::optional<double> line_pitch(const HologramMethod& method);

/// Returns whether a method needs the depth of every ray.
HOGEL_API bool needs_depth(const HologramMethod& method);

/// A named method with its default options.
struct HologramMethodInfo {
    std::string name;
    std::string text;  ///< one line
    HologramMethod method;
    bool needs_depth = false;
};

/// Returns all methods by name: fourier, lines, basis, basis-lines, phase-added, phase-added-exact, olas, and those
/// that the program adds.
HOGEL_API Table<HologramMethodInfo>& hologram_methods();

/// Options of a hologram of one wavelength.
struct HologramOptions {
    Channel channel;
    double pitch = 1e-6;  ///< Δ, metres; rounded to a whole number of samples per hogel
    HologramMethod method;
    std::size_t looks = 1;  ///< number of looks, independent sets of random phases
    std::uint64_t seed = 1;
};

/// Returns the grid of the hologram of a light field with these faces, with n_Δ = round(d/Δ) samples along each side of
/// a hogel. Throws Error(usage)
/// - without faces, and for faces of different light fields (require_faces());
/// - for a pitch, wavelength or line pitch that is not positive, and for a missing channel;
/// - for a single face with a field of view beyond the diffraction half-angle asin(λ/2Δ); the message names a pitch
///   that suffices. A hemicube has all directions; the hologram shows those to which its pitch diffracts;
/// - for more than one face, unless the method is Fourier, Lines or Basis;
/// - with PhaseAdded, for fewer directions than a hogel shows; the message names a number that suffices;
/// - with PhaseAdded and OverlapAdd, for directions that are not in perspective;
/// - with Lines, and Basis with lines, for more than one row of directions, and for the faces top and bottom.
HOGEL_API FieldGrid hologram_grid(std::span<const LightFieldGrid> faces, const HologramOptions& options);

/// Returns the hologram of a light field, a holographic stereogram. It is computed on demand, region by region; samples
/// do not depend on the region that is read. It shares ownership of the light field. Throws Error(usage) as
/// hologram_grid() does, for a light field without the depth that the method needs, and for basis fringes above 4 GiB.
HOGEL_API std::shared_ptr<const FieldSource> make_hologram(const LightField& light_field,
                                                           const HologramOptions& options);

/// Returns the hologram of a light field given by transform coefficients (see open_coefficients()), with the method
/// Basis. The values of the source are coefficients of √L instead of radiances: for each hogel and channel an array
/// [n_V][n_U] per face, transformed by Basis::transform along both axes. Only nonzero coefficients take time. Throws
/// Error(usage) as make_hologram() does, and for other methods.
HOGEL_API std::shared_ptr<const FieldSource> make_hologram_of_coefficients(const LightField& coefficients,
                                                                           const HologramOptions& options);

}  // namespace hogel
