// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/partitions.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace hogel::codec::format {
namespace {

// Returns the cut of a row that contains exactly these samples, the first or the last of the row.
std::int32_t cut_of(std::uint64_t samples) {
    for (std::size_t cut = 0; cut < row_cuts; ++cut) {
        std::uint64_t in_cut = 0;
        for (std::size_t c = 0; c < block_side; ++c) in_cut |= std::uint64_t{sample_in_cut(c, cut)} << c;
        if (in_cut == samples) return static_cast<std::int32_t>(cut);
    }
    return 0;
}

struct Edges {
    std::array<std::uint64_t, block_edges> masks{};
    EdgeRowCuts row_cuts_of{};
    Edges() {
        for (std::size_t angle = 0; angle < edge_angles; ++angle) {
            // Rounded to multiples of 2^-14, so that all machines agree.
            const double phi = 2 * std::numbers::pi * double(angle) / double{edge_angles};
            const long along_u = std::lround(std::cos(phi) * 0x1p14), along_v = std::lround(std::sin(phi) * 0x1p14);
            const long unit = std::abs(along_u) + std::abs(along_v);
            for (std::size_t offset = 0; offset < edge_offsets; ++offset)
                for (std::size_t n = 0; n < block_samples; ++n) {
                    const long u = 2 * static_cast<long>(n % block_side) + 1 - static_cast<long>(block_side);
                    const long v = 2 * static_cast<long>(n / block_side) + 1 - static_cast<long>(block_side);
                    if (along_u * u + along_v * v <= 2 * static_cast<long>(offset) * unit) continue;
                    masks[edge_number(angle, offset)] |= std::uint64_t{1} << n;
                }
        }
        for (std::size_t edge = 0; edge < block_edges; ++edge)
            for (std::size_t r = 0; r < block_side; ++r)
                row_cuts_of[r][edge] = cut_of(masks[edge] >> r * block_side & 0xFF);
    }
};
const Edges edges;

}  // namespace

std::uint64_t partition_mask(std::size_t edge) { return edges.masks[edge]; }

const EdgeRowCuts& edge_row_cuts() { return edges.row_cuts_of; }

void put_second_partition(std::size_t edge, const BlockSamples& second, BlockSamples& block) {
    const std::uint64_t mask = edges.masks[edge];
    for (std::size_t n = 0; n < block_samples; ++n)
        if (mask >> n & 1) block[n] = second[n];
}

}  // namespace hogel::codec::format
