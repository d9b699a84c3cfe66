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

/// Memory layout of the looks of a chunk: each separately, or interleaved in blocks of several looks.
struct LookBlocks {
    std::size_t looks = 0, looks_per_block = 1;

    std::size_t blocks() const { return (looks + looks_per_block - 1) / looks_per_block; }
    /// Returns the number of floats in a row of numbers for a row of hogels, in lines and in light. For single looks it
    /// is padded to whole vectors of nodes.
    std::size_t row_size(const PupilBand& band, std::size_t hogels) const {
        const std::size_t samples = band.samples(hogels);
        return looks_per_block == 1 ? padded(samples + lanes - 1) : samples * looks_per_block;
    }
};

/// Intermediate lines of a pupil band for several rows of hogels. Hogels of a row with the same vertical weights share
/// a line; nearly always one line serves the whole row.
class BandLines {
  public:
    /// Begins without lines, for rows of `hogels` hogels each.
    void reset(const PupilBand& band, const LookBlocks& looks, std::size_t hogels);
    /// Assigns a hogel to its line. Hogels of a row must come in order.
    /// @param weights  vertical weights of the hogel, of the basis along its columns
    void add(std::size_t row, std::size_t column, const SlepianBasis::Weights& weights);
    /// Sets all lines to zero. Call it after the last add().
    void clear();

    /// Returns the address of a hogel's first node, for a single look or for the first of a block of interleaved looks.
    LineTarget target(std::size_t row, std::size_t column, std::size_t look);

    /// Adds the lines to the light of a chunk.
    /// @param first  row of hogels of the chunk that is row 0 here
    /// @param light  [block of looks]: [row][part][column, look]
    void spread(const SlepianBasis& down, std::size_t first, std::span<Array<float, 3>> light) const;

  private:
    struct Line {
        std::size_t row;                 // row of hogels
        double frequency;                // of the weights down
        const float* carrier;            // down
        std::size_t begin = 0, end = 0;  // range of a row's floats that the hogels' nodes occupy
        Array<float, 1> numbers;         // [block of looks][function down][part][column, look]
    };

    LookBlocks looks_;
    std::size_t hogels_ = 0, per_hogel_ = 0, nodes_ = 0;  // across
    std::size_t row_count_ = 0, row_size_ = 0;            // of one block: number of rows, and floats per row
    std::vector<Line> lines_;                             // the first line_count_ are in use
    std::size_t line_count_ = 0;
    std::vector<std::size_t> line_of_hogel_;  // [row][column]
};

}  // namespace hogel::camera::hogel_spectra
