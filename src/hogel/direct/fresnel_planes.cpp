// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/core/stop_scope.h"
#include "hogel/direct/depth_planes.h"
#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::direct {
namespace {

using Complex = std::complex<float>;

Complex unit(double cycles) { return Complex(std::polar(1.0, 2 * std::numbers::pi * (cycles - std::round(cycles)))); }

// Propagates the field of a plane at depth R to the hologram by one Fourier transform, [K] (3.13). The transform fixes
// the plane's pitch, δ = λ|R|/(nΔ). `far` omits the quadratic phase over the object, [K] (3.10).
class PlaneTransform {
  public:
    PlaneTransform(const FieldGrid& hologram, double depth, bool far)
        : hologram_(hologram), depth_(depth), far_(far), fft_(hologram.plane.height, hologram.plane.width) {
        const Grid& plane = hologram.plane;
        const double lambda_r = hologram.wavelength * std::abs(depth);
        object_ = {plane.width,
                   plane.height,
                   lambda_r / (static_cast<double>(plane.width) * plane.pitch_x),
                   lambda_r / (static_cast<double>(plane.height) * plane.pitch_y),
                   plane.center_x,
                   plane.center_y};
    }
    const Grid& object() const { return object_; }

    void add(View<Complex, 2> light, View<Complex, 2> field) const {
        const Grid& plane = hologram_.plane;
        const double sign = depth_ > 0 ? 1 : -1, k = 1 / hologram_.wavelength;
        // x_s x_h/λ|R| = (m − c)(n − c)/N with c = (N−1)/2. These phases come on top of the transform's m n/N.
        const auto shift = [](double index, std::size_t count) {
            const double n = static_cast<double>(count), c = 0.5 * (n - 1);
            return (c * index - 0.5 * c * c) / n;
        };
        const auto curved = [&](double x, double y) { return 0.5 * k * (x * x + y * y) / depth_; };
        work::parallel_for(light.extent(0), [&](std::size_t row) {
            for (std::size_t column = 0; column < light.extent(1); ++column) {
                const double i = static_cast<double>(column), j = static_cast<double>(row);
                double cycles = sign * (shift(i, plane.width) + shift(j, plane.height));
                if (!far_) cycles += curved(object_.x(i) - object_.center_x, object_.y(j) - object_.center_y);
                light(row, column) *= unit(cycles);
            }
        });
        depth_ > 0 ? fft_.forward(light) : fft_.backward(light);
        const double scale = object_.pitch_x * object_.pitch_y / (hologram_.wavelength * std::abs(depth_));
        work::parallel_for(field.extent(0), [&](std::size_t row) {
            for (std::size_t column = 0; column < field.extent(1); ++column) {
                const double i = static_cast<double>(column), j = static_cast<double>(row);
                // e^{ikR}/(iλR)
                const double cycles = k * depth_ - 0.25 * sign +
                                      sign * (shift(i, plane.width) + shift(j, plane.height)) +
                                      curved(plane.x(i) - plane.center_x, plane.y(j) - plane.center_y);
                field(row, column) += static_cast<float>(scale) * light(row, column) * unit(cycles);
            }
        });
    }

  private:
    FieldGrid hologram_;
    double depth_;
    bool far_;
    Grid object_;
    math::Fft2 fft_;
};

// Largest distances of a slice's vertices from the hologram's middle, metres: in x, in y, and radially.
struct SliceExtent {
    double x = 0, y = 0, corner = 0;
};
SliceExtent extent_of(const ShadedScene& scene, const Grid& plane, const Slice& slice) {
    SliceExtent extent;
    for (const ShadedScene::Triangle& triangle : scene.triangles)
        for (const std::uint32_t vertex : triangle.vertices) {
            const Vec3& p = scene.positions[vertex];
            if (-p.z < slice.near || -p.z > slice.far) continue;
            const double x = std::abs(p.x - plane.center_x), y = std::abs(p.y - plane.center_y);
            extent = {std::max(extent.x, x), std::max(extent.y, y), std::max(extent.corner, std::hypot(x, y))};
        }
    return extent;
}

// The transform's plane is periodic with λR/Δ: a wider scene would overlap its copies.
void require_fit(const SliceExtent& extent, const Grid& object, double depth) {
    const double wider = std::max(2 * extent.x / object.size_x(), 2 * extent.y / object.size_y());
    if (wider <= 1) return;
    throw Error(ErrorCode::usage, "method",
                fmt::format("a plane at a depth of {} covers at most {}x{}, but the scene there covers {}x{}; "
                            "expected a depth of {} or more, or a pitch {:.2g} times finer",
                            format_length(std::abs(depth)), format_length(object.size_x()),
                            format_length(object.size_y()), format_length(2 * extent.x), format_length(2 * extent.y),
                            format_length(std::abs(depth) * wider), wider));
}

Field add_planes(const ShadedScene& scene, const FieldGrid& grid, const std::vector<Slice>& slices, bool far,
                 const SceneHologramOptions& options, const Progress& progress) {
    validate(grid, ErrorCode::usage, "hologram");
    Field field(grid);
    const SliceDrawing drawing(scene);
    for (std::size_t i = 0; i < slices.size(); ++i) {
        progress.report(static_cast<double>(i) / static_cast<double>(slices.size()));
        const double depth = slices[i].depth();
        if (std::abs(depth) < nearest_depth(grid))
            throw Error(ErrorCode::usage, "method",
                        fmt::format("a plane of the scene lies on the hologram; expected a distance of at least {}",
                                    format_length(nearest_depth(grid))));
        const PlaneTransform transform(grid, depth, far);
        require_fit(extent_of(scene, grid.plane, slices[i]), transform.object(), depth);
        SliceDrawing::Drawn drawn = drawing.draw(slices[i], transform.object(), grid.wavelength, options);
        if (!drawn.empty) transform.add(drawn.light, field.samples);
    }
    progress.report(1);
    return field;
}

}  // namespace

// Adds depth planes without occlusion, [K] fig. 3.7.
Field fresnel_planes(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                     const Progress& progress) {
    const core::StopScope scope(progress);
    return add_planes(scene, grid, slices_of(scene, options.planes), false, options, progress);
}

// One plane, far or small enough to neglect the quadratic phase over it (below λ/8): [K] (3.7).
Field fraunhofer_plane(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                       const Progress& progress) {
    const core::StopScope scope(progress);
    const std::vector<Slice> slices = slices_of(scene, 1);
    const double corner = extent_of(scene, grid.plane, slices[0]).corner;
    const double needed = 4 * corner * corner / grid.wavelength;
    if (std::abs(slices[0].depth()) < needed)
        throw Error(ErrorCode::usage, "method",
                    fmt::format("an object that reaches {} from the axis is in the far field from {} on, not at {}",
                                format_length(corner), format_length(needed), format_length(slices[0].depth())));
    return add_planes(scene, grid, slices, true, options, progress);
}

}  // namespace hogel::direct
