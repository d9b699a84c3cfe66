// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "hogel/core/stop_scope.h"
#include "hogel/direct/fresnel_integral.h"
#include "hogel/direct/line_source.h"
#include "hogel/direct/scene_points.h"

namespace hogel::direct {

std::complex<double> line_wave(const LineSource& line, Vec3 position, double wavelength) {
    const Vec3 along = line.b - line.a;
    const double size = length(along);
    const Vec3 t = along / size;
    // Point of the line that lights this position: light leaves at a fixed angle to it, with cosine `slope`.
    const double foot = dot(position - line.a, t), distance = length(position - line.a - foot * t);
    const double slope = line.slope, sine = std::sqrt(1 - slope * slope);
    const bool behind = line.a.z < 0;
    const double stationary = foot - slope * distance / sine, path = distance / sine;
    const double scale = sine * std::sqrt(2 / (wavelength * path));
    const std::complex<double> integral =
        fresnel_integral((size - stationary) * scale) - fresnel_integral(-stationary * scale);
    const double cycles = (path + slope * stationary) / wavelength;
    const std::complex<double> wave = std::polar(line.amplitude * std::sqrt(0.5 * wavelength / path) / sine,
                                                 2 * std::numbers::pi * (cycles - std::round(cycles))) *
                                      integral;
    // In front of the hologram, light still converges on the line.
    return std::polar(1.0, 2 * std::numbers::pi * line.cycles) * (behind ? wave : std::conj(wave));
}

// Edges as coherent line sources, each with the phase that sends its light straight ahead. A line of length l and
// radiance L, as wide as the points' spacing w, has the same energy at the hologram as l/w independent points.
Field line_sources(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                   const Progress& progress) {
    const core::StopScope scope(progress);
    std::vector<LineSource> lines;
    std::uint32_t line_index = 0;
    for (const SceneEdge& edge : scene_edges(scene, options)) {
        const double nearest = nearest_depth(grid);
        // The parts behind and in front of the plane.
        for (const double side : {-1.0, 1.0}) {
            Vec3 a = edge.a, b = edge.b;
            if (side * a.z > side * b.z) std::swap(a, b);
            if (side * b.z <= nearest) continue;
            if (side * a.z < nearest) a = b + (side * nearest - b.z) / (a.z - b.z) * (a - b);
            const double size = length(b - a), cosine = std::abs(b.z - a.z) / size;
            const double middle = 0.5 * std::abs(a.z + b.z);
            // A line seen end-on acts as a point.
            if (!(size > 0) || cosine > 0.95) continue;
            LineSource line{a, b};
            line.slope = -side * (b.z - a.z) / size;
            line.amplitude = std::sqrt(edge.radiance * options.spacing * size / (grid.wavelength * middle));
            line.cycles = random_cycles(options, line_index++, 0, 0xfffffffe);
            lines.push_back(line);
        }
    }
    return sum_over_samples(grid, progress, [&](Vec3 position) {
        std::complex<double> sum = 0;
        for (const LineSource& line : lines) {
            const Vec3 nearest =
                line.a +
                std::clamp(dot(position - line.a, line.b - line.a) / dot(line.b - line.a, line.b - line.a), 0.0, 1.0) *
                    (line.b - line.a);
            if (passage(nearest, position, grid)) sum += line_wave(line, position, grid.wavelength);
        }
        return sum;
    });
}

}  // namespace hogel::direct
