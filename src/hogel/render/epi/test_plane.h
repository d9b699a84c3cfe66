// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/render/epi/kernels.h"

namespace hogel::render::epi {

/// Empty epipolar plane for tests, with its words and cells.
struct TestPlane {
    std::vector<std::uint64_t> words;
    DepthCells cells;
    EpipolarPlane plane;

    TestPlane(std::size_t columns, std::size_t directions, std::int32_t first_column)
        : words(columns * directions + EpipolarPlane::padding, EpipolarPlane::empty),
          plane{words.data(), &cells, columns, directions, first_column, 0.5f - 0.5f * float(directions)} {
        cells.clear(columns, directions);
    }
};

}  // namespace hogel::render::epi
