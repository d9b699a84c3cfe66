// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/partitions.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace hogel::codec::format {
namespace {

// Of a row with these samples; a line leaves its first or its last ones.
std::int32_t cut_of(std::uint64_t samples) {
    for (std::size_t cut = 0; cut < row_cuts; ++cut) {
        std::uint64_t in_cut = 0;
        for (std::size_t c = 0; c < block_side; ++c) in_cut |= std::uint64_t{sample_in_cut(c, cut)} << c;
        if (in_cut == samples) return static_cast<std::int32_t>(cut);
    }
    return 0;
}

struct Lines {
    std::array<std::uint64_t, block_lines> beyond{};
    LinesInRows in_rows{};
    Lines() {
        for (std::size_t angle = 0; angle < line_angles; ++angle) {
            // In units of 2^-14, so that every machine has the same.
            const double turn = 2 * std::numbers::pi * double(angle) / double{line_angles};
            const long along_u = std::lround(std::cos(turn) * 0x1p14), along_v = std::lround(std::sin(turn) * 0x1p14);
            const long place_size = std::abs(along_u) + std::abs(along_v);
            for (std::size_t place = 0; place < line_places; ++place)
                for (std::size_t n = 0; n < block_samples; ++n) {
                    const long u = 2 * static_cast<long>(n % block_side) + 1 - static_cast<long>(block_side);
                    const long v = 2 * static_cast<long>(n / block_side) + 1 - static_cast<long>(block_side);
                    if (along_u * u + along_v * v <= 2 * static_cast<long>(place) * place_size) continue;
                    const std::size_t line = line_number(angle, place);
                    beyond[line] |= std::uint64_t{1} << n;
                }
        }
        for (std::size_t line = 0; line < block_lines; ++line)
            for (std::size_t r = 0; r < block_side; ++r)
                in_rows[r][line] = cut_of(beyond[line] >> r * block_side & 0xFF);
    }
};
const Lines lines;

}  // namespace

std::uint64_t samples_beyond(std::size_t line) { return lines.beyond[line]; }

const LinesInRows& lines_in_rows() { return lines.in_rows; }

void put_beyond(std::size_t line, const BlockSamples& beyond, BlockSamples& block) {
    const std::uint64_t samples = lines.beyond[line];
    for (std::size_t n = 0; n < block_samples; ++n)
        if (samples >> n & 1) block[n] = beyond[n];
}

}  // namespace hogel::codec::format
