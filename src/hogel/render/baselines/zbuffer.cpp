// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "hogel/core/parallel.h"
#include "hogel/render/baselines/zbuffer.h"
#include "hogel/render/sample_store.h"

namespace hogel::render::baselines {
namespace {

// A linear function of the direction: value(U, V) = c + u U + v V.
struct LinearInDirection {
    double c = 0, u = 0, v = 0;

    double operator()(double U, double V) const { return c + (u * U + v * V); }
};

// A vertex seen from a hogel: its position relative to the hogel's centre, and its position in the hogel's picture.
struct SeenVertex {
    double x, y, depth;  // x − s, y − t, ζ; on a side of a hemicube right, up and forward in its picture
    double k, l;         // column and row of the picture, unless ζ is too close to zero
};

// The edge function of docs/notation.md section 2 for a ray through the origin of the hogel's frame:
// E = U (dζ A_y − dy A_ζ) + V (dx A_ζ − dζ A_x) + dy A_x − dx A_y.
LinearInDirection edge_from_to(const SeenVertex& a, const SeenVertex& b) {
    const double dx = b.x - a.x, dy = b.y - a.y, dz = b.depth - a.depth;
    return {dy * a.x - dx * a.y, dz * a.y - dy * a.depth, dx * a.depth - dz * a.x};
}

struct Edge {
    LinearInDirection function;
    bool forward;  // whether the edge runs from its smaller to its larger end
};

// Two triangles that share an edge traverse it in opposite directions. Both compute it from the same end, so that their
// values are exact negatives of each other and no sample falls between them or into both.
Edge edge(const SeenVertex& a, const SeenVertex& b) {
    const bool forward = std::tie(a.x, a.y, a.depth) < std::tie(b.x, b.y, b.depth);
    if (forward) return {edge_from_to(a, b), true};
    const LinearInDirection reverse = edge_from_to(b, a);
    return {{-reverse.c, -reverse.u, -reverse.v}, false};
}

class ZbufferRenderer final : public Renderer {
  public:
    ZbufferRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) : grid_(grid) {
        ZbufferRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        scene_ = std::move(scene);
        double size = 0;
        for (const Vec3& p : scene_->positions) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        min_depth_ = 1e-6 * size;
    }

    void read(LightFieldTile& tile) const override {
        std::vector<SeenVertex> vertices(scene_->positions.size());
        std::vector<VisiblePoint> picture(grid_.directions());
        for (std::size_t t = 0; t < tile.range.nt; ++t)
            for (std::size_t s = 0; s < tile.range.ns; ++s) {
                core::throw_if_stopped();
                const auto i = static_cast<double>(tile.range.s0 + s), j = static_cast<double>(tile.range.t0 + t);
                const LightFieldGrid grid = grid_.of_hogel(i, j);
                project({grid.s(i), grid.t(j), 0}, grid, vertices);
                std::fill(picture.begin(), picture.end(), VisiblePoint{});
                for (std::size_t index = 0; index < scene_->triangles.size(); ++index)
                    scan_convert(index, grid, vertices, picture);
                for (std::size_t v = 0; v < grid.directions_v; ++v)
                    for (std::size_t u = 0; u < grid.directions_u; ++u)
                        store_as_depth(tile, grid, picture[v * grid.directions_u + u], t, s, v, u);
            }
    }

  private:
    // Where a hogel, whose directions are those of the grid, sees each vertex.
    void project(Vec3 hogel, const LightFieldGrid& grid, std::vector<SeenVertex>& vertices) const {
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Vec3& p = scene_->positions[i];
            const auto [x, y, depth] = to_face(grid.face(), {p.x - hogel.x, p.y - hogel.y, -p.z});
            vertices[i] = {x, y, depth, grid.column(x / depth), grid.row(y / depth)};
        }
    }

