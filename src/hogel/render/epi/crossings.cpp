// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/crossings.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hogel::render::epi {

bool may_meet(const ClusterBox& box, const RowRays& rays) {
    const double near = box.z_low - rays.z0, far = box.z_high - rays.z0;
    const auto products = [&](double a, double b) { return std::minmax({a * near, a * far, b * near, b * far}); };
    const auto [ahead, behind] = products(rays.slope, rays.slope + rays.step * static_cast<double>(rays.planes - 1));
    const double low = box.y_low - rays.row, high = box.y_high - rays.row;
    const double height = std::max(std::abs(low), std::abs(high)) + std::max(std::abs(ahead), std::abs(behind));
    // Beyond any rounding.
    if (!(low - behind <= 1e-9 * height && high - ahead >= -1e-9 * height)) return false;
    // The columns n = x − K z that see a point of the box.
    const auto [least, most] = products(rays.K_first, rays.K_last);
    const double n_low = (box.x_low + rays.shift) - most, n_high = (box.x_high + rays.shift) - least;
    // Strips are drawn in single precision.
    const double reach =
        std::max(std::abs(box.x_low), std::abs(box.x_high)) + std::max(std::abs(least), std::abs(most));
    const double margin = 1 + 1e-6 * reach;
    return n_low - margin <= rays.n_last && n_high + margin >= rays.n_first;
}

HeightScale::HeightScale(const ClusterBox& box, const RowRays& rays)
    : y(static_cast<float>(box.y_low - rays.row)),
      y_step(static_cast<float>((box.y_high - box.y_low) / ClusterHeights::steps)),
      z(static_cast<float>(box.z_low - rays.z0)),
      z_step(static_cast<float>((box.z_high - box.z_low) / ClusterHeights::steps)),
      per_slope(static_cast<float>(1 / rays.step)),
      first(static_cast<float>(-rays.slope / rays.step)) {
    // Half a step and some roundings.
    const auto error_of = [](float from, float step) {
        return 0.51f * step + 4e-7f * (std::abs(from) + static_cast<float>(ClusterHeights::steps) * step);
    };
    const float y_error = error_of(y, y_step), z_error = error_of(z, z_step);
    const double last_slope = rays.slope + rays.step * static_cast<double>(rays.planes - 1);
    steepest = 1.000001f * static_cast<float>(std::max(std::abs(rays.slope), std::abs(last_slope)));
    error = 1.01f * (y_error + steepest * z_error);
    rounding = 1e-6f * (std::abs(first) + 2 * static_cast<float>(RowRays::max_planes));
    most = 0.25f * std::abs(per_slope) / z_error;
}

void find_crossings_plain(const TriangleClusters& clusters, const RowRays& rays, Crossings& crossings) {
    crossings.resize(rays.planes);
    for (std::vector<Crossing>& of_plane : crossings) of_plane.clear();
    for (std::uint32_t cluster = 0; cluster < clusters.heights.size(); ++cluster) {
        const ClusterBox& box = clusters.boxes[cluster];
        if (!may_meet(box, rays)) continue;
        const HeightScale scale(box, rays);
        const ClusterHeights& heights = clusters.heights[cluster];
        std::vector<std::uint64_t> triangles(rays.planes);
        for (std::uint64_t rest = clusters.filled(cluster); rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            float y[3], z[3], R[3], at[3];
            for (std::size_t corner = 0; corner < 3; ++corner) {
                y[corner] = scale.y + scale.y_step * static_cast<float>(heights.y[corner][i]);
                z[corner] = scale.z + scale.z_step * static_cast<float>(heights.z[corner][i]);
                R[corner] = scale.per_slope / z[corner];
                at[corner] = y[corner] * R[corner] + scale.first;
            }
            float begin = 0, end = static_cast<float>(rays.planes - 1);
            const auto [R_low, R_high] = std::minmax({R[0], R[1], R[2]});
            const float steepest = std::max(-R_low, R_high);
            if (steepest < scale.most && (R_low > 0 || R_high < 0)) {
                const auto [low, high] = std::minmax({at[0], at[1], at[2]});
                const float margin = scale.error * steepest + scale.rounding;
                begin = std::max(begin, std::ceil(low - margin));
                end = std::min(end, std::floor(high + margin));
            } else {
                const auto [y_low, y_high] = std::minmax({y[0], y[1], y[2]});
                const float far = std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])});
                const float reach = scale.steepest * far + scale.error;
                if (y_low > reach || y_high < -reach) continue;
            }
            for (float plane = begin; plane <= end; ++plane)
                triangles[static_cast<std::size_t>(plane)] |= std::uint64_t{1} << i;
        }
        for (std::size_t plane = 0; plane < rays.planes; ++plane)
            if (triangles[plane] != 0) crossings[plane].push_back({triangles[plane], cluster});
    }
}

}  // namespace hogel::render::epi
