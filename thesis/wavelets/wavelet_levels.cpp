// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "thesis/wavelets/line.h"

namespace hogel::wavelets {
namespace {

// Basis functions at a larger distance (rows) from both ends hardly overlap the ends and have equal norms.
constexpr std::size_t end_rows = 16;

// Returns the norms of the synthesis functions of all rows of the last level (coarse samples, then details),
// measured as impulse responses of the unscaled levels, one tile at a time.
std::vector<double> synthesis_norms(std::span<const WaveletLine> levels) {
    const WaveletLine& last = levels.back();
    const std::size_t length = last.length(), coarse_count = (length + 1) / 2;
    // Rows near the ends of each half are measured individually; one in the middle represents all others.
    std::vector<std::size_t> measured;
    std::vector<std::size_t> stands_for(length);
    for (std::size_t half = 0; half < 2; ++half) {
        const std::size_t begin = half == 0 ? 0 : coarse_count, end = half == 0 ? coarse_count : length;
        for (std::size_t row = begin; row < end; ++row) {
            const bool inner = row >= begin + end_rows && row + end_rows < end;
            stands_for[row] = inner ? begin + end_rows : row;
            if (stands_for[row] == row) measured.push_back(row);
        }
    }
    std::vector<double> norms(length);
    std::vector<float> tile(levels.front().length() * lane_count), sorted(tile.size());
    for (std::size_t first = 0; first < measured.size(); first += lane_count) {
        const std::size_t count = std::min(lane_count, measured.size() - first);
        std::fill(tile.begin(), tile.end(), 0.0f);
        for (std::size_t lane = 0; lane < count; ++lane) tile[measured[first + lane] * lane_count + lane] = 1;
        for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
            level->inverse(tile.data());
            for (std::size_t row = 0; row < level->length(); ++row)
                std::copy_n(&tile[row * lane_count], lane_count, &sorted[level->sample_of_row(row) * lane_count]);
            std::copy_n(sorted.begin(), level->length() * lane_count, tile.begin());
        }
        for (std::size_t lane = 0; lane < count; ++lane) {
            double squares = 0;
            for (std::size_t i = lane; i < tile.size(); i += lane_count)
                squares += static_cast<double>(tile[i]) * tile[i];
            norms[measured[first + lane]] = std::sqrt(squares);
        }
    }
    for (std::size_t row = 0; row < length; ++row) norms[row] = norms[stands_for[row]];
    return norms;
}

}  // namespace

std::vector<WaveletLine> wavelet_levels(const Wavelet& wavelet, std::size_t length, int levels) {
    std::vector<WaveletLine> result;
    std::vector<std::vector<double>> norms;
    for (std::size_t n = length; n > 1 && std::ssize(result) < levels; n = (n + 1) / 2) {
        result.emplace_back(wavelet, n);
        norms.push_back(synthesis_norms(result));
    }
    for (std::size_t level = 0; level < result.size(); ++level)
        result[level].set_scales(level == 0 ? std::vector<double>(length, 1.0) : norms[level - 1], norms[level]);
    return result;
}

}  // namespace hogel::wavelets
