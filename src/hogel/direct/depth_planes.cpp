// SPDX-License-Identifier: Apache-2.0
#include "hogel/direct/depth_planes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::direct {

std::vector<Slice> slices_of(const ShadedScene& scene, std::size_t count) {
    if (count == 0) throw Error(ErrorCode::usage, "planes", "a scene must be cut into at least one plane");
    double near = std::numeric_limits<double>::infinity(), far = -near;
    for (const ShadedScene::Triangle& triangle : scene.triangles)
        for (const std::uint32_t vertex : triangle.vertices) {
            near = std::min(near, -scene.positions[vertex].z);
            far = std::max(far, -scene.positions[vertex].z);
        }
    const double margin = 1e-6 * std::max(std::abs(near), std::abs(far)) + 1e-9;
    if (far - near < margin) return {{near - margin, far + margin}};
    std::vector<Slice> slices;
    const double step = (far - near) / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i)
        slices.push_back({near + step * static_cast<double>(i), near + step * static_cast<double>(i + 1)});
    // The margin keeps surfaces at the ends despite rounding.
    slices.front().near -= margin;
    slices.back().far += margin;
    return slices;
}

SliceDrawing::Drawn SliceDrawing::draw(const Slice& slice, const Grid& plane, double wavelength,
                                       const SceneHologramOptions& options) const {
    Drawn drawn{Array<std::complex<float>, 2>({plane.height, plane.width}),
                Array<float, 2>({plane.height, plane.width})};
    const double scale = wavelength / std::sqrt(plane.pitch_x * plane.pitch_y);
    const auto slice_key = static_cast<std::uint32_t>(std::lround(1e9 * std::abs(slice.depth())));
    std::atomic<bool> empty = true;
    work::parallel_for(plane.height, [&](std::size_t row) {
        bool row_is_empty = true;
        for (std::size_t column = 0; column < plane.width; ++column) {
            const Vec3 start{plane.x(static_cast<double>(column)), plane.y(static_cast<double>(row)), -slice.near};
            const trace::RayHit hit = visibility_.caster().closest(start, {0, 0, -1}, slice.far - slice.near);
            if (hit.triangle == trace::RayHit::miss) continue;
            const Rgb colour =
                radiance_at(scene_, hit.triangle, 1 - hit.b1 - hit.b2, hit.b1, hit.b2, {{0, 0, 1}, plane.pitch_x});
            const float radiance = options.channel == 0 ? colour.r : options.channel == 1 ? colour.g : colour.b;
            const double cycles =
                random_cycles(options, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), slice_key);
            row_is_empty = false;
            drawn.solid(row, column) = 1;
            drawn.light(row, column) = std::complex<float>(
                std::polar(scale * std::sqrt(std::max(radiance, 0.0f)), 2 * std::numbers::pi * cycles));
        }
        if (!row_is_empty) empty = false;
    });
    drawn.empty = empty;
    return drawn;
}

}  // namespace hogel::direct
