// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <complex>
#include <memory>
#include <span>

#include "hogel/hologram.h"

namespace hogel::hologram {

/// A hogel and one of the sets of random phases.
struct HogelPlace {
    std::size_t s = 0, t = 0;  ///< column and row of the hogel
    std::size_t look = 0;
};

/// Computes the square of n×n samples of a hogel from its rays, in two steps: one that all looks share, and the rest.
/// Each synthesis defines whether phases are counted from the hogel's centre or from its first sample.
class HogelSynthesis {
  public:
    virtual ~HogelSynthesis() = default;
    /// How many values a hogel prepare() makes.
    virtual std::size_t prepared_size() const = 0;
    /// The step that all looks share, for some hogels at once.
    /// @param radiances  [hogel][n_V n_U] of this wavelength
    /// @param depths     [hogel][n_V n_U], or empty where the method needs no depth
    /// @param prepared   [hogel][prepared_size()]
    virtual void prepare(View<const float, 2> radiances, View<const float, 2> depths,
                         View<float, 2> prepared) const = 0;
    virtual void synthesise(std::span<const float> prepared, const HogelPlace& place,
                            View<std::complex<float>, 2> hogel) const = 0;
    /// synthesise() to other rows, row y at to + y·to_row, with `room` of the hogel's shape as a buffer.
    virtual void synthesise_to(std::span<const float> prepared, const HogelPlace& place,
                               View<std::complex<float>, 2> room, std::complex<float>* to, std::size_t to_row) const {
        synthesise(prepared, place, room);
        for (std::size_t y = 0; y < room.extent(0); ++y) std::copy_n(&room(y, 0), room.extent(1), to + y * to_row);
    }
};

/// Amplitudes on the frequency grid j/d with random, fixed or designed phases, and one FFT: [K] (4.2). The rays of a
/// hogel are those of all faces, one face after the other.
std::unique_ptr<HogelSynthesis> make_fourier_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                       const HologramOptions& options, const Fourier& method);

/// Horizontal parallax only: each of a hogel's lines by one FFT along it, independently, [K] (3.23).
std::unique_ptr<HogelSynthesis> make_line_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                    std::size_t lines, const HologramOptions& options,
                                                    const Lines& method);

/// The values of a light field's rays that a synthesis gets.
enum class RayValues {
    radiance,
    coefficients,  ///< of a transform of each hogel's directions' √L
};

/// A sum of basis fringes weighted with coefficients: [K] (3.24).
/// Throws Error(usage) for a transform that does not exist, and where the fringes would not fit into memory.
std::unique_ptr<HogelSynthesis> make_basis_synthesis(const LightFieldGrid& light_field, std::size_t samples,
                                                     const HologramOptions& options, const Basis& method,
                                                     RayValues values);

/// One plane wave a ray, with the phase of a spherical wave from the point that the ray meets.
std::unique_ptr<HogelSynthesis> make_phase_added_synthesis(const LightFieldGrid& light_field, std::size_t samples,
                                                           const HologramOptions& options, bool exact);

}  // namespace hogel::hologram
