// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/setup.h"

#include <algorithm>
#include <cmath>

#include "hogel/render/epi/triangle_cut.h"

namespace hogel::render::epi {

void set_up_spans_plain(const TriangleClusters& clusters, std::span<const std::uint32_t> slots, const CutPlane& plane,
                        EpiSpan* spans, SpanValues* values, SpanOrigin* origins) {
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const TriangleCorners& triangle = clusters.corners[slots[i]];
        std::array<double, 3> x, z, height;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            x[corner] = triangle.x[corner];
            z[corner] = triangle.z[corner];
            height[corner] = (triangle.y[corner] - plane.slope * z[corner]) - plane.row;
        }
        const auto below = [](double h) { return h < 0; };
        if (std::ranges::all_of(height, below) || std::ranges::none_of(height, below)) {
            spans[i] = empty_span;
            values[i] = {};
            if (origins) origins[i] = {};
            continue;
        }
        auto [lone, next, last, end0, end1] = cut_triangle(x, z, height);
        for (Crossing* end : {&end0, &end1}) {
            end->x += plane.shift;
            end->z -= plane.z0;
        }
        const auto x0 = static_cast<float>(end0.x), z0 = static_cast<float>(end0.z);
        spans[i] = {x0, z0, static_cast<float>(end1.x), static_cast<float>(end1.z)};
        const auto w0 = static_cast<float>(end0.weight), w1 = static_cast<float>(end1.weight);
        const Rgb value0 = w0 * triangle.radiance[lone] + (1 - w0) * triangle.radiance[next];
        const Rgb value1 = w1 * triangle.radiance[lone] + (1 - w1) * triangle.radiance[last];
        const auto depth0 = static_cast<float>(end0.z * plane.depth_per_z),
                   depth1 = static_cast<float>(end1.z * plane.depth_per_z);
        values[i] = {x0,
                     z0,
                     static_cast<float>(end1.x - end0.x),
                     static_cast<float>(end1.z - end0.z),
                     {value0.r, value0.g, value0.b, depth0},
                     {value1.r - value0.r, value1.g - value0.g, value1.b - value0.b, depth1 - depth0}};
        if (origins)
            origins[i] = {w0, w1, clusters.triangles[slots[i]], static_cast<std::uint16_t>(lone),
                          static_cast<std::uint16_t>(next)};
    }
}

}  // namespace hogel::render::epi
