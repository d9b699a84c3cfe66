// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "hogel/field.h"
#include "hogel/optics/distributed/shared_plane.h"

namespace hogel::optics {

/// A range of spatial frequencies, cycles per metre; a plane wave in direction n has the frequency (n_x, n_y)/λ.
struct Band {
    double low_x = 0, high_x = 0, low_y = 0, high_y = 0;

    /// All frequencies that samples of this grid can represent.
    static Band of(const Grid& plane);
};

/// The columns of a spectrum that one process of a team has together.
constexpr std::size_t columns_of_waves_together = 32;

/// A monochromatic wave as the sum of its plane waves: F(x) = Σ S(f) e^{2πi f·(x−c)} δf_x δf_y, with f at steps δf =
/// 1/size of a window around c that contains the wave. Light that leaves the window at one side wraps around to the
/// other, so the window must be wide enough, or directions that would leave it are dropped. The functions below
/// propagate waves in this form from plane to plane ([K] 6.1).
struct Spectrum {
    Grid window;            ///< the transformed window, of centre c
    double wavelength = 0;  ///< metres
    std::ptrdiff_t first_column = 0,
                   first_row = 0;  ///< frequency of the first sample, in steps; rows are counted downwards
    /// [row][column] of S, row 0 the highest f_y, in columns. The processes of a team may share it.
    distributed::SharedPlane samples;

    double frequency_x(double column) const { return (static_cast<double>(first_column) + column) / window.size_x(); }
    double frequency_y(double row) const { return -(static_cast<double>(first_row) + row) / window.size_y(); }
    std::size_t width() const { return samples.columns(); }
    std::size_t height() const { return samples.rows(); }
};

/// A wave on a plane, as a source; it may be larger than memory. The pitch may be too coarse for the carrier but not
/// for the band around it: the samples represent the frequencies nearest to the carrier.
class Wave final : public FieldSource {
  public:
    Wave(const FieldGrid& grid, const ScratchOptions& scratch);
    /// A wave that the processes of a team share: the samples are those rows that this one has.
    Wave(const FieldGrid& grid, core::PagedArray samples, const distributed::LineRange& rows);
    const FieldGrid& grid() const override { return grid_; }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override;

    core::PagedArray samples;             ///< [y][x]
    distributed::LineRange rows;          ///< those in `samples`: all, unless the processes of a team share the wave
    double carrier_x = 0, carrier_y = 0;  ///< cycles per metre

  private:
    FieldGrid grid_;
};

/// The grid `plane` padded by at least size_x and size_y metres in all (both sides together) to a good size for
/// transforms.
Grid padded(const Grid& plane, double size_x, double size_y);

/// The plane waves of a field at the frequencies in `band` that its samples represent. The field is read row by row.
/// Memory: an array of the field's or the band's rows, whichever are more, and the band's columns.
/// @param team    whose processes share the work, all of which call it, and have the spectrum's columns in parts; null:
/// none
/// @param window  a grid of the field's pitch and centre, at least as large; see padded()
/// Throws Error(usage) for a window that is smaller than the field or has another pitch, and for a band without
/// frequencies.
Spectrum spectrum_of(const FieldSource& field, std::size_t look, const Grid& window, const Band& band,
                     const ScratchOptions& scratch = {}, const Progress& progress = {},
                     Communicator* communicator = nullptr);

Spectrum spectrum_of(const Wave& wave, const Grid& window, const Band& band, const ScratchOptions& scratch = {},
                     const Progress& progress = {}, Communicator* communicator = nullptr);

/// The samples of the wave of a spectrum: its window, sampled by width × height samples.
Grid grid_of(const Spectrum& spectrum, std::size_t width, std::size_t height);

/// The wave in the window, sampled by width × height samples: the same extent at another pitch. Its carrier is the
/// middle of the spectrum. Throws Error(usage) for fewer samples than the spectrum has.
/// @param team  as for spectrum_of(), of which all have parts of the spectrum
Wave wave_of(const Spectrum& spectrum, std::size_t width, std::size_t height, const ScratchOptions& scratch = {},
             Communicator* communicator = nullptr);
/// The same of a spectrum that the processes of a team share, which is freed on the way: each has the rows that it
/// wants.
/// @param wanted  the rows that a process wants, for any of them
Wave wave_of(Spectrum spectrum, std::size_t width, std::size_t height, const ScratchOptions& scratch,
             Communicator& communicator, const std::function<distributed::LineRange(std::size_t process)>& wanted);

/// The whole of what the processes of a team have in parts, in the first one; in others something without samples.
Spectrum gathered(Spectrum spectrum, Communicator& communicator, const ScratchOptions& scratch);

/// Propagation to a parallel plane; the window follows the off-axis carrier. All in metres.
struct PropagationOptions {
    double distance = 0;              ///< along +z; negative: backwards
    double shift_x = 0, shift_y = 0;  ///< sideways shift of the window's centre
    /// Directions that travel sideways by more than shift ± reach are dropped. 0: half the window, beyond which the
    /// phase is too steep for the frequency steps.
    double reach_x = 0, reach_y = 0;
    /// Beyond the reach directions fade out over this distance.
    double fade_x = 0, fade_y = 0;
};

/// The angular spectrum, [K] 6.1.1: S e^{2πi f_z z}, f_z = √(1/λ² − f²). Evanescent waves are dropped. Light that
/// leaves a window of size W wraps around; none of it reaches the area of the original wave, of width D, if the reach
/// is at most W − D.
void propagate(Spectrum& spectrum, const PropagationOptions& options);

/// The frequencies of light from one rectangle to another on a parallel plane at this distance: [K] 6.1.3.
Band band_between(const Rectangle& from, const Rectangle& to, double distance, double wavelength);

}  // namespace hogel::optics
