#include "hogel/codec/parts_internal.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace hogel {
namespace {

struct Lines {
    std::array<std::uint64_t, block_lines> beyond{};
    LinesOfSamples of_samples{};
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
                    of_samples[n][line] = 1;
                }
        }
    }
};
const Lines lines;

}  // namespace

std::uint64_t samples_beyond(std::size_t line) { return lines.beyond[line]; }

const LinesOfSamples& lines_of_samples() { return lines.of_samples; }

void put_beyond(std::size_t line, const BlockSamples& beyond, BlockSamples& block) {
    const std::uint64_t samples = lines.beyond[line];
    for (std::size_t n = 0; n < block_samples; ++n)
        if (samples >> n & 1) block[n] = beyond[n];
}

}  // namespace hogel
