// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/hologram/eye/hogel_basis.h"
#include "hogel/hologram/near_rows.h"

namespace hogel::hologram::eye {

/// Numbers that are processed together: rows of waves, and nodes of a band.
inline constexpr std::size_t lanes = 16;
constexpr std::size_t padded(std::size_t count) { return (count + lanes - 1) / lanes * lanes; }

/// The factors e^{iπm(n−1)/n} e^{iπm′(n′−1)/n′}, of the waves m of n columns and m′ of n′ rows, with which the phases
/// of a hogel's waves are counted from its middle rather than from its first sample, in the layout of
/// HogelWaves::waves(). All eyes share the product.
class MiddlePhases {
  public:
    MiddlePhases(std::size_t rows, std::size_t columns);
    /// Multiplies waves, the fast one only blocks of sixteen rows that have some of `rows`. Plain and fast twins agree
    /// to rounding.
    void apply_plain(float* waves) const;
    void apply(float* waves, const NearRows& rows = {}) const;

  private:
    std::size_t rows_, columns_;
    std::vector<float, CacheLineAllocator<float>> factors_;
};

/// Floats of a row of phases as HogelView has them, of `nodes` nodes.
constexpr std::size_t phase_row(std::size_t nodes) { return padded(2 * nodes); }

/// What is the same for all looks of a hogel seen by an eye.
struct HogelView {
    HogelBasis::Weights columns{}, rows{};  ///< of the direction of the eye, along a row and down a column
    /// What is left of the demodulation, c + is, by which nodes are multiplied: [node down][2][phase_row(nodes)], for
    /// each node across c twice, and then −s and s.
    View<const float, 3> phases;
    /// Rows and columns of waves near the eye's direction. Blocks of sixteen rows without any of these are dark to the
    /// eye; other waves may be.
    NearRows near = {}, near_columns = {};
};

/// A place in a band, whose rows are `row` complex numbers apart.
struct BandPlace {
    std::complex<float>* first;
    std::size_t row;
};

/// The bases of a hogel along its rows and down its columns, with the same nodes.
struct HogelBases {
    const HogelBasis& across;
    const HogelBasis& down;
};

/// Adds to a band what a hogel's waves send to an eye: E_y D_y C D_xᵀ E_xᵀ, times the phases of the view, with C the
/// waves, D the weights of the view and E = spread() of a basis with a factor i for odd functions.
/// Plain and fast twins agree to rounding.
/// @param waves  in the layout of HogelWaves::waves(), with phases counted from the middle
void project_plain(const HogelBases& bases, const HogelView& view, const float* waves, const BandPlace& band);
void project(const HogelBases& bases, const HogelView& view, const float* waves, const BandPlace& band);

}  // namespace hogel::hologram::eye
