// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/hemicube_resampling.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace hogel::stereogram {
namespace {

// Maximum number of points per lobe and axis. More matter only near the hologram plane, where rays are dense.
constexpr double max_points = 12;

// Returns the width, in rays of the face, of a cell of direction sines around a unit direction, by finite differences.
double width_in_rays(const LightFieldGrid& face, Vec3 direction, double step, bool line) {
    const auto position = [&](double sx, double sy) {
        const Vec3 q = to_face(face.face(), {sx, sy, std::sqrt(std::max(1e-6, 1 - sx * sx - sy * sy))});
        return Vec3{face.column(q.x / q.z), line ? 0 : face.row(q.y / q.z), 0};
    };
    constexpr double difference = 0.05;
    const Vec3 center = position(direction.x, direction.y);
    return std::max(length(position(direction.x + difference * step, direction.y) - center),
                    length(position(direction.x, direction.y + difference * step) - center)) /
           difference;
}

// Adds the four rays around a direction with bilinear weights, or the nearest; border rays extend to the edge.
void add_rays(const LightFieldGrid& face, std::size_t first, Vec3 direction, Interpolation interpolation, double weight,
              std::map<std::uint32_t, double>& sum) {
    const Vec3 q = to_face(face.face(), direction);
    const auto clamped = [](double position, std::size_t count) {
        return std::clamp(position, 0.0, static_cast<double>(count) - 1);
    };
    double k = clamped(face.column(q.x / q.z), face.directions_u), l = clamped(face.row(q.y / q.z), face.directions_v);
    if (interpolation == Interpolation::constant) {
        k = std::round(k);
        l = std::round(l);
    }
    const auto k0 = static_cast<std::size_t>(k), l0 = static_cast<std::size_t>(l);
    const double a = k - static_cast<double>(k0), b = l - static_cast<double>(l0);
    for (const std::size_t j : {0, 1})
        for (const std::size_t i : {0, 1}) {
            const double part = weight * (i == 1 ? a : 1 - a) * (j == 1 ? b : 1 - b);
            if (part > 0) sum[static_cast<std::uint32_t>(first + (l0 + j) * face.directions_u + k0 + i)] += part;
        }
}

}  // namespace

HemicubeResampling scatter_lobes(std::span<const LightFieldGrid> faces, std::size_t samples, double step_y, bool line,
                                 double wavelength, Interpolation interpolation) {
    const double step = wavelength / faces.front().pitch;
    const auto n = static_cast<std::ptrdiff_t>(samples);
    const std::ptrdiff_t max_x = (n - 1) / 2;
    HemicubeResampling result;
    const std::ptrdiff_t max_y = line ? 0 : max_x;
    for (std::ptrdiff_t jy = -max_y; jy <= max_y; ++jy)
        for (std::ptrdiff_t jx = -max_x; jx <= max_x; ++jx) {
            const double sx = -step * static_cast<double>(jx), sy = -step * static_cast<double>(jy);
            const double cos2 = 1 - sx * sx - sy * sy;
            if (cos2 <= 0) continue;
            const Vec3 middle{sx, sy, std::sqrt(cos2)};
            double rays = 1;
            for (const LightFieldGrid& face : faces)
                if (face.covers(middle)) rays = std::max(rays, width_in_rays(face, middle, step, line));
            const auto points = static_cast<int>(std::min(max_points, std::ceil(2 * rays)));
            const int count = line ? points : points * points;
            std::map<std::uint32_t, double> sum;
            for (int p = 0; p < count; ++p) {
                const int across = p % points, down = p / points;
                const double x = sx + step * ((across + 0.5) / points - 0.5);
                const double y = line ? 0 : sy + step * ((down + 0.5) / points - 0.5);
                if (x * x + y * y >= 1) continue;
                const Vec3 direction{x, y, std::sqrt(1 - x * x - y * y)};
                std::size_t first = 0;
                for (const LightFieldGrid& face : faces) {
                    if (face.covers(direction)) {
                        add_rays(face, first, direction, interpolation, 1.0 / count, sum);
                        break;
                    }
                    first += face.directions();
                }
            }
            if (sum.empty()) continue;
            // DFT rows run downwards, y upwards: the row is −j_y.
            const auto row = static_cast<std::size_t>(line ? 0 : (n - jy) % n),
                       column = static_cast<std::size_t>((n + jx) % n);
            result.lobes.push_back(
                {static_cast<std::uint32_t>(row * samples + column), static_cast<std::uint32_t>(result.rays.size()),
                 static_cast<std::uint32_t>(sum.size()), static_cast<float>(step * step_y / middle.z)});
            for (const auto& [ray, weight] : sum) {
                result.rays.push_back(ray);
                result.weights.push_back(static_cast<float>(weight));
            }
        }
    return result;
}

void average_scattered(const HemicubeResampling& lobes, std::size_t first, std::size_t count,
                       View<const float, 2> values, bool of_roots, float* out) {
    const std::size_t hogels = values.extent(1);
    for (const HemicubeResampling::Lobe& lobe : std::span(lobes.lobes).subspan(first, count)) {
        std::fill_n(out, hogels, 0.0f);
        for (std::uint32_t i = lobe.first; i < lobe.first + lobe.count; ++i) {
            const float* from = &values(lobes.rays[i], 0);
            for (std::size_t h = 0; h < hogels; ++h) out[h] += lobes.weights[i] * from[h];
        }
        for (std::size_t h = 0; h < hogels; ++h)
            out[h] = of_roots ? out[h] * std::sqrt(lobe.scale) : std::sqrt(std::max(out[h], 0.0f) * lobe.scale);
        out += hogels;
    }
}

}  // namespace hogel::stereogram
