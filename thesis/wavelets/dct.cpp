// SPDX-License-Identifier: Apache-2.0
#include "thesis/wavelets/dct.h"

#include <algorithm>
#include <array>

#include "hogel/math/dct.h"

namespace hogel::wavelets {
namespace {

using Matrix = std::array<float, dct_block * dct_block>;  // n x n elements, row-major

struct Matrices {
    std::array<Matrix, dct_block + 1> forward{}, inverse{};  // by number of points
};

const Matrices& matrices() {
    static const Matrices matrices = [] {
        Matrices result;
        for (std::size_t n = 1; n <= dct_block; ++n)
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t j = 0; j < n; ++j)
                    result.forward[n][k * n + j] = result.inverse[n][j * n + k] =
                        static_cast<float>(math::dct_element(n, k, j));
        return result;
    }();
    return matrices;
}

void multiply_blocks(const std::array<Matrix, dct_block + 1>& by_points, std::size_t length, float* rows) {
    for (std::size_t first = 0; first < length; first += dct_block) {
        const std::size_t n = std::min(dct_block, length - first);
        const Matrix& matrix = by_points[n];
        float* block = rows + first * lane_count;
        float result[dct_block * lane_count] = {};
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t lane = 0; lane < lane_count; ++lane)
                    result[k * lane_count + lane] += matrix[k * n + j] * block[j * lane_count + lane];
        std::copy_n(result, n * lane_count, block);
    }
}

}  // namespace

void DctLine::forward(float* rows) const { multiply_blocks(matrices().forward, length_, rows); }
void DctLine::inverse(float* rows) const { multiply_blocks(matrices().inverse, length_, rows); }

}  // namespace hogel::wavelets
