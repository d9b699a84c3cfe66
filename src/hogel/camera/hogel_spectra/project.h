// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/camera/hogel_spectra/spread_line.h"
#include "hogel/stereogram/in_band_rows.h"

namespace hogel::camera::hogel_spectra {

/// The factors e^{iπm(n−1)/n} e^{iπm′(n′−1)/n′}, of the waves m of n columns and m′ of n′ rows, with which the phases
/// of a hogel's waves are counted from its middle rather than from its first sample, in the layout of
/// HogelWaves::waves(). All eyes share the product.
class MiddlePhases {
  public:
    MiddlePhases(std::size_t rows, std::size_t columns);
    /// Multiplies waves, the fast one only blocks of sixteen rows that have some of `rows`. Plain and fast twins agree
    /// to rounding.
    void apply_plain(float* waves) const;
    void apply(float* waves, const stereogram::InBandRows& rows = {}) const;

  private:
    std::size_t rows_, columns_;
    std::vector<float, CacheLineAllocator<float>> factors_;
};

/// What is the same for all looks of a hogel seen by an eye.
struct HogelView {
    SlepianBasis::Weights columns{}, rows{};  ///< of the direction of the eye, along a row and down a column
    /// Rows and columns of waves near the eye's direction. Blocks of sixteen rows without any of these are dark to the
    /// eye; other waves may be.
    stereogram::InBandRows near = {}, in_band_columns = {};
};

/// The bases of a hogel along its rows and down its columns, with the same nodes.
struct SlepianBases {
    const SlepianBasis& across;
    const SlepianBasis& down;
};

/// Adds to a line what a hogel's waves send to an eye: D_y C D_xᵀ E_xᵀ, times the carrier across, with C the waves, D
/// the weights of the view and E = spread() of a basis, and a factor i for each odd function across or down.
/// Plain and fast twins agree to rounding.
/// @param waves  in the layout of HogelWaves::waves(), with phases counted from the middle
/// @param line   of as many functions as the basis down has; padded(nodes) numbers of each row are read and written
void project_plain(const SlepianBases& bases, const HogelView& view, const float* waves, const LineTarget& line);
extern decltype(project_plain)& project;

}  // namespace hogel::camera::hogel_spectra
