// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/slice.h"

namespace hogel::simplex {

template <std::size_t N>
void clip(std::vector<std::array<ProjectedPoint, N>>& simplices, std::size_t axis, double bound, bool keep_above) {
    std::vector<std::array<ProjectedPoint, N>> kept;
    for (std::array<ProjectedPoint, N> simplex : simplices) {
        sort_along(axis, simplex);
        const auto first_above = std::find_if(simplex.begin(), simplex.end(),
                                              [&](const ProjectedPoint& corner) { return corner[axis] >= bound; });
        const auto below = static_cast<std::size_t>(first_above - simplex.begin()), above = simplex.size() - below;
        const std::size_t inside = keep_above ? above : below, outside = simplex.size() - inside;
        if (inside == 0) continue;
        if (outside == 0) {
            kept.push_back(simplex);
            continue;
        }
        // The part inside is an (inside − 1, outside)-simploid: its corner (i, 0) is the i-th corner inside, its corner
        // (i, 1 + j) the point on the edge from there to the j-th corner outside.
        const std::size_t in = keep_above ? below : 0, out = keep_above ? 0 : below;
        for (const auto& path : product_paths<N>(inside - 1)) {
            std::array<ProjectedPoint, N>& piece = kept.emplace_back();
            for (std::size_t k = 0; k < piece.size(); ++k) {
                const ProjectedPoint& corner = simplex[in + path[k].first];
                if (path[k].second == 0) {
                    piece[k] = corner;
                } else {
                    const ProjectedPoint& outer_corner = simplex[out + path[k].second - 1];
                    piece[k] = keep_above ? point_between(outer_corner, corner, axis, bound)
                                          : point_between(corner, outer_corner, axis, bound);
                }
            }
        }
    }
    simplices.swap(kept);
}

template void clip(std::vector<Simplex<3>>&, std::size_t, double, bool);
template void clip(std::vector<Simplex<4>>&, std::size_t, double, bool);

}  // namespace hogel::simplex
