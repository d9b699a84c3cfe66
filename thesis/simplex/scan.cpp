// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/scan.h"

namespace hogel::simplex {

using namespace render;

SliceInHogels::SliceInHogels(const Simplex<2>& slice) : slice_(slice) {
    for (std::size_t i = 0; i < 3; ++i) st_[i] = place_in_hogels(slice[i]);
}

Span SliceInHogels::rows(std::size_t nt) const {
    Extent rows;
    for (const auto& [s, t] : st_) rows.include(t);
    return rows.samples(nt);
}

Span SliceInHogels::columns(std::size_t row, std::size_t ns) const {
    Extent columns;
    columns.include_row({0, 1, 2}, slice_, st_, static_cast<double>(row));
    return columns.samples(ns);
}

}  // namespace hogel::simplex
