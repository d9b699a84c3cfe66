// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "hogel/field.h"
#include "hogel/optics/distributed/shared_plane.h"

namespace hogel::optics {

/// A range of spatial frequencies, cycles per metre; a plane wave in direction n has the frequency (n_x, n_y)/λ.
struct Band {
    double low_x = 0, high_x = 0, low_y = 0, high_y = 0;

    /// Returns all frequencies that samples of this grid can represent.
    static Band of(const Grid& plane);
};

/// Number of columns of a spectrum per block; all columns of a block are on the same rank.
constexpr std::size_t spectrum_block_columns = 32;

/// A monochromatic wave as a sum of plane waves: F(x) = Σ S(f) e^{2πi f·(x−c)} δf_x δf_y, with steps δf = 1/size of a
/// window with centre c that contains the wave. Light that leaves the window wraps around: the window must be wide
/// enough, or directions that leave it are dropped. The functions below propagate waves in this form ([K] 6.1).
struct Spectrum {
    Grid window;            ///< the transformed window, with centre c
    double wavelength = 0;  ///< metres
    std::ptrdiff_t first_column = 0,
                   first_row = 0;  ///< frequency of the first sample, in steps; rows are counted downwards
    /// S as [row][column], row 0 at the highest f_y. In the column layout of SharedPlane; may be distributed over the
    /// ranks of a communicator.
    distributed::SharedPlane samples;

    double frequency_x(double column) const { return (static_cast<double>(first_column) + column) / window.size_x(); }
    double frequency_y(double row) const { return -(static_cast<double>(first_row) + row) / window.size_y(); }
    std::size_t width() const { return samples.columns(); }
    std::size_t height() const { return samples.rows(); }
};

/// A wave on a plane, as a FieldSource; may be larger than memory. The pitch may be too coarse for the carrier, but not
/// for the band around it: the samples represent the frequencies nearest to the carrier.
class Wave final : public FieldSource {
  public:
    Wave(const FieldGrid& grid, const ScratchOptions& scratch);
    /// A wave that is distributed over ranks. `samples` are the local rows.
    Wave(const FieldGrid& grid, core::PagedArray samples, const distributed::LineRange& rows);
    const FieldGrid& grid() const override { return grid_; }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override;

    core::PagedArray samples;             ///< [y][x]
    distributed::LineRange rows;          ///< rows in `samples`; all rows unless the wave is distributed
    double carrier_x = 0, carrier_y = 0;  ///< cycles per metre

  private:
    FieldGrid grid_;
};

/// Returns a grid padded by at least size_x and size_y metres (both sides together) to a size that suits the
/// transforms.
Grid padded(const Grid& plane, double size_x, double size_y);

/// Returns the plane waves of a field at the frequencies in `band` that its samples represent. Reads the field row by
/// row. Memory: an array with the larger number of rows of field and band, and the columns of the band. Throws
/// Error(usage) for a window that is smaller than the field or has another pitch, and for a band without frequencies.
/// @param window        the field's grid with an even number of samples added along each axis; see padded()
/// @param communicator  ranks that share the work; all ranks call it and get their columns of the spectrum. Null: none
Spectrum spectrum_of(const FieldSource& field, std::size_t look, const Grid& window, const Band& band,
                     const ScratchOptions& scratch = {}, const Progress& progress = {},
                     Communicator* communicator = nullptr);

Spectrum spectrum_of(const Wave& wave, const Grid& window, const Band& band, const ScratchOptions& scratch = {},
                     const Progress& progress = {}, Communicator* communicator = nullptr);

/// Returns the grid of the window with width × height samples.
Grid grid_of(const Spectrum& spectrum, std::size_t width, std::size_t height);

/// Returns the wave in the window, with width × height samples: the same extent at another pitch. Its carrier is the
/// centre of the spectrum. Throws Error(usage) if a side has fewer samples than the spectrum.
/// @param communicator  as for spectrum_of(); every rank has its columns of the spectrum
Wave wave_of(const Spectrum& spectrum, std::size_t width, std::size_t height, const ScratchOptions& scratch = {},
             Communicator* communicator = nullptr);
/// As wave_of(), for a spectrum with columns distributed over the ranks. Returns on each rank the rows wanted(rank) of
/// the wave. Frees the spectrum during the transform.
/// @param wanted  returns the rows of the wave that a rank is to get
Wave wave_of(Spectrum spectrum, std::size_t width, std::size_t height, const ScratchOptions& scratch,
             Communicator& communicator, const std::function<distributed::LineRange(std::size_t rank)>& wanted);

/// Gathers a distributed spectrum on the root. Other ranks get a spectrum without samples.
Spectrum gathered(Spectrum spectrum, Communicator& communicator, const ScratchOptions& scratch);

/// Propagation to a parallel plane; the window follows the off-axis carrier. All in metres.
struct PropagationOptions {
    double distance = 0;              ///< along +z; negative: backwards
    double shift_x = 0, shift_y = 0;  ///< sideways shift of the window's centre
    /// Directions with a sideways path beyond shift ± reach are dropped. 0: half the window, the limit of phase
    /// sampling.
    double reach_x = 0, reach_y = 0;
    /// Distance over which directions beyond the reach fade out.
    double fade_x = 0, fade_y = 0;
};

/// Propagates by the angular spectrum method, [K] 6.1.1: S e^{2πi f_z z}, f_z = √(1/λ² − f²). Evanescent waves are
/// dropped. Light that leaves a window of size W wraps around, outside the original wave of width D if the reach is at
/// most W − D.
void propagate(Spectrum& spectrum, const PropagationOptions& options);

/// Returns the frequencies of light from one rectangle to another on a parallel plane at this distance: [K] 6.1.3.
Band band_between(const Rectangle& from, const Rectangle& to, double distance, double wavelength);

}  // namespace hogel::optics
