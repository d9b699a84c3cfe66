// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "hogel/core/stop_scope.h"
#include "hogel/direct/onward.h"
#include "hogel/direct/scene_points.h"
#include "hogel/optics/tilt.h"
#include "hogel/work/parallel.h"

namespace hogel::direct {
namespace {

// Polygons with a smaller cosine between normal and axis count as edge-on and are invisible.
constexpr double min_cosine = 0.02;

// The triangles of one mesh that lie in one plane.
struct Polygon {
    std::vector<std::size_t> triangles;
    Vec3 normal;  // towards the viewer
    Vec3 middle;
};

std::vector<Polygon> polygons_of(const ShadedScene& scene) {
    double size = 0;
    for (const Vec3& p : scene.positions) size = std::max(size, length(p));
    std::map<std::tuple<std::uint32_t, long, long, long>, Polygon> by_plane;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const ShadedScene::Triangle& triangle = scene.triangles[i];
        const Vec3 a = scene.positions[triangle.vertices[0]], b = scene.positions[triangle.vertices[1]],
                   c = scene.positions[triangle.vertices[2]];
        const Vec3 across = cross(b - a, c - a);
        if (!(length(across) > 0)) continue;
        const Vec3 normal = std::copysign(1 / length(across), across.z) * across;
        if (normal.z < min_cosine) continue;
        const auto step = [](double x) { return std::lround(1e4 * x); };
        Polygon& polygon = by_plane[{triangle.mesh, step(normal.x), step(normal.y), step(dot(normal, a) / size)}];
        polygon.triangles.push_back(i);
        polygon.normal = normal;
        polygon.middle += (a + b + c) / 3;
    }
    std::vector<Polygon> polygons;
    for (auto& [key, polygon] : by_plane) {
        polygon.middle = polygon.middle / static_cast<double>(polygon.triangles.size());
        polygons.push_back(std::move(polygon));
    }
    std::ranges::stable_sort(polygons, {}, [](const Polygon& polygon) { return polygon.middle.z; });  // farthest first
    return polygons;
}

// Calls paint(column, row, b0, b1, b2) for the grid samples inside a triangle, with barycentric coordinates b.
void for_samples_inside(const std::array<Vec3, 3>& p, const Grid& grid,
                        const std::function<void(std::size_t, std::size_t, float, float, float)>& paint) {
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (area == 0) return;
    const auto range = [](double low, double high, std::size_t count) {
        return std::pair{static_cast<std::size_t>(std::clamp(std::ceil(low), 0.0, static_cast<double>(count))),
                         static_cast<std::size_t>(std::clamp(std::floor(high) + 1, 0.0, static_cast<double>(count)))};
    };
    const auto [x0, x1] = range(grid.column(std::min({p[0].x, p[1].x, p[2].x})),
                                grid.column(std::max({p[0].x, p[1].x, p[2].x})), grid.width);
    const auto [y0, y1] =
        range(grid.row(std::max({p[0].y, p[1].y, p[2].y})), grid.row(std::min({p[0].y, p[1].y, p[2].y})), grid.height);
    for (std::size_t row = y0; row < y1; ++row)
        for (std::size_t column = x0; column < x1; ++column) {
            const double x = grid.x(static_cast<double>(column)), y = grid.y(static_cast<double>(row));
            const auto weight = [&](std::size_t i) {
                const Vec3 &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
                return ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
            };
            const double b0 = weight(0), b1 = weight(1), b2 = weight(2);
            if (b0 < 0 || b1 < 0 || b2 < 0) continue;
            paint(column, row, static_cast<float>(b0), static_cast<float>(b1), static_cast<float>(b2));
        }
}

// Turns the waves of random samples, of equal spectral density in all directions, into those of a diffuse surface:
// Lλ²/cos θ, θ to the plane's normal (docs/notation.md, section 3).
void weigh_as_diffuse(optics::Spectrum& waves) {
    work::parallel_for(waves.height(), [&](std::size_t row) {
        const double sine_y = waves.wavelength * waves.frequency_y(static_cast<double>(row));
        for (std::size_t column = 0; column < waves.width(); ++column) {
            const double sine_x = waves.wavelength * waves.frequency_x(static_cast<double>(column));
            const double cosine = std::sqrt(std::max(0.0, 1 - sine_x * sine_x - sine_y * sine_y));
            waves.samples.view()(row, column) *= static_cast<float>(1 / std::sqrt(std::max(cosine, min_cosine)));
        }
    });
}

// Field of a polygon on planes parallel to the hologram. The surface, with random phases, is sampled on the polygon's
// plane. Its plane waves are rotated to the hologram's axes and propagated to the requested plane. Sources: Leseberg
// and Frère, "Computer-generated holograms of 3-D objects composed of tilted planar segments", Applied Optics 27, 1988;
// for any distance Tommasi and Bianco, JOSA A 10, 1993; [K] 6.1.
class PolygonLight {
  public:
    PolygonLight(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options)
        : scene_(scene), grid_(grid), options_(options) {}

