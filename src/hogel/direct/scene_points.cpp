// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "hogel/core/part.h"
#include "hogel/core/random.h"
#include "hogel/core/stop_scope.h"
#include "hogel/direct/scene_points.h"
#include "hogel/error.h"
#include "hogel/shading/triangles.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"
#include "hogel/work/steps.h"

namespace hogel::direct {
namespace {

float channel_of(Rgb colour, std::size_t channel) {
    return channel == 0 ? colour.r : channel == 1 ? colour.g : colour.b;
}

Vec3 away_from_plane(Vec3 point, double depth) {
    if (std::abs(point.z) < depth) point.z = std::copysign(depth, point.z);
    return point;
}

std::array<Vec3, 3> corners(const ShadedScene& scene, const ShadedScene::Triangle& triangle) {
    return {scene.positions[triangle.vertices[0]], scene.positions[triangle.vertices[1]],
            scene.positions[triangle.vertices[2]]};
}

constexpr double max_points = 1e8;  // of 88 bytes each

[[noreturn]] void throw_too_many(double points, double spacing, double sufficient) {
    throw Error(ErrorCode::usage, "spacing",
                fmt::format("a spacing of {} makes {:.2g} points; expected at most {:.2g}, "
                            "that is a spacing of at least {}",
                            format_length(spacing), points, max_points, format_length(sufficient)));
}

double parts_of(double length, double spacing) { return std::max(1.0, std::ceil(length / spacing)); }

// Throws Error(usage) if surface_points() would make more than max_points.
void require_few_points(const ShadedScene& scene, double spacing) {
    double count = 0;
    for (const ShadedScene::Triangle& triangle : scene.triangles) {
        const auto [a, b, c] = corners(scene, triangle);
        const double parts = parts_of(std::max({length(b - a), length(c - b), length(a - c)}), spacing);
        count += parts * parts;
    }
    if (count > max_points) throw_too_many(count, spacing, spacing * std::sqrt(count / max_points));
}

constexpr double crease_cosine = 0.8660254037844387;

}  // namespace

double nearest_depth(const FieldGrid& grid) { return 8 * grid.plane.pitch_x * grid.plane.pitch_y / grid.wavelength; }

double random_cycles(const SceneHologramOptions& options, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return core::philox({a, b, c, static_cast<std::uint32_t>(options.channel)},
                        {static_cast<std::uint32_t>(options.seed), static_cast<std::uint32_t>(options.seed >> 32)})[0] /
           4294967296.0;
}

std::vector<ScenePoint> surface_points(const ShadedScene& scene, const FieldGrid& grid,
                                       const SceneHologramOptions& options) {
    require_few_points(scene, options.spacing);
    std::vector<ScenePoint> points;
    const ViewSample view_sample{{0, 0, 1}, options.spacing};
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const auto [a, b, c] = corners(scene, scene.triangles[i]);
        const Vec3 across = cross(b - a, c - a);
        const double area = 0.5 * length(across);
        if (!(area > 0)) continue;
        // Cuts the triangle into n² triangles of the same shape, each with a point in its middle.
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        const auto n = static_cast<std::uint32_t>(parts_of(longest, options.spacing));
        const double cut = n;
        for (std::uint32_t row = 0; row < n; ++row) {
            core::throw_if_stopped();
            for (std::uint32_t column = 0; column < 2 * (n - row) - 1; ++column) {
                // Triangles of even columns stand upright, the others upside down.
                const double third = column % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
                const std::uint32_t pair = column / 2;
                const double u = (pair + third) / cut, v = (row + third) / cut;
                const float radiance =
                    channel_of(radiance_at(scene, i, static_cast<float>(1 - u - v), static_cast<float>(u),
                                           static_cast<float>(v), view_sample),
                               options.channel);
                if (!(radiance > 0)) continue;
                const Vec3 position = a + u * (b - a) + v * (c - a);
                points.push_back({away_from_plane(position, nearest_depth(grid)), position, across / (2 * area),
                                  static_cast<float>(std::sqrt(radiance * area)) / float(n),
                                  random_cycles(options, static_cast<std::uint32_t>(i), row, column)});
            }
        }
    }
    return points;
}

