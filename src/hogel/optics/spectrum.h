// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/core/paged_array.h"
#include "hogel/field.h"

namespace hogel::optics {

/// A range of spatial frequencies, cycles per metre; a plane wave in direction n has the frequency (n_x, n_y)/λ.
struct Band {
    double low_x = 0, high_x = 0, low_y = 0, high_y = 0;

    /// All that samples of this grid can carry.
    static Band of(const Grid& plane);
};

/// A monochromatic wave as the sum of its plane waves: F(x) = Σ S(f) e^{2πi f·(x−c)} δf_x δf_y, f at steps
/// δf = 1/size of a window around c that holds the wave. Light that leaves the window at one side wraps around to the
/// other, so a window is chosen wide enough, or the directions that would leave it are dropped. In this form waves are
/// propagated from plane to plane ([K] 6.1); each step is a function below.
struct Spectrum {
    Grid window;            ///< what was transformed: its count times its pitch is the window's size, its centre is c
    double wavelength = 0;  ///< metres
    std::ptrdiff_t first_column = 0, first_row = 0;  ///< frequencies of the first sample, in steps; rows run down
    core::PagedArray samples;                        ///< [row][column] of S, row 0 the highest f_y

    double frequency_x(double column) const { return (static_cast<double>(first_column) + column) / window.size_x(); }
    double frequency_y(double row) const { return -(static_cast<double>(first_row) + row) / window.size_y(); }
    std::size_t width() const { return samples.extent(1); }
    std::size_t height() const { return samples.extent(0); }
};

/// A wave on a plane that may not fit into memory; a source like any other. Its samples may be too far apart for its
/// carrier, but not for the band around it: they represent the frequencies that are nearest to the carrier.
class Wave final : public FieldSource {
  public:
    Wave(const FieldGrid& grid, const ScratchOptions& scratch);
    const FieldGrid& grid() const override { return grid_; }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override;

    core::PagedArray samples;             ///< [y][x]
    double carrier_x = 0, carrier_y = 0;  ///< cycles per metre

  private:
    FieldGrid grid_;
};

/// The samples of `plane` with at least so many metres of zeros around them altogether, at a good size for transforms.
Grid padded(const Grid& plane, double size_x, double size_y);

/// The plane waves of a field, of those frequencies in `band` that its samples carry. The field is read row by row;
/// memory: an array of the field's rows and the band's columns, and the result.
/// @param window  a grid of the field's pitch and centre, at least as large; see padded()
/// Throws Error(usage) for a window that is smaller than the field or has another pitch, or a band with nothing in it.
Spectrum spectrum_of(const FieldSource& field, std::size_t look, const Grid& window, const Band& band,
                     const ScratchOptions& scratch = {}, const Progress& progress = {});

Spectrum spectrum_of(const Wave& wave, const Grid& window, const Band& band, const ScratchOptions& scratch = {},
                     const Progress& progress = {});

/// The wave in the window at so many samples, at least the spectrum's own counts: the same extent at another pitch. Its
/// carrier is the middle of the spectrum. Throws Error(usage) for fewer.
Wave wave_of(const Spectrum& spectrum, std::size_t width, std::size_t height, const ScratchOptions& scratch = {});

/// Propagation to a parallel plane; the window follows the off-axis carrier. All in metres.
struct PropagationOptions {
    double distance = 0;              ///< along +z; negative: back
    double shift_x = 0, shift_y = 0;  ///< by which the window's centre moves sideways
    /// Directions that travel sideways by more than the window's shift ± reach are dropped; 0: half the window, beyond
    /// which the phase is too steep for the steps.
    double reach_x = 0, reach_y = 0;
    /// Beyond the reach directions fade out over this distance, instead of ending there at once.
    double fade_x = 0, fade_y = 0;
};

/// The angular spectrum, [K] 6.1.1: S e^{2πi f_z z}, f_z = √(1/λ² − f²). Evanescent waves are dropped. Light that
/// leaves a window of size W wraps around; where a wave D wide was, none arrives if the reach is at most W − D.
void propagate(Spectrum& spectrum, const PropagationOptions& options);

/// The frequencies that light from one rectangle to another on a plane at this distance can have: [K] 6.1.3.
Band band_between(const Rectangle& from, const Rectangle& to, double distance, double wavelength);

}  // namespace hogel::optics
