// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/tessellate.h"

#include <fmt/format.h>

#include <limits>
#include <unordered_map>

#include "hogel/error.h"

namespace hogel::scene {
namespace {

using Index = std::uint32_t;

TextureCoordinate weighted_sum(TextureCoordinate a, TextureCoordinate b, TextureCoordinate c, float wa, float wb,
                               float wc) {
    return {wa * a.u + wb * b.u + wc * c.u, wa * a.v + wb * b.v + wc * c.v};
}
Rgb weighted_sum(Rgb a, Rgb b, Rgb c, float wa, float wb, float wc) { return wa * a + wb * b + wc * c; }

float weighted_sum(float a, float b, float c, float wa, float wb, float wc) { return wa * a + wb * b + wc * c; }

/// Subdivides the triangles of a mesh. Vertices keep their indices; new ones are appended.
class Cutter {
  public:
    Cutter(const Mesh& mesh, std::size_t n) : source_(mesh), n_(n) {
        result_ = mesh;
        result_.triangles.clear();
    }

    Mesh cut() {
        std::vector<Index> grid((n_ + 1) * (n_ + 1));
        for (const auto& triangle : source_.triangles) {
            for (std::size_t j = 0; j <= n_; ++j)
                for (std::size_t i = 0; i + j <= n_; ++i) grid[j * (n_ + 1) + i] = vertex(triangle, i, j);
            const auto grid_vertex = [&](std::size_t i, std::size_t j) { return grid[j * (n_ + 1) + i]; };
            for (std::size_t j = 0; j < n_; ++j)
                for (std::size_t i = 0; i + j < n_; ++i) {
                    result_.triangles.push_back({grid_vertex(i, j), grid_vertex(i + 1, j), grid_vertex(i, j + 1)});
                    if (i + j + 1 < n_)
                        result_.triangles.push_back(
                            {grid_vertex(i + 1, j), grid_vertex(i + 1, j + 1), grid_vertex(i, j + 1)});
                }
        }
        return std::move(result_);
    }

  private:
    /// Returns the vertex i steps from the first corner towards the second and j steps towards the third.
    Index vertex(const std::array<Index, 3>& corners, std::size_t i, std::size_t j) {
        const std::size_t k = n_ - i - j;
        const auto& [a, b, c] = corners;
        if (k == n_) return a;
        if (i == n_) return b;
        if (j == n_) return c;
        if (j == 0) return on_edge(a, b, i);
        if (k == 0) return on_edge(b, c, j);
        if (i == 0) return on_edge(c, a, k);
        return add(a, b, c, k, i, j);
    }

    /// Returns the vertex `step` steps from a to b. Created once for both triangles, from the lower-numbered end.
    Index on_edge(Index a, Index b, std::size_t step) {
        if (a > b) return on_edge(b, a, n_ - step);
        const auto [known, is_new] = edges_.try_emplace(std::uint64_t{a} << 32 | b, Index{0});
        if (is_new) {
            known->second = static_cast<Index>(result_.positions.size());
            for (std::size_t i = 1; i < n_; ++i) add(a, b, b, n_ - i, i, 0);
        }
        return known->second + static_cast<Index>(step - 1);
    }

    Index add(Index a, Index b, Index c, std::size_t na, std::size_t nb, std::size_t nc) {
        const auto part = [this](std::size_t count) { return static_cast<double>(count) / static_cast<double>(n_); };
        const auto wa = static_cast<float>(part(na)), wb = static_cast<float>(part(nb)),
                   wc = static_cast<float>(part(nc));
        const auto append = [&](auto& values, const auto& old) {
            if (!values.empty()) values.push_back(weighted_sum(old[a], old[b], old[c], wa, wb, wc));
        };
        const auto sum = [&](const std::vector<Vec3>& p) {
            return part(na) * p[a] + part(nb) * p[b] + part(nc) * p[c];
        };
        result_.positions.push_back(sum(source_.positions));
        if (!source_.normals.empty()) {
            const Vec3 normal = sum(source_.normals);
            const double size = length(normal);
            result_.normals.push_back(size > 0 ? normal / size : source_.normals[a]);
        }
        append(result_.colors, source_.colors);
        append(result_.radiance, source_.radiance);
        append(result_.alphas, source_.alphas);
        append(result_.texture_coordinates, source_.texture_coordinates);
        append(result_.emission_coordinates, source_.emission_coordinates);
        append(result_.metallic_roughness_coordinates, source_.metallic_roughness_coordinates);
        append(result_.normal_coordinates, source_.normal_coordinates);
        append(result_.occlusion_coordinates, source_.occlusion_coordinates);
        if (result_.positions.size() > std::numeric_limits<Index>::max())
            throw Error(ErrorCode::usage, "tessellate",
                        fmt::format("mesh '{}' with triangles cut {} times along an edge: more than 2^32 vertices",
                                    source_.name, n_));
        return static_cast<Index>(result_.positions.size() - 1);
    }

    const Mesh& source_;
    std::size_t n_;
    Mesh result_;
    std::unordered_map<std::uint64_t, Index> edges_;  // key: both ends; value: the first of n − 1 vertices
};

}  // namespace

Scene tessellate(const Scene& scene, std::size_t n) {
    if (n == 0)
        throw Error(ErrorCode::usage, "tessellate",
                    "triangles cannot be cut into 0 parts; expected 1 or more along an edge");
    Scene fine = scene;
    if (n == 1) return fine;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) fine.meshes[i] = Cutter(scene.meshes[i], n).cut();
    return fine;
}

}  // namespace hogel::scene