std::vector<SceneEdge> scene_edges(const ShadedScene& scene, const SceneHologramOptions& options) {
    // Vertices of different triangles may coincide: maps each position to one index.
    std::map<std::tuple<double, double, double>, std::uint32_t> indices;
    const auto index_of = [&](Vec3 p) {
        return indices.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(indices.size())).first->second;
    };
    struct Side {
        std::size_t triangle;
        int edge;
        Vec3 normal;
        bool smooth;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Side> sides;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::array<Vec3, 3> p = corners(scene, scene.triangles[i]);
        const Vec3 across = cross(p[1] - p[0], p[2] - p[0]);
        if (!(length(across) > 0)) continue;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = index_of(p[k]), to = index_of(p[(k + 1) % 3]);
            const auto [entry, inserted] =
                sides.try_emplace(std::minmax(from, to), Side{i, k, normalize(across), false});
            if (inserted) continue;
            entry->second.smooth = std::abs(dot(entry->second.normal, normalize(across))) > crease_cosine &&
                                   scene.triangles[entry->second.triangle].mesh == scene.triangles[i].mesh;
        }
    }
    std::vector<SceneEdge> edges;
    for (const auto& [key, side] : sides) {
        if (side.smooth) continue;
        const std::array<Vec3, 3> p = corners(scene, scene.triangles[side.triangle]);
        std::array<float, 3> weights{0.5f, 0.5f, 0.5f};
        weights[static_cast<std::size_t>(side.edge + 2) % 3] = 0;
        const Rgb colour = radiance_at(scene, side.triangle, weights[0], weights[1], weights[2]);
        edges.push_back({p[side.edge], p[(side.edge + 1) % 3], channel_of(colour, options.channel)});
    }
    return edges;
}

std::vector<ScenePoint> edge_points(const ShadedScene& scene, const FieldGrid& grid,
                                    const SceneHologramOptions& options) {
    std::vector<ScenePoint> points;
    std::uint32_t point_index = 0;
    const std::vector<SceneEdge> edges = scene_edges(scene, options);
    double count = 0;
    for (const SceneEdge& edge : edges) count += parts_of(length(edge.b - edge.a), options.spacing);
    if (count > max_points) throw_too_many(count, options.spacing, options.spacing * count / max_points);
    for (const SceneEdge& edge : edges) {
        core::throw_if_stopped();
        const double along = length(edge.b - edge.a), steps = std::max(1.0, std::round(along / options.spacing));
        for (double i = 0; i < steps; ++i) {
            const Vec3 position = edge.a + (i + 0.5) / steps * (edge.b - edge.a);
            const double area = along / steps * options.spacing;
            points.push_back({away_from_plane(position, nearest_depth(grid)),
                              position,
                              {},
                              static_cast<float>(std::sqrt(edge.radiance * area)),
                              random_cycles(options, point_index++, 0, 0xffffffff)});
        }
    }
    return points;
}

double modulus(const ScenePoint& point, const Passage& passage) {
    const double cosine = point.normal == Vec3{} ? 1 : std::abs(dot(point.normal, passage.direction));
    return point.amplitude * std::sqrt(cosine) / std::abs(passage.path);
}

Visibility::Visibility(const ShadedScene& scene) {
    core::require_part("Embree", "occlusion between points");
    caster_ = shading::all_triangles(scene);
    Vec3 low, high;
    for (const Vec3& p : scene.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double size = length(high - low);
    margin_ = 1e-4 * size;
    far_ = 1e3 * size;
}

Field sum_over_tiles(const FieldGrid& grid, const Progress& progress,
                     const std::function<void(const Region&, View<std::complex<float>, 2>)>& add) {
    constexpr std::size_t side = tile_side;
    validate(grid, ErrorCode::usage, "hologram");
    Field field(grid);
    const std::size_t across = (grid.plane.width + side - 1) / side, down = (grid.plane.height + side - 1) / side;
    progress.report(0);
    work::Steps steps(progress, across * down);
    work::parallel_for(across * down, [&](std::size_t i) {
        Region region{i % across * side, i / across * side, side, side};
        region.width = std::min(side, grid.plane.width - region.x0);
        region.height = std::min(side, grid.plane.height - region.y0);
        Array<std::complex<float>, 2> values({region.height, region.width});
        add(region, values);
        field.write(region, values);
        steps.report_one();
    });
    return field;
}

Field sum_over_samples(const FieldGrid& grid, const Progress& progress,
                       const std::function<std::complex<double>(Vec3 position)>& wave) {
    return sum_over_tiles(grid, progress, [&](const Region& region, View<std::complex<float>, 2> values) {
        for (std::size_t row = 0; row < region.height; ++row)
            for (std::size_t column = 0; column < region.width; ++column) {
                core::throw_if_stopped();
                values(row, column) =
                    std::complex<float>(wave({grid.plane.x(static_cast<double>(region.x0 + column)),
                                              grid.plane.y(static_cast<double>(region.y0 + row)), 0}));
            }
    });
}

}  // namespace hogel::direct
