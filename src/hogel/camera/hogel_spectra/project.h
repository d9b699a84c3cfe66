// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/camera/hogel_spectra/spread_line.h"
#include "hogel/stereogram/in_band_rows.h"

namespace hogel::camera::hogel_spectra {

/// The factors e^{iπm(n−1)/n} e^{iπm′(n′−1)/n′} of the waves m of n columns and m′ of n′ rows. They shift the origin of
/// a hogel's phases from its first sample to its middle. The layout is that of HogelWaves::waves().
class MiddlePhases {
  public:
    MiddlePhases(std::size_t rows, std::size_t columns);
    /// Multiplies waves in place. The fast twin skips blocks of sixteen rows without any of `rows`.
    void apply_plain(float* waves) const;
    void apply(float* waves, const stereogram::InBandRows& rows = {}) const;

  private:
    std::size_t rows_, columns_;
    std::vector<float, CacheLineAllocator<float>> factors_;
};

/// Weights of a hogel for a viewpoint, the same for all looks.
struct HogelView {
    SlepianBasis::Weights columns{}, rows{};  ///< at the frequency of the viewpoint, along a row and down a column
    /// In-band rows and columns of waves. Blocks of sixteen rows without any in-band row count as zero; other
    /// out-of-band waves may still count.
    stereogram::InBandRows in_band_rows = {}, in_band_columns = {};
};

/// Bases of a hogel along its rows and down its columns, with the same nodes.
struct SlepianBases {
    const SlepianBasis& across;
    const SlepianBasis& down;
};

/// Projects a hogel's waves and adds them to a line: D_y C D_xᵀ E_xᵀ times the carrier across, with C the waves, D the
/// weights of the view, E = spread() of a basis, and a factor i for each odd function across or down. Plain and fast
/// twins agree to rounding.
/// @param waves  in the layout of HogelWaves::waves(), with phases counted from the middle
/// @param line   has the functions of the basis down; padded(nodes) numbers of each row are read and written
void project_plain(const SlepianBases& bases, const HogelView& view, const float* waves, const LineTarget& line);
extern decltype(project_plain)& project;

}  // namespace hogel::camera::hogel_spectra
