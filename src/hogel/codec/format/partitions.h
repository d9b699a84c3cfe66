// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hogel/codec/format/block_kernels.h"

namespace hogel::codec::format {

// Where a nearer surface ends within a block, a straight line cuts it into two parts: the main one, which holds its
// middle, and what lies beyond the line.

constexpr std::size_t line_angles = 32, line_places = 4;
static_assert(line_angles * line_places == block_lines);

// Line `place` places from the middle of a block, seen from there at an angle of `angle` 32nds of a turn. A place is a
// sample for lines along the rows and columns, and √2 samples for those across.
constexpr std::size_t line_number(std::size_t angle, std::size_t place) { return angle * line_places + place; }

// A bit for each sample of a block, from the lowest on: whether it lies beyond the line.
std::uint64_t samples_beyond(std::size_t line);
// The same row by row.
const LinesInRows& lines_in_rows();

// Puts what lies beyond a line in place of what is there.
void put_beyond(std::size_t line, const BlockSamples& beyond, BlockSamples& block);

}  // namespace hogel::codec::format
