// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/render/baselines/zbuffer.h"
#include "hogel/render/sample_store.h"

namespace hogel::render::baselines {
namespace {

// Linear function of the direction: value(U, V) = c + u U + v V.
struct LinearInDirection {
    double c = 0, u = 0, v = 0;

    double operator()(double U, double V) const { return c + (u * U + v * V); }
};

// Vertex seen from a hogel: its position relative to the hogel's centre, and its position in the hogel's picture.
struct SeenVertex {
    double x, y, depth;  // x − s, y − t, ζ; on a side of a hemicube right, up and forward in its picture
    // Column and row of the picture, valid unless ζ is close to zero; slopes U and V on a frequency grid.
    double k, l;
};

// Rectangle of samples of a hogel's picture, ends included.
struct Rectangle {
    double k0, k1, l0, l1;

    bool empty() const { return !(k0 <= k1 && l0 <= l1); }
};

// Returns the range of U/√(1 + U² + V²) for these ranges. It grows with U; its modulus falls with |V|.
std::pair<double, double> sines(double low_u, double high_u, double low_v, double high_v) {
    const double high = std::max(std::abs(low_v), std::abs(high_v));
    const double low = low_v <= 0 && high_v >= 0 ? 0 : std::min(std::abs(low_v), std::abs(high_v));
    const auto sine = [](double u, double v) { return u / std::sqrt(1 + u * u + v * v); };
    return {sine(low_u, low_u < 0 ? low : high), sine(high_u, high_u < 0 ? high : low)};
}

// Returns the edge function of docs/notation.md, section 2, for a ray through the origin of the hogel's frame: E = U
// (dζ A_y − dy A_ζ) + V (dx A_ζ − dζ A_x) + dy A_x − dx A_y.
LinearInDirection edge_from_to(const SeenVertex& a, const SeenVertex& b) {
    const double dx = b.x - a.x, dy = b.y - a.y, dz = b.depth - a.depth;
    return {dy * a.x - dx * a.y, dz * a.y - dy * a.depth, dx * a.depth - dz * a.x};
}

struct Edge {
    LinearInDirection function;
    bool forward;  // whether the edge runs from its smaller to its larger end
};

// Returns an edge computed from its smaller end. Two triangles that share an edge traverse it in opposite directions;
// both get exact negatives, so that no sample falls between them or into both.
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
        slopes_ = grid_.has_frequencies() ? slopes_of(grid_) : std::vector<Slopes>{};
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
    struct Slopes {
        double U, V;  // NaN in the corners of a frequency grid, which are evanescent
    };

    static std::vector<Slopes> slopes_of(const LightFieldGrid& grid) {
        std::vector<Slopes> slopes;
        slopes.reserve(grid.directions());
        for (std::size_t v = 0; v < grid.directions_v; ++v)
            for (std::size_t u = 0; u < grid.directions_u; ++u) {
                const Vec3 ray = grid.direction_of(grid.u(static_cast<double>(u)), grid.v(static_cast<double>(v)));
                slopes.push_back({ray.x / ray.z, ray.y / ray.z});
            }
        return slopes;
    }

    // Computes the position of each vertex as seen from a hogel with the directions of the grid.
    void project(Vec3 hogel, const LightFieldGrid& grid, std::vector<SeenVertex>& vertices) const {
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Vec3& p = scene_->positions[i];
            const auto [x, y, depth] = to_face(grid.face(), {p.x - hogel.x, p.y - hogel.y, -p.z});
            if (slopes_.empty())
                vertices[i] = {x, y, depth, grid.column(x / depth), grid.row(y / depth)};
            else
                vertices[i] = {x, y, depth, x / depth, y / depth};
        }
    }

    // Stores a sample after converting the picture's depth, a forward distance, to ζ.
    void store_as_depth(LightFieldTile& tile, const LightFieldGrid& grid, VisiblePoint point, std::size_t t,
                        std::size_t s, std::size_t v, std::size_t u) const {
        if (slopes_.empty())
            point.depth *= grid.direction_of(grid.u(static_cast<double>(u)), grid.v(static_cast<double>(v))).z;
        store(tile, *scene_, grid, point, t, s, v, u);
    }