    // Adds the polygon's light to a field at z = −depth.
    void add(const Polygon& polygon, double depth, Field& field) const {
        const Grid& plane = grid_.plane;
        const double size_x = plane.size_x() + 2 * std::abs(polygon.middle.x - plane.center_x),
                     size_y = plane.size_y() + 2 * std::abs(polygon.middle.y - plane.center_y);
        Grid window = optics::padded(plane, 2.5 * size_x - plane.size_x(), 2.5 * size_y - plane.size_y());
        // Aligns the polygon's origin with the samples of the field.
        const auto aligned = [](double from, double to, double pitch, std::size_t a, std::size_t b) {
            const double half = (a + b) % 2 == 0 ? 0 : 0.5;
            return from + pitch * (std::round((to - from) / pitch - half) + half);
        };
        Vec3 origin{aligned(plane.center_x, polygon.middle.x, plane.pitch_x, plane.width, window.width),
                    aligned(plane.center_y, polygon.middle.y, plane.pitch_y, plane.height, window.height), 0};
        const Vec3& n = polygon.normal;
        origin.z = (dot(n, polygon.middle) - n.x * origin.x - n.y * origin.y) / n.z;
        window.center_x = origin.x;
        window.center_y = origin.y;

        // Axes of the polygon's plane, with x as horizontal as possible.
        const Vec3 x = normalize(Vec3{1, 0, 0} - n.x * n), y = cross(n, x);
        const optics::Wave surface = paint(polygon, origin, x, y);
        const Grid& surface_plane = surface.grid().plane;
        const optics::Band band{
            surface.carrier_x - 0.5 / surface_plane.pitch_x, surface.carrier_x + 0.5 / surface_plane.pitch_x,
            surface.carrier_y - 0.5 / surface_plane.pitch_y, surface.carrier_y + 0.5 / surface_plane.pitch_y};
        optics::Spectrum surface_waves = optics::spectrum_of(
            surface, optics::padded(surface_plane, surface_plane.size_x(), surface_plane.size_y()), band, in_memory_);
        weigh_as_diffuse(surface_waves);
        optics::Spectrum waves = optics::tilt(surface_waves, {{x.x, y.x, n.x}, {x.y, y.y, n.y}}, window,
                                              optics::Band::of(plane), in_memory_);
        waves.window.center_x = origin.x;
        waves.window.center_y = origin.y;
        optics::propagate(waves, {-depth - origin.z, 0, 0, size_x, size_y, 0.5 * size_x, 0.5 * size_y});
        const optics::Wave light = optics::wave_of(waves, waves.window.width, waves.window.height, in_memory_);
        const auto first = [](double position) { return static_cast<std::size_t>(std::lround(position)); };
        Array<std::complex<float>, 2> values({plane.height, plane.width});
        light.read(
            {first(waves.window.column(plane.x(0))), first(waves.window.row(plane.y(0))), plane.width, plane.height}, 0,
            values);
        for (std::size_t i = 0; i < values.size(); ++i) field.samples.data()[i] += values.data()[i];
    }

    // Sets a field on the polygon's middle plane to zero where the polygon covers it.
    void hide(const Polygon& polygon, Field& field) const {
        for (const std::size_t triangle : polygon.triangles)
            for_samples_inside(
                corners(triangle), grid_.plane,
                [&](std::size_t column, std::size_t row, float, float, float) { field.samples(row, column) = 0; });
    }

