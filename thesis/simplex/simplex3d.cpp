// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/simplex3d.h"

#include <algorithm>

#include "hogel/core/stop_scope.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/region_memory.h"
#include "hogel/render/row_tile.h"
#include "hogel/render/span.h"
#include "hogel/render/visits.h"
#include "thesis/simplex/rays_in_blocks.h"
#include "thesis/simplex/seen_directions.h"
#include "thesis/simplex/slice.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

using namespace render;

namespace {

// Returns the depth buffer, [v][u][s]: one row of hogels.
Shape<3> simplex3d_buffer(const LightFieldGrid& grid, const HogelRange& region) {
    return {grid.directions_v, grid.directions_u, region.ns};
}

class Simplex3dRenderer final : public Renderer, public CountsVisits {
  public:
    Simplex3dRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) : grid_(grid) {
        Simplex3dRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }
    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        near_ = near_plane(*scene, "simplex3d");
        // On the front the triangles are clipped at the near plane; on a side simplices are clipped before the
        // division.
        if (grid_.face() != Face::front) min_forward_ = min_forward_distance(grid_, 0.5 * near_);
        scene_ = std::move(scene);
        triangles_ = triangles_with_area(*scene_, std::move(triangles_));
    }
    HogelRange preferred_tile() const override { return row_tile(grid_); }

    void read(LightFieldTile& tile) const override {
        Array<NearestTriangle, 3> buffer(simplex3d_buffer(grid_, tile.range));
        std::vector<Simplex<3>> simplices;
        SeenDirections seen(grid_);
        Visits visits;
        for (std::size_t t = 0; t < tile.range.nt; ++t) {
            std::ranges::fill(buffer.elements(), NearestTriangle{});
            const HogelRange row{tile.range.s0, tile.range.t0 + t, tile.range.ns, 1};
            for (std::uint32_t index : triangles_) {
                core::throw_if_stopped();
                for (const DeepTriangle& part : clip_to_near_plane(deep_triangle(*scene_, index), 0.5 * near_)) {
                    if (!seen.find(part, row)) continue;
                    simplices.clear();
                    for (const CameraLine& line : split_row_at_back_face(part, t, grid_, tile.range))
                        if (line.front_visible || !scene_->fronts_only)
                            append_projected_volume(part, line, grid_, tile.range, simplices, min_forward_);
                    for (const Simplex<3>& simplex : simplices)
                        scan_convert(index, simplex, seen, t, tile.range, buffer, visits);
                }
            }
            for_each_ray(grid_, {t, t + 1}, {0, tile.range.ns},
                         [&](std::size_t, std::size_t s, std::size_t v, std::size_t u) {
                             store(tile, *scene_, grid_, buffer(v, u, s), t, s, v, u);
                         });
        }
        add_visits(visits);
    }

  private:
    void scan_convert(std::uint32_t index, const Simplex<3>& simplex, const SeenDirections& seen, std::size_t t,
                      const HogelRange& range, Array<NearestTriangle, 3>& buffer, Visits& visits) const {
        ++visits.pieces;
        const double hogel_t = grid_.t(static_cast<double>(range.t0 + t));
        slice_at_samples(simplex, axis::v, seen.v(), [&](double v, const Simplex<2>& at_v) {
            ++visits.cuts;
            slice_at_samples(at_v, axis::u, seen.u(), [&](double u, const Simplex<1>& at_uv) {
                ++visits.cuts;
                const double s0 = at_uv[0][axis::s] / at_uv[0][axis::q], s1 = at_uv[1][axis::s] / at_uv[1][axis::q];
                const Span columns = samples_between(std::min(s0, s1), std::max(s0, s1), range.ns);
                if (columns.first == columns.end) return;
                ++visits.slices;
                visits.samples += columns.size();
                const ObliqueTriangle triangle(*scene_, index, grid_, u, v);
                const View<NearestTriangle, 1> hogels =
                    buffer[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)];
                for (std::size_t s = columns.first; s < columns.end; ++s)
                    see(hogels(s), index, triangle, grid_.s(static_cast<double>(range.s0 + s)), hogel_t, near_);
            });
        });
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    std::vector<std::uint32_t> triangles_;
    double near_ = 0;  // ζ
    double min_forward_ = 0;
};

}  // namespace

RendererInfo simplex3d_renderer() {
    return {
        .name = "simplex3d",
        .text = "as simplex, but in three dimensions, for one row of hogels after the other",
        .make = [](std::shared_ptr<const ShadedScene> scene,
                   const LightFieldGrid& grid) { return std::make_unique<Simplex3dRenderer>(std::move(scene), grid); },
        .crosses_plane = false,
        .cost = [](const LightFieldGrid& grid, const HogelRange& region,
                   std::size_t) { return RenderCost{buffer_bytes(simplex3d_buffer(grid, region))}; }};
}

}  // namespace hogel::simplex
