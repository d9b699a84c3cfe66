// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/crossed.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hogel::render::epi {

bool may_show(const ClusterBox& box, const RowPlanes& planes) {
    const double z_low = box.z_low - planes.z0, z_high = box.z_high - planes.z0;
    const auto products = [&](double a, double b) {
        return std::minmax({a * z_low, a * z_high, b * z_low, b * z_high});
    };
    // Heights of the planes at the box's depths, and of the box, relative to the row.
    const double last_slope = planes.slope + planes.step * static_cast<double>(planes.count - 1);
    const auto [min_rise, max_rise] = products(planes.slope, last_slope);
    const double low = box.y_low - planes.row, high = box.y_high - planes.row;
    const double size = std::max(std::abs(low), std::abs(high)) + std::max(std::abs(min_rise), std::abs(max_rise));
    // The margin exceeds the rounding error.
    if (!(low - max_rise <= 1e-9 * size && high - min_rise >= -1e-9 * size)) return false;
    // Columns n = x − K z that see a point of the box.
    const auto [min_Kz, max_Kz] = products(planes.K_first, planes.K_last);
    const double n_low = (box.x_low + planes.shift) - max_Kz, n_high = (box.x_high + planes.shift) - min_Kz;
    // Spans are drawn in single precision.
    const double x_size =
        std::max(std::abs(box.x_low), std::abs(box.x_high)) + std::max(std::abs(min_Kz), std::abs(max_Kz));
    const double margin = 1 + 1e-6 * x_size;
    return n_low - margin <= planes.n_last && n_high + margin >= planes.n_first;
}

HeightScale::HeightScale(const ClusterBox& box, const RowPlanes& planes)
    : y(static_cast<float>(box.y_low - planes.row)),
      y_step(static_cast<float>((box.y_high - box.y_low) / ClusterHeights::steps)),
      z(static_cast<float>(box.z_low - planes.z0)),
      z_step(static_cast<float>((box.z_high - box.z_low) / ClusterHeights::steps)),
      per_slope(static_cast<float>(1 / planes.step)),
      first(static_cast<float>(-planes.slope / planes.step)) {
    // Half a quantisation step and some rounding errors.
    const auto error_of = [](float low, float step) {
        return 0.51f * step + 4e-7f * (std::abs(low) + static_cast<float>(ClusterHeights::steps) * step);
    };
    const float y_error = error_of(y, y_step), z_error = error_of(z, z_step);
    const double last_slope = planes.slope + planes.step * static_cast<double>(planes.count - 1);
    max_slope = 1.000001f * static_cast<float>(std::max(std::abs(planes.slope), std::abs(last_slope)));
    error = 1.01f * (y_error + max_slope * z_error);
    rounding = 1e-6f * (std::abs(first) + 2 * static_cast<float>(RowPlanes::max_planes));
    max_R = 0.25f * std::abs(per_slope) / z_error;
}

void find_crossed_plain(const TriangleClusters& clusters, const RowPlanes& planes, CrossedByPlane& crossed) {
    crossed.resize(planes.count);
    for (std::vector<CrossedTriangles>& by_plane : crossed) by_plane.clear();
    for (std::uint32_t cluster = 0; cluster < clusters.heights.size(); ++cluster) {
        const ClusterBox& box = clusters.boxes[cluster];
        if (!may_show(box, planes)) continue;
        const HeightScale scale(box, planes);
        const ClusterHeights& heights = clusters.heights[cluster];
        std::vector<std::uint64_t> triangles(planes.count);
        for (std::uint64_t remaining = clusters.occupied(cluster); remaining != 0; remaining &= remaining - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(remaining));
            float y[3], z[3], R[3], plane_index[3];
            for (std::size_t corner = 0; corner < 3; ++corner) {
                y[corner] = scale.y + scale.y_step * static_cast<float>(heights.y[corner][i]);
                z[corner] = scale.z + scale.z_step * static_cast<float>(heights.z[corner][i]);
                R[corner] = scale.per_slope / z[corner];
                plane_index[corner] = y[corner] * R[corner] + scale.first;
            }
            float begin = 0, end = static_cast<float>(planes.count - 1);
            const auto [R_low, R_high] = std::minmax({R[0], R[1], R[2]});
            const float max_R = std::max(-R_low, R_high);
            if (max_R < scale.max_R && (R_low > 0 || R_high < 0)) {
                const auto [low, high] = std::minmax({plane_index[0], plane_index[1], plane_index[2]});
                const float margin = scale.error * max_R + scale.rounding;
                begin = std::max(begin, std::ceil(low - margin));
                end = std::min(end, std::floor(high + margin));
            } else {
                const auto [y_low, y_high] = std::minmax({y[0], y[1], y[2]});
                const float max_z = std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])});
                const float max_y = scale.max_slope * max_z + scale.error;
                if (y_low > max_y || y_high < -max_y) continue;
            }
            for (float plane = begin; plane <= end; ++plane)
                triangles[static_cast<std::size_t>(plane)] |= std::uint64_t{1} << i;
        }
        for (std::size_t plane = 0; plane < planes.count; ++plane)
            if (triangles[plane] != 0) crossed[plane].push_back({triangles[plane], cluster});
    }
}

}  // namespace hogel::render::epi
