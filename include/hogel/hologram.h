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

/// A wavelength and the channel of the light field that it shows.
struct Channel {
    double wavelength = 633e-9;  ///< metres
    std::size_t index = 0;

    friend bool operator==(const Channel&, const Channel&) = default;
};

/// One wavelength (metres), which shows channel 0.
HOGEL_API std::vector<Channel> mono(double wavelength);

/// The channel of a picture in which light of a wavelength is shown: 0 red, from 580 nm; 1 green, from 490 nm; 2 blue.
constexpr std::size_t channel_of(double wavelength) {
    if (wavelength >= 580e-9) return 0;
    return wavelength >= 490e-9 ? 1 : 2;
}

/// Three wavelengths (metres), which show the channels 0, 1 and 2.
HOGEL_API std::vector<Channel> rgb(double red, double green, double blue);

/// Phases of the plane waves of a hogel, for methods that choose them independently of the scene.
enum class Phases {
    random,    ///< independent for each look, hogel and direction
    fixed,     ///< independent for each look and direction, the same in all hogels
    designed,  ///< the same in all hogels, chosen so that the fringe of a uniform hogel has a constant modulus
};

/// Phases of basis fringes, which are computed once and shared by all hogels.
enum class SharedPhases { fixed, designed };

/// Phases of the points of surfaces.
enum class PointPhases {
    random,  ///< independent for each look and point
    fixed,   ///< all zero
};

/// The quantity that is averaged over the directions of a lobe, the range of directions that one frequency of a hogel
/// lights.
enum class LobeAverage {
    radiance,   ///< L: the lobe carries all light of its directions
    amplitude,  ///< √L: linear in amplitudes as basis fringes are, and darker where L varies within a lobe
};

/// One FFT per hogel, hogels side by side: [K] (4.2). Works for hemicubes too.
struct Fourier {
    Phases phases = Phases::random;
    LobeAverage average = LobeAverage::radiance;

    friend bool operator==(const Fourier&, const Fourier&) = default;
};

/// Horizontal parallax only, [K] 3.5 and (3.23): one FFT per line of a hogel. The light field must have one row of
/// directions (in every face of a hemisquare). Each line sends it to all vertical directions to which the line pitch
/// diffracts.
struct Lines {
    /// Metres between lines, rounded so that a hogel has a whole number of lines. 0: the pitch of the samples.
    double line_pitch = 0;
    Phases phases = Phases::random;
    LobeAverage average = LobeAverage::radiance;

    friend bool operator==(const Lines&, const Lines&) = default;
};

/// A sum of basis fringes per hogel, weighted with the coefficients of a transform of its amplitudes √L: [K] (3.24).
/// Works for hemicubes too, each of whose faces is transformed by itself.
struct Basis {
    /// The name of a transform, such as "haar" or "cdf97", or "pieces" for Lucente's piecewise constant basis.
    std::string transform = "cdf97";
    /// The smallest coefficients, which together carry about this share of a hogel's amplitude, are left out.
    double tolerance = 0;
    SharedPhases phases = SharedPhases::fixed;
    /// Horizontal parallax only, as by Lines, which says what the distance of lines means; none: both parallaxes.
    std::optional<double> line_pitch = {};

    friend bool operator==(const Basis&, const Basis&) = default;
};

/// One plane wave per ray, with the phase of a spherical wave from the point that the ray meets. Needs depth.
struct PhaseAdded {
    /// false: each ray has the nearest frequency of the hogel's Fourier transform (phase-added stereogram, Yamaguchi et
    /// al. 1993); true: each ray has its exact frequency (Kang et al. 2008).
    bool exact = false;

    friend bool operator==(const PhaseAdded&, const PhaseAdded&) = default;
};

/// The sum of overlapping windows, one around each hogel and at least two hogels wide: Padmanaban et al. 2019 (OLAS).
/// Needs depth.
struct OverlapAdd {
    PointPhases phases = PointPhases::random;

    friend bool operator==(const OverlapAdd&, const OverlapAdd&) = default;
};

struct HologramOptions;

/// A method that a program defines. Added as a row of hologram_methods(), it is found by name.
struct OwnMethod {
    std::string name;
    bool needs_depth = false;
    /// The hologram of a light field on a grid of hologram_grid(). Its read() follows the rules of FieldSource.
    std::function<std::shared_ptr<const FieldSource>(const LightField& light_field, const FieldGrid& grid,
                                                     const HologramOptions& options)>
        make;

    friend bool operator==(const OwnMethod& a, const OwnMethod& b) { return a.name == b.name; }
};

/// The method that turns a light field into fringes; docs/holograms.md compares them.
using HologramMethod = std::variant<Fourier, Lines, Basis, PhaseAdded, OverlapAdd, OwnMethod>;

/// The distance of lines, as Lines::line_pitch, of a method with horizontal parallax only; none for any other.
HOGEL_API std::optional<double> line_pitch(const HologramMethod& method);

/// Whether a method needs the depth of every ray.
HOGEL_API bool needs_depth(const HologramMethod& method);

/// A method by name, with its default options.
struct HologramMethodInfo {
    std::string name;
    std::string text;  ///< one line
    HologramMethod method;
    bool needs_depth = false;
};

/// All methods by name: fourier, lines, basis, basis-lines, phase-added, phase-added-exact, olas, and those that a
/// program adds.
HOGEL_API Table<HologramMethodInfo>& hologram_methods();

/// Options of a hologram of one wavelength.
struct HologramOptions {
    Channel channel;
    double pitch = 1e-6;  ///< Δ, metres; rounded so that a hogel has a whole number of samples
    HologramMethod method;
    std::size_t looks = 1;  ///< number of looks, independent sets of random phases
    std::uint64_t seed = 1;
};

/// The grid of the hologram of a light field with these faces: n_Δ = round(d/Δ) samples along each side of a hogel.
/// Throws Error(usage)
/// - for no faces, and for faces that are not those of one light field (require_faces());
/// - for a pitch, wavelength or line pitch that is not positive, and a channel that the light field does not have;
/// - for a front alone whose field of view exceeds the diffraction half-angle asin(λ/2Δ), naming a pitch that suffices.
///   A hemicube has all directions, and the hologram shows those to which its pitch diffracts;
/// - for more than one face, unless the method is Fourier, Lines or Basis;
/// - PhaseAdded: for fewer directions than a hogel shows, naming how many suffice;
/// - PhaseAdded and OverlapAdd: for directions that are not in perspective;
/// - Lines, and Basis with lines: for more than one row of directions, and the faces top and bottom.
HOGEL_API FieldGrid hologram_grid(std::span<const LightFieldGrid> faces, const HologramOptions& options);

/// The hologram of a light field, a holographic stereogram. It is computed on demand, region by region; samples do not
/// depend on the region that is read. It shares ownership of the light field. Throws Error(usage) where hologram_grid()
/// does, for a light field without the depth that the method needs, and for basis fringes of more than 4 GiB.
HOGEL_API std::shared_ptr<const FieldSource> make_hologram(const LightField& light_field,
                                                           const HologramOptions& options);

/// The hologram of a light field given by coefficients (see open_coefficients()), with the method Basis. Only
/// coefficients that are not zero take time. The values of the source are not radiances but, for each hogel and
/// channel, the coefficients of √L: for each face an array [n_V][n_U], transformed by Basis::transform over both axes
/// together.
/// Throws Error(usage) as make_hologram() does, and for other methods.
HOGEL_API std::shared_ptr<const FieldSource> make_hologram_of_coefficients(const LightField& coefficients,
                                                                           const HologramOptions& options);

}  // namespace hogel
