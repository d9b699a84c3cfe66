// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/shadow_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hogel/work/parallel.h"
#include "hogel/work/steps.h"

namespace hogel::shading {
namespace {

constexpr std::size_t cube_faces = 6;

double component(Vec3 p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Returns a direction through a face of the cube: 1 along the face's axis, b and c along the next two axes.
Vec3 on_face(std::size_t face, double b, double c) {
    std::array<double, 3> p{};
    const std::size_t axis = face / 2;
    p[axis] = face % 2 == 0 ? 1 : -1, p[(axis + 1) % 3] = b, p[(axis + 2) % 3] = c;
    return {p[0], p[1], p[2]};
}

}  // namespace

ShadowMap::ShadowMap(const Light& light, const Bounds& scene, std::size_t n, std::vector<float> memory)
    : point_light_(light.kind == Light::Kind::point),
      faces_(point_light_ ? cube_faces : 1),
      side_(point_light_ ? n : 2 * n),
      depth_(std::move(memory)) {
    const double inf = std::numeric_limits<double>::infinity();
    if (!light.casts_shadows) {
        faces_ = side_ = 0;
    } else if (point_light_) {
        origin_ = light.position;
        const Vec3 middle = 0.5 * scene.low + 0.5 * scene.high;
        far_ = 2 * (length(origin_ - middle) + length(scene.high - scene.low));
    } else {
        forward_ = normalize(light.direction);
        right_ = normalize(cross(std::abs(forward_.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, forward_));
        up_ = cross(forward_, right_);
        Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};  // the scene's box in this frame
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 p{corner & 1 ? scene.high.x : scene.low.x, corner & 2 ? scene.high.y : scene.low.y,
                         corner & 4 ? scene.high.z : scene.low.z};
            const Vec3 q{dot(p, right_), dot(p, up_), dot(p, forward_)};
            low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
            high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
        }
        const double across = std::max({high.x - low.x, high.y - low.y, std::numeric_limits<double>::min()});
        width_ = across / static_cast<double>(side_);
        const double margin = 0.01 * (high.z - low.z) + width_;
        origin_ = low.x * right_ + low.y * up_ + (low.z - margin) * forward_;
        far_ = high.z - low.z + 2 * margin;
    }
    depth_.assign(faces_ * side_ * side_, std::numeric_limits<float>::infinity());
}

double ShadowMap::bytes(const Light& light, std::size_t n) {
    if (!light.casts_shadows) return 0;
    const double texels = static_cast<double>(n) * static_cast<double>(n);
    return (light.kind == Light::Kind::point ? cube_faces : 4) * texels * sizeof(float);
}

void ShadowMap::fill(const trace::RayCaster& caster, std::size_t row) {
    const std::size_t face = row / side_;
    const double y = static_cast<double>(row % side_) + 0.5, n = static_cast<double>(side_);
    std::vector<Vec3> origins(side_), directions(side_);
    std::vector<trace::RayHit> hits(side_);
    for (std::size_t i = 0; i < side_; ++i) {
        const double x = static_cast<double>(i) + 0.5;
        origins[i] = point_light_ ? origin_ : origin_ + x * width_ * right_ + y * width_ * up_;
        directions[i] = point_light_ ? on_face(face, 2 * x / n - 1, 2 * y / n - 1) : forward_;
    }
    caster.closest(origins, directions, far_, hits);
    float* out = depth_.data() + row * side_;
    for (std::size_t i = 0; i < side_; ++i)
        if (hits[i].triangle != trace::RayHit::miss) out[i] = static_cast<float>(hits[i].distance);
}

ShadowMap::Projected ShadowMap::project(Vec3 point) const {
    const Vec3 from = point - origin_;
    if (!point_light_) return {0, dot(from, right_) / width_ - 0.5, dot(from, up_) / width_ - 0.5, dot(from, forward_)};
    const std::array<double, 3> size{std::abs(from.x), std::abs(from.y), std::abs(from.z)};
    const auto axis = static_cast<std::size_t>(std::ranges::max_element(size) - size.begin());
    const double depth = size[axis], half = 0.5 * static_cast<double>(side_);
    const auto texel = [&](std::size_t other) { return (component(from, other) / depth + 1) * half - 0.5; };
    return {2 * axis + (component(from, axis) < 0 ? 1 : 0), texel((axis + 1) % 3), texel((axis + 2) % 3), depth};
}

float ShadowMap::visibility(Vec3 point, Vec3 normal) const {
    if (depth_.empty()) return 1;
    const Projected projected = project(point);
    if (!(projected.depth > 0)) return 1;
    // Width of a texel at the point's depth, and height of the tangent plane above the light.
    const double width = point_light_ ? 2 * projected.depth / static_cast<double>(side_) : width_;
    const double limit = projected.depth + max_slope * width;
    const double height = dot(normal, point - origin_);
    const double last = static_cast<double>(side_) - 1, per_side = 1 / static_cast<double>(side_);
    const double column = std::floor(projected.column), row = std::floor(projected.row);
    const std::array columns{std::clamp(column, 0.0, last), std::clamp(column + 1, 0.0, last)};
    const std::array rows{std::clamp(row, 0.0, last), std::clamp(row + 1, 0.0, last)};
    // A texel's ray meets the tangent plane at (height − start)/fall, each a sum of a column term and a row term.
    const std::size_t axis = projected.face / 2;
    const double fall =
        point_light_ ? (projected.face % 2 == 0 ? 1 : -1) * component(normal, axis) : dot(normal, forward_);
    const double along_columns = point_light_ ? component(normal, (axis + 1) % 3) : width_ * dot(normal, right_);
    const double along_rows = point_light_ ? component(normal, (axis + 2) % 3) : width_ * dot(normal, up_);
    const auto coordinate = [&](double texel) { return point_light_ ? (2 * texel + 1) * per_side - 1 : texel + 0.5; };
    const std::array of_columns{along_columns * coordinate(columns[0]), along_columns * coordinate(columns[1])};
    const std::array of_rows{along_rows * coordinate(rows[0]), along_rows * coordinate(rows[1])};
    const auto compare = [&](std::size_t i, std::size_t j) {
        const double added = of_columns[i] + of_rows[j];
        const double f = point_light_ ? fall + added : fall, h = point_light_ ? height : height - added;
        // Rays of a point light meet nothing behind it.
        const bool meets = point_light_ ? f * h > 0 : f != 0;
        const double plane = meets ? h / f : limit;
        const std::size_t index =
            (projected.face * side_ + static_cast<std::size_t>(rows[j])) * side_ + static_cast<std::size_t>(columns[i]);
        return static_cast<double>(depth_[index]) >= std::min(plane, limit) - bias * width ? 1.0f : 0.0f;
    };
    const auto x = static_cast<float>(projected.column - column), y = static_cast<float>(projected.row - row);
    const float a = compare(0, 0), b = compare(1, 0), c = compare(0, 1), d = compare(1, 1);
    const float low = a + x * (b - a), high = c + x * (d - c);
    return low + y * (high - low);
}

std::vector<ShadowMap> make_shadow_maps(const Scene& scene, const trace::RayCaster& caster, std::size_t n,
                                        std::vector<ShadowMap> memory, const Progress& progress) {
    const Bounds box = bounds(scene);
    std::vector<ShadowMap> maps;
    std::vector<std::pair<std::size_t, std::size_t>> map_rows;  // light, row
    for (const Light& light : scene.lights) {
        maps.emplace_back(light, box, n,
                          maps.size() < memory.size() ? memory[maps.size()].release() : std::vector<float>());
        for (std::size_t row = 0; row < maps.back().rows(); ++row) map_rows.emplace_back(maps.size() - 1, row);
    }
    constexpr std::size_t rows_per_task = 64;
    const std::size_t tasks = (map_rows.size() + rows_per_task - 1) / rows_per_task;
    work::Steps steps(progress, tasks);
    work::parallel_for(tasks, [&](std::size_t task) {
        for (std::size_t i = task * rows_per_task; i < std::min(map_rows.size(), (task + 1) * rows_per_task); ++i)
            maps[map_rows[i].first].fill(caster, map_rows[i].second);
        steps.report_one();
    });
    return maps;
}

}  // namespace hogel::shading
