// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/simplex/scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hogel::render::simplex {

SliceInHogels::SliceInHogels(const Simplex<2>& slice) : slice_(slice) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double depth = 1 / slice[i][axis::q];
        s_[i] = slice[i][axis::s] * depth;
        t_[i] = slice[i][axis::t] * depth;
    }
}

Span SliceInHogels::rows(std::size_t nt) const {
    const auto [low, high] = std::minmax_element(t_.begin(), t_.end());
    return samples_between(*low, *high, nt);
}

Span SliceInHogels::columns(std::size_t row, std::size_t ns) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto include = [&](double s) {
        low = std::min(low, s);
        high = std::max(high, s);
    };
    const double t = static_cast<double>(row);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        // A row within the margin of a corner may not cross either edge there, so the corner is included.
        if (std::abs(t_[i] - t) <= scan_margin) include(s_[i]);
        if ((t_[i] <= t && t <= t_[j]) || (t_[j] <= t && t <= t_[i])) include(crossing(slice_[i], slice_[j], t));
    }
    return samples_between(low, high, ns);
}

}  // namespace hogel::render::simplex