    // Converts the picture's depth, a distance forward, to ζ in the tile.
    void store_as_depth(LightFieldTile& tile, const LightFieldGrid& grid, VisiblePoint point, std::size_t t,
                        std::size_t s, std::size_t v, std::size_t u) const {
        point.depth *= grid.direction_of(grid.u(static_cast<double>(u)), grid.v(static_cast<double>(v))).z;
        store(tile, *scene_, grid, point, t, s, v, u);
    }

    void scan_convert(std::size_t index, const LightFieldGrid& grid, const std::vector<SeenVertex>& vertices,
                      std::vector<VisiblePoint>& picture) const {
        const ShadedScene::Triangle& triangle = scene_->triangles[index];
        const SeenVertex& a = vertices[triangle.vertices[0]];
        const SeenVertex& b = vertices[triangle.vertices[1]];
        const SeenVertex& c = vertices[triangle.vertices[2]];

        // The rectangle of samples that the triangle can cover: all samples if it comes close to the hologram plane,
        // where directions are undefined.
        double k0 = 0, k1 = static_cast<double>(grid.directions_u) - 1;
        double l0 = 0, l1 = static_cast<double>(grid.directions_v) - 1;
        const auto [shallow, deep] = std::minmax({a.depth, b.depth, c.depth});
        if (shallow > min_depth_ || deep < -min_depth_) {
            constexpr double rounding = 1e-6;
            k0 = std::max(k0, std::ceil(std::min({a.k, b.k, c.k}) - rounding));
            k1 = std::min(k1, std::floor(std::max({a.k, b.k, c.k}) + rounding));
            l0 = std::max(l0, std::ceil(std::min({a.l, b.l, c.l}) - rounding));
            l1 = std::min(l1, std::floor(std::max({a.l, b.l, c.l}) + rounding));
        }
        if (!(k0 <= k1 && l0 <= l1)) return;

        const Edge ea = edge(b, c), eb = edge(c, a), ec = edge(a, b);
        // The ray meets the triangle's plane at ζ = N·P / (N·(U, V, 1)).
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.depth - a.depth;
        const double vx = c.x - a.x, vy = c.y - a.y, vz = c.depth - a.depth;
        const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const double plane = nx * a.x + ny * a.y + nz * a.depth;

        for (double l = l0; l <= l1; ++l)
            for (double k = k0; k <= k1; ++k) {
                const double U = grid.u(k), V = grid.v(l);
                const double facing = nx * U + ny * V + nz;
                if (facing == 0 || (facing < 0 && scene_->fronts_only)) continue;
                const double sign = facing > 0 ? 1 : -1;
                const double wa = sign * ea.function(U, V), wb = sign * eb.function(U, V),
                             wc = sign * ec.function(U, V);
                const auto inside = [](double w, const Edge& e) { return w > 0 || (w == 0 && e.forward); };
                if (!(inside(wa, ea) && inside(wb, eb) && inside(wc, ec))) continue;
                const double depth = plane / facing;
                VisiblePoint& seen =
                    picture[static_cast<std::size_t>(l) * grid.directions_u + static_cast<std::size_t>(k)];
                if (!(depth < seen.depth)) continue;
                const double sum = wa + wb + wc;
                seen = {index, static_cast<float>(wa / sum), static_cast<float>(wb / sum), static_cast<float>(wc / sum),
                        depth};
            }
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    double min_depth_ = 0;  // below this distance, projected vertices are not used to bound a triangle
};

}  // namespace

RendererInfo zbuffer_renderer() {
    return {
        .name = "zbuffer",
        .text = "an ordinary depth buffer for each hogel in turn",
        .make = [](std::shared_ptr<const ShadedScene> scene,
                   const LightFieldGrid& grid) { return std::make_unique<ZbufferRenderer>(std::move(scene), grid); },
        .depth_buffer_bytes =
            [](const LightFieldGrid& grid, const HogelRange&) {
                return static_cast<double>(sizeof(VisiblePoint)) * static_cast<double>(grid.directions());
            },
        .takes_focal_plane = true};
}

}  // namespace hogel::render::baselines
