// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "hogel/core/thread_buffer.h"
#include "hogel/stereogram/fast_tiles.h"
#include "hogel/stereogram/hogel_tiles.h"
#include "hogel/stereogram/lobes.h"

namespace hogel::stereogram {

bool FastTiles::can(std::size_t side) { return side >= rows_at_once && math::ColumnFft::can(side, side); }

FastTiles::FastTiles(std::size_t side, const DirectionPhases& phases) : side_(side), fft_(side) {
    for (const Array<std::complex<float>, 2>& look : phases) {
        Array<float, 1>& look_phases = phases_.emplace_back(Shape<1>{2 * side * side});
        for (std::size_t row = 0; row < side; ++row)
            for (std::size_t column = 0; column < side; ++column) {
                float* to =
                    look_phases.data() + (row / rows_at_once * side + column) * square_column + row % rows_at_once;
                to[0] = look(row, column).real();
                to[rows_at_once] = look(row, column).imag();
            }
    }
}

void FastTiles::prepare(const FrequencyGrid& frequencies, View<const float, 2> values, bool of_roots,
                        View<float, 2> moduli) const {
    auto rows = row_buffers_.take();
    const std::size_t row_size = side_ * hogels_at_once, blocks = side_ / rows_at_once;
    if (rows->size() == 0) *rows = Array<float, 1>({rows_at_once * row_size});
    for (std::size_t first = 0; first < values.extent(0); first += hogels_at_once) {
        const std::size_t hogels = std::min(hogels_at_once, values.extent(0) - first);
        // Rows of a block arrive consecutively. A block of sixteen rows is transposed when the next one begins.
        std::size_t current = blocks;
        std::vector<bool> active(side_), done(blocks);
        const auto store_block = [&] {
            if (current == blocks) return;
            for (std::size_t row = 0; row < rows_at_once; ++row)
                if (!active[current * rows_at_once + row]) std::fill_n(rows->data() + row * row_size, row_size, 0.0f);
            transpose_hogels(rows->data(), side_, hogels, &moduli(first, current * row_size), side_ * side_);
            done[current] = true;
        };
        const auto row_destination = [&](std::size_t row) {
            if (row / rows_at_once != current) store_block();
            current = row / rows_at_once;
            active[row] = true;
            return rows->data() + row % rows_at_once * row_size;
        };
        frequencies.amplitudes_by_rows({&values(first, 0), {hogels, values.extent(1)}}, of_roots, row_destination);
        store_block();
        for (std::size_t block = 0; block < blocks; ++block)
            for (std::size_t h = 0; !done[block] && h < hogels; ++h)
                std::fill_n(&moduli(first + h, block * row_size), row_size, 0.0f);
    }
}

void FastTiles::sixteen_rows(std::span<const float> moduli, const PhaseSeries& series, std::size_t look,
                             std::size_t row, float* waves) const {
    const float* block = moduli.data() + row * side_;
    if (phases_.empty())
        random_waves(series, row, block, side_, waves);
    else
        shared_waves({phases_[look].data() + 2 * row * side_, side_ * square_column}, block, waves);
}

void FastTiles::waves(std::span<const float> moduli, const PhaseSeries& series, std::size_t look,
                      const InBandRows& rows, float* waves) const {
    for (std::size_t row = 0; row < side_; row += rows_at_once)
        if (rows.has_any(row, rows_at_once, side_)) sixteen_rows(moduli, series, look, row, waves + 2 * row * side_);
}

bool FastTiles::has_lanes() const { return phases_.empty() && middle_is_a_byte(side_); }

void FastTiles::gather_lanes(std::span<const float* const> moduli, std::size_t row, float* gathered) const {
    for (std::size_t column = 0; column < side_; ++column)
        gather_rows(moduli, row * side_ + column * rows_at_once, gathered + (row * side_ + column) * rows_at_once,
                    side_ * rows_at_once);
}

void FastTiles::row_of_lanes(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                             float* waves) const {
    const std::size_t first =
        shared ? row / rows_at_once * rows_at_once * side_ + row % rows_at_once : row * side_ * rows_at_once;
    random_row(series, row, shared, moduli + first, side_, waves);
}

void FastTiles::synthesise(std::span<const float> moduli, const PhaseSeries& series, std::size_t look,
                           std::complex<float>* to, std::size_t to_stride) const {
    const std::size_t columns = side_ * square_column;                     // floats of sixteen columns, or rows
    const core::ThreadBuffer<float> scratch(columns + 2 * side_ * side_);  // sixteen rows, then the square
    float *waves = scratch.data(), *square = scratch.data() + columns;
    for (std::size_t row = 0; row < side_; row += rows_at_once) {
        sixteen_rows(moduli, series, look, row, waves);
        fft_.backward_split(waves);
        transpose_rows(waves, side_, square + row * square_column, columns);
    }
    fft_.backward_split(square, to, to_stride, side_);
}

}  // namespace hogel::stereogram