    void scan_convert(std::size_t index, const LightFieldGrid& grid, const std::vector<SeenVertex>& vertices,
                      std::vector<VisiblePoint>& picture) const {
        const ShadedScene::Triangle& triangle = scene_->triangles[index];
        const SeenVertex& a = vertices[triangle.vertices[0]];
        const SeenVertex& b = vertices[triangle.vertices[1]];
        const SeenVertex& c = vertices[triangle.vertices[2]];

        const Rectangle covered = covered_by(grid, a, b, c);
        if (covered.empty()) return;
        if (slopes_.empty())
            scan_convert(index, grid, a, b, c, covered, picture, [&](double k, double l) {
                return Slopes{grid.u(k), grid.v(l)};
            });
        else
            scan_convert(index, grid, a, b, c, covered, picture, [&](double k, double l) {
                return slopes_[static_cast<std::size_t>(l) * grid.directions_u + static_cast<std::size_t>(k)];
            });
    }

    // Returns the rectangle of samples that a triangle can cover; all samples if it comes close to ζ = 0.
    Rectangle covered_by(const LightFieldGrid& grid, const SeenVertex& a, const SeenVertex& b,
                         const SeenVertex& c) const {
        Rectangle samples{0, static_cast<double>(grid.directions_u) - 1, 0, static_cast<double>(grid.directions_v) - 1};
        const auto [shallow, deep] = std::minmax({a.depth, b.depth, c.depth});
        if (!(shallow > min_depth_ || deep < -min_depth_)) return samples;
        auto [low_k, high_k] = std::minmax({a.k, b.k, c.k});
        auto [low_l, high_l] = std::minmax({a.l, b.l, c.l});
        if (!slopes_.empty()) {
            const auto [left, right] = sines(low_k, high_k, low_l, high_l);
            const auto [bottom, top] = sines(low_l, high_l, low_k, high_k);
            low_k = grid.column(left), high_k = grid.column(right);
            low_l = grid.row(top), high_l = grid.row(bottom);
        }
        constexpr double rounding = 1e-6;
        samples.k0 = std::max(samples.k0, std::ceil(low_k - rounding));
        samples.k1 = std::min(samples.k1, std::floor(high_k + rounding));
        samples.l0 = std::max(samples.l0, std::ceil(low_l - rounding));
        samples.l1 = std::min(samples.l1, std::floor(high_l + rounding));
        return samples;
    }

    // @param slopes_at  U and V of the ray in column k and row l
    template <typename SlopesAt>
    void scan_convert(std::size_t index, const LightFieldGrid& grid, const SeenVertex& a, const SeenVertex& b,
                      const SeenVertex& c, const Rectangle& covered, std::vector<VisiblePoint>& picture,
                      const SlopesAt& slopes_at) const {
        const Edge ea = edge(b, c), eb = edge(c, a), ec = edge(a, b);
        // The ray meets the triangle's plane at ζ = N·P / (N·(U, V, 1)).
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.depth - a.depth;
        const double vx = c.x - a.x, vy = c.y - a.y, vz = c.depth - a.depth;
        const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const double plane = nx * a.x + ny * a.y + nz * a.depth;

        for (double l = covered.l0; l <= covered.l1; ++l)
            for (double k = covered.k0; k <= covered.k1; ++k) {
                const auto [U, V] = slopes_at(k, l);
                const double facing = nx * U + ny * V + nz;
                if (facing == 0 || (facing < 0 && scene_->fronts_only)) continue;
                const double sign = facing > 0 ? 1 : -1;
                const double wa = sign * ea.function(U, V), wb = sign * eb.function(U, V),
                             wc = sign * ec.function(U, V);
                const auto inside = [](double w, const Edge& e) { return w > 0 || (w == 0 && e.forward); };
                if (!(inside(wa, ea) && inside(wb, eb) && inside(wc, ec))) continue;
                const double depth = plane / facing;
                VisiblePoint& nearest =
                    picture[static_cast<std::size_t>(l) * grid.directions_u + static_cast<std::size_t>(k)];
                if (!(depth < nearest.depth)) continue;
                const double sum = wa + wb + wc;
                nearest = {index, static_cast<float>(wa / sum), static_cast<float>(wb / sum),
                           static_cast<float>(wc / sum), depth};
            }
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    double min_depth_ = 0;        // below it, projected vertices do not bound a triangle
    std::vector<Slopes> slopes_;  // [v][u] of a frequency grid; empty for others
};

}  // namespace

RendererInfo zbuffer_renderer() {
    return {
        .name = "zbuffer",
        .text = "an ordinary depth buffer for each hogel in turn",
        .make = [](std::shared_ptr<const ShadedScene> scene,
                   const LightFieldGrid& grid) { return std::make_unique<ZbufferRenderer>(std::move(scene), grid); },
        .cost = [](const LightFieldGrid& grid, const HogelRange&,
                   std::size_t) { return RenderCost{sizeof(VisiblePoint) * static_cast<double>(grid.directions())}; },
        .takes_frequencies = true,
        .takes_focal_plane = true};
}

}  // namespace hogel::render::baselines