  private:
    std::array<Vec3, 3> corners(std::size_t triangle) const {
        const auto& vertices = scene_.triangles[triangle].vertices;
        return {scene_.positions[vertices[0]], scene_.positions[vertices[1]], scene_.positions[vertices[2]]};
    }

    optics::Wave paint(const Polygon& polygon, Vec3 origin, Vec3 x, Vec3 y) const {
        const auto local = [&](Vec3 p) { return Vec3{dot(p - origin, x), dot(p - origin, y), 0}; };
        double half_x = 0, half_y = 0;
        for (const std::size_t triangle : polygon.triangles)
            for (const Vec3& p : corners(triangle)) {
                half_x = std::max(half_x, std::abs(local(p).x));
                half_y = std::max(half_y, std::abs(local(p).y));
            }
        const double pitch_x = grid_.plane.pitch_x, pitch_y = grid_.plane.pitch_y;
        const auto samples = [](double half, double pitch) {
            return 2 * static_cast<std::size_t>(std::ceil(half / pitch)) + 2;
        };
        const FieldGrid surface_grid{{samples(half_x, pitch_x), samples(half_y, pitch_y), pitch_x, pitch_y, 0, 0},
                                     grid_.wavelength};
        optics::Wave surface(surface_grid, in_memory_);
        // The carrier selects waves that travel towards the viewer.
        surface.carrier_x = x.z / grid_.wavelength;
        surface.carrier_y = y.z / grid_.wavelength;
        const double scale = grid_.wavelength / std::sqrt(pitch_x * pitch_y);
        const auto polygon_key = static_cast<std::uint32_t>(polygon.triangles.front());
        for (const std::size_t triangle : polygon.triangles) {
            std::array<Vec3, 3> p = corners(triangle);
            for (Vec3& corner : p) corner = local(corner);
            for_samples_inside(
                p, surface_grid.plane, [&](std::size_t column, std::size_t row, float b0, float b1, float b2) {
                    const Rgb colour = radiance_at(scene_, triangle, b0, b1, b2, {{0, 0, 1}, pitch_x});
                    const float radiance = options_.channel == 0   ? colour.r
                                           : options_.channel == 1 ? colour.g
                                                                   : colour.b;
                    const double cycles = random_cycles(options_, static_cast<std::uint32_t>(column),
                                                        static_cast<std::uint32_t>(row), polygon_key ^ 0x80000000);
                    surface.samples.view()(row, column) = std::complex<float>(
                        std::polar(scale * std::sqrt(std::max(radiance, 0.0f)), 2 * std::numbers::pi * cycles));
                });
        }
        return surface;
    }

    const ShadedScene& scene_;
    FieldGrid grid_;
    SceneHologramOptions options_;
    ScratchOptions in_memory_{SIZE_MAX, {}};
};

}  // namespace

Field tilted_polygons(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                      const Progress& progress) {
    const core::StopScope scope(progress);
    validate(grid, ErrorCode::usage, "hologram");
    Field field(grid);
    const PolygonLight light(scene, grid, options);
    const std::vector<Polygon> polygons = polygons_of(scene);
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        progress.report(static_cast<double>(i) / static_cast<double>(polygons.size()));
        light.add(polygons[i], 0, field);
    }
    progress.report(1);
    return field;
}

// Back to front: each polygon, drawn on a plane through its middle, blocks the light of those behind it.
Field occluding_polygons(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                         const Progress& progress) {
    const core::StopScope scope(progress);
    validate(grid, ErrorCode::usage, "hologram");
    Field field(grid);
    const PolygonLight light(scene, grid, options);
    const std::vector<Polygon> polygons = polygons_of(scene);
    double depth = 0;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        progress.report(static_cast<double>(i) / static_cast<double>(polygons.size()));
        const double polygon_depth = -polygons[i].middle.z;
        if (i > 0 && polygon_depth != depth) field = onward(field, depth - polygon_depth);
        depth = polygon_depth;
        light.hide(polygons[i], field);
        light.add(polygons[i], depth, field);
    }
    if (!polygons.empty()) field = onward(field, depth);
    progress.report(1);
    return field;
}

}  // namespace hogel::direct
