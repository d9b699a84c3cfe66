// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hogel/codec/format/block_kernels.h"

namespace hogel::codec::format {

// If a nearer surface ends inside a block, a straight edge splits the block into two partitions: the main partition,
// with the middle of the block, and the second partition.

constexpr std::size_t edge_angles = 32, edge_offsets = 4;
static_assert(edge_angles * edge_offsets == block_edges);

// Returns the index of the edge with a normal at `angle` 32nds of a full turn, at a distance of `offset` from the
// middle of the block. The unit of `offset` is one sample for edges along rows and columns, √2 samples for diagonal
// edges.
constexpr std::size_t edge_number(std::size_t angle, std::size_t offset) { return angle * edge_offsets + offset; }

// Returns one bit per sample of a block, lowest first: whether it belongs to the second partition.
std::uint64_t partition_mask(std::size_t edge);
// Returns the masks of all edges as cuts of their rows.
const EdgeRowCuts& edge_row_cuts();

// Replaces the samples of the second partition of `block` by those of `second`.
void put_second_partition(std::size_t edge, const BlockSamples& second, BlockSamples& block);

}  // namespace hogel::codec::format
