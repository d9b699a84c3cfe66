// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera/hogel_spectra/pupil_band.h"
#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/camera/hogel_spectra/spread_line.h"

namespace hogel::camera::hogel_spectra {

/// How the looks of a part of a hologram lie in memory: each by itself, or in blocks of some that lie side by side.
struct LookBlocks {
    std::size_t looks = 0, together = 1;

    std::size_t blocks() const { return (looks + together - 1) / together; }
    /// Floats of a row of so many hogels, in lines and in light. Looks by themselves need columns up to which nodes
    /// fill whole vectors.
    std::size_t row(const PupilBand& eye, std::size_t hogels) const {
        const std::size_t samples = eye.samples(hogels);
        return together == 1 ? padded(samples + lanes - 1) : samples * together;
    }
};

/// The lines of an eye's band under some rows of hogels: one for those of a row that have the same weights down, nearly
/// always all of them.
class BandLines {
  public:
    /// Lines of rows of `hogels` hogels each, of which there are none yet.
    void begin(const PupilBand& eye, const LookBlocks& looks, std::size_t hogels);
    /// Gives a hogel its line. Hogels of a row come in their order.
    /// @param weights  down
    void add(std::size_t row, std::size_t column, const SlepianBasis::Weights& weights);
    /// Clears the lines, once each hogel has one.
    void clear();

    /// The place of a hogel's first node, for a look of a block, or the first of those that lie side by side.
    LineTarget place(std::size_t row, std::size_t column, std::size_t look);

    /// Adds what the lines hold to light, of a part in which row 0 of the hogels is the one `first`.
    /// @param light  [block of looks]: [row][part][column, look]
    void spread(const SlepianBasis& down, std::size_t first, std::span<Array<float, 3>> light) const;

  private:
    struct Line {
        std::size_t row;                 // of the hogels
        double frequency;                // of the weights down
        const float* carrier;            // down
        std::size_t begin = 0, end = 0;  // floats of rows that nodes of the hogels fill
        Array<float, 1> numbers;         // [block of looks][function down][part][column, look]
    };

    LookBlocks looks_;
    std::size_t hogels_ = 0, per_hogel_ = 0, nodes_ = 0;  // across
    std::size_t rows_ = 0, row_ = 0;                      // of one block: how many, and floats of each
    std::vector<Line> lines_;                             // of which some are used
    std::size_t used_ = 0;
    std::vector<std::size_t> of_hogel_;  // [row][column]
};

}  // namespace hogel::camera::hogel_spectra
