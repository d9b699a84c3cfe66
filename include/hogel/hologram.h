// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
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

/// Three wavelengths (metres), which show the channels 0, 1 and 2.
HOGEL_API std::vector<Channel> rgb(double red, double green, double blue);

/// Phases of the waves that leave a hogel, where they are independent of the scene.
enum class Phases {
    random,    ///< independent for each look, hogel and direction
    fixed,     ///< independent for each look and direction, the same in all hogels
    designed,  ///< the same in all hogels, chosen so that a uniform hogel's fringe has a flat modulus
};

/// Phases that all hogels share: those of basis fringes, which are made once.
enum class SharedPhases { fixed, designed };

/// Phases of the points of a scene's surfaces.
enum class PointPhases {
    random,  ///< independent for each look and point
    fixed,   ///< all zero
};

/// Averaged over the directions that a lobe of a hogel lights.
enum class LobeAverage {
    radiance,   ///< L: the lobe carries all their light
    amplitude,  ///< √L: linear in amplitudes as basis fringes are, and darker where L varies within a lobe
};

/// One FFT a hogel, hogels side by side: [K] (4.2). Takes the sides of a hemicube too.
struct Fourier {
    Phases phases = Phases::random;
    LobeAverage average = LobeAverage::radiance;

    friend bool operator==(const Fourier&, const Fourier&) = default;
};

/// Horizontal parallax only, [K] 3.5 and (3.23): one FFT for each line of a hogel. The light field has one row of
/// directions, on its sides left and right too where it has them, and every line shows it in all directions up and down
/// that the lines' distance diffracts to.
struct Lines {
    /// Metres between lines, rounded so that a hogel holds whole lines. 0: as far apart as samples.
    double line_pitch = 0;
    Phases phases = Phases::random;
    LobeAverage average = LobeAverage::radiance;

    friend bool operator==(const Lines&, const Lines&) = default;
};

/// A sum of basis fringes a hogel, weighted with the coefficients of a transform of its amplitudes √L: [K] (3.24).
struct Basis {
    /// The name of a transform, such as "haar" or "cdf97", or "pieces" for Lucente's piecewise constant basis.
    std::string transform = "cdf97";
    /// The smallest coefficients are left out, as many as carry about this share of a hogel's amplitude.
    double tolerance = 0;
    SharedPhases phases = SharedPhases::fixed;

    friend bool operator==(const Basis&, const Basis&) = default;
};

/// One plane wave a ray, with the phase of a spherical wave from the point that the ray meets; needs depth.
struct PhaseAdded {
    /// false: each ray on the nearest frequency of the hogel's Fourier transform (phase-added stereogram, Yamaguchi et
    /// al. 1993); true: each ray on its own frequency (Kang et al. 2008).
    bool exact = false;

    friend bool operator==(const PhaseAdded&, const PhaseAdded&) = default;
};

/// A window of at least two hogels' width around each hogel, all added up: Padmanaban et al. 2019. Needs depth.
struct OverlapAdd {
    PointPhases phases = PointPhases::random;

    friend bool operator==(const OverlapAdd&, const OverlapAdd&) = default;
};

struct HologramOptions;

/// A method that a program brings along. As a row of hologram_methods() it is found by its name.
struct OwnMethod {
    std::string name;
    bool needs_depth = false;
    /// The hologram of a light field on a grid of hologram_grid(). Its read() follows the rules of FieldSource.
    std::function<std::shared_ptr<const FieldSource>(const LightField& light_field, const FieldGrid& grid,
                                                     const HologramOptions& options)>
        make;

    friend bool operator==(const OwnMethod& a, const OwnMethod& b) { return a.name == b.name; }
};

/// How a light field becomes fringes; docs/holograms.md compares the methods.
using HologramMethod = std::variant<Fourier, Lines, Basis, PhaseAdded, OverlapAdd, OwnMethod>;

/// Whether this method needs the depth of every ray.
HOGEL_API bool needs_depth(const HologramMethod& method);

/// A method by name, with its default options.
struct HologramMethodInfo {
    std::string name;
    std::string text;  ///< one line
    HologramMethod method;
    bool needs_depth = false;
};

/// fourier, lines, basis, phase-added, phase-added-exact, olas; and those that a program adds.
HOGEL_API Table<HologramMethodInfo>& hologram_methods();

struct HologramOptions {
    Channel channel;
    double pitch = 1e-6;  ///< Δ asked for, metres; rounded so that a hogel holds whole samples
    HologramMethod method;
    std::size_t looks = 1;  ///< independent sets of random phases on offer
    std::uint64_t seed = 1;
};

/// The grid of samples of the hologram of a light field with these faces: n_Δ = round(d/Δ) samples a hogel along each
/// side. Throws Error(usage)
/// - for faces that are not those of one light field (require_faces()), none included;
/// - for a pitch, wavelength or line pitch that is not positive, and a channel that the light field does not have;
/// - where a front alone has a field of view that exceeds the diffraction half-angle asin(λ/2Δ), naming a pitch that
///   would do. A hemicube has all directions; the hologram shows those that its pitch diffracts to;
/// - for more than one face, unless the method is Fourier or Lines;
/// - PhaseAdded: for fewer directions than a hogel shows, naming how many would do;
/// - PhaseAdded and OverlapAdd: for directions that are not in perspective;
/// - Lines: for more than one row of directions, and the faces top and bottom.
HOGEL_API FieldGrid hologram_grid(std::span<const LightFieldGrid> faces, const HologramOptions& options);

/// The hologram of a light field, a holographic stereogram. It is computed on demand, region by region, with the same
/// samples whatever the region, and shares the light field. Throws Error(usage) where hologram_grid() does, for depth
/// that the method needs and the light field lacks, and for basis fringes that would take more than 4 GiB.
HOGEL_API std::shared_ptr<const FieldSource> make_hologram(const LightField& light_field,
                                                           const HologramOptions& options);

/// The hologram of a light field given by coefficients, with the method Basis. Only coefficients that are not
/// zero cost anything. The values of the source are not radiances: they are, for each hogel and channel, the
/// coefficients of √L, an array [n_V][n_U] transformed by Basis::transform in Pyramid::separate with its two axes as
/// one group. Throws Error(usage) as make_hologram() does, and for other methods.
HOGEL_API std::shared_ptr<const FieldSource> make_hologram_of_coefficients(const LightField& coefficients,
                                                                           const HologramOptions& options);

}  // namespace hogel
