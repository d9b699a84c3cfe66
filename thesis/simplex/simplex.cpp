// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/simplex.h"

#include "hogel/core/stop_scope.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/region_memory.h"
#include "hogel/render/visits.h"
#include "thesis/simplex/rays_in_blocks.h"
#include "thesis/simplex/scan.h"
#include "thesis/simplex/seen_directions.h"
#include "thesis/simplex/slice.h"
#include "thesis/simplex/strip.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

using namespace render;

namespace {

// Returns the depth buffer, [v][u][t][s]: the inner loops run over hogels.
Shape<4> simplex_buffer(const LightFieldGrid& grid, const HogelRange& region) {
    return {grid.directions_v, grid.directions_u, region.nt, region.ns};
}

class SimplexRenderer final : public Renderer, public CountsVisits {
  public:
    SimplexRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid, bool strips)
        : grid_(grid), strips_(strips) {
        SimplexRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }
    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        near_ = near_plane(*scene, strips_ ? "simplex-strips" : "simplex");
        // On the front the triangles are clipped at the near plane; on a side simplices are clipped before the
        // division.
        if (grid_.face() != Face::front) min_forward_ = min_forward_distance(grid_, 0.5 * near_);
        scene_ = std::move(scene);
        triangles_ = triangles_with_area(*scene_, std::move(triangles_));
    }

    // Source: [K] fig. 5.21.
    void read(LightFieldTile& tile) const override {
        Array<NearestTriangle, 4> buffer(simplex_buffer(grid_, tile.range));
        std::vector<Simplex<4>> simplices;
        StripSlices slices;
        SeenDirections seen(grid_);
        Visits visits;
        for (std::uint32_t index : triangles_) {
            core::throw_if_stopped();
            // Clips at half the depth of the near plane, so that the visibility of every ray is decided by see(), not
            // by the clip.
            for (const DeepTriangle& part : clip_to_near_plane(deep_triangle(*scene_, index), 0.5 * near_)) {
                if (!seen.find(part, tile.range)) continue;
                const RegionSides sides = split_at_back_face(part, grid_, tile.range);
                // The volume seen from either side is convex.
                for (const auto* side : {&sides.front, &sides.back}) {
                    if (side == &sides.back && scene_->fronts_only) continue;
                    simplices.clear();
                    append_projected_volume(part, *side, grid_, tile.range, simplices, min_forward_);
                    visits.pieces += simplices.size();
                    if (strips_)
                        scan_convert(index, simplices, slices, seen, tile.range, buffer, visits);
                    else
                        for (const Simplex<4>& simplex : simplices)
                            scan_convert(index, simplex, seen, tile.range, buffer, visits);
                }
            }
        }
        add_visits(visits);
        for_each_ray(grid_, {0, tile.range.nt}, {0, tile.range.ns},
                     [&](std::size_t t, std::size_t s, std::size_t v, std::size_t u) {
                         store(tile, *scene_, grid_, buffer(v, u, t, s), t, s, v, u);
                     });
    }

  private:
    // Source: [K] 5.7.3, 5.7.4.
    void scan_convert(std::uint32_t index, const Simplex<4>& simplex, const SeenDirections& seen,
                      const HogelRange& range, Array<NearestTriangle, 4>& buffer, Visits& visits) const {
        slice_at_samples(simplex, axis::v, seen.v(), [&](double v, const Simplex<3>& at_v) {
            ++visits.cuts;
            slice_at_samples(at_v, axis::u, seen.u(), [&](double u, const Simplex<2>& at_uv) {
                ++visits.cuts;
                const SliceInHogels slice(at_uv);
                const Span rows = slice.rows(range.nt);
                if (rows.first == rows.end) return;
                ++visits.slices;
                const ObliqueTriangle triangle(*scene_, index, grid_, u, v);
                const View<NearestTriangle, 2> hogels =
                    buffer[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)];
                for (std::size_t t = rows.first; t < rows.end; ++t)
                    see_row(index, triangle, t, slice.columns(t, range.ns), range, hogels, visits);
            });
        });
    }

    // Scan converts all simplices of a convex volume together: a row of hogels is covered from the first to the last.
    // Source: [K] 7.2.2.
    void scan_convert(std::uint32_t index, const std::vector<Simplex<4>>& simplices, StripSlices& slices,
                      const SeenDirections& seen, const HogelRange& range, Array<NearestTriangle, 4>& buffer,
                      Visits& visits) const {
        visits.cuts +=
            slices.for_each(simplices, {seen.v(), seen.u()}, [&](std::size_t v, std::size_t u, const Strip<2>& at_uv) {
                const StripInHogels slice(at_uv);
                const Span rows = slice.rows(range.nt);
                if (rows.first == rows.end) return;
                ++visits.slices;
                const ObliqueTriangle triangle(*scene_, index, grid_, static_cast<double>(u), static_cast<double>(v));
                for (std::size_t t = rows.first; t < rows.end; ++t)
                    see_row(index, triangle, t, slice.columns(t, range.ns), range, buffer[v][u], visits);
            });
    }

    void see_row(std::uint32_t index, const ObliqueTriangle& triangle, std::size_t t, const Span& columns,
                 const HogelRange& range, View<NearestTriangle, 2> hogels, Visits& visits) const {
        visits.samples += columns.size();
        const double hogel_t = grid_.t(static_cast<double>(range.t0 + t));
        for (std::size_t s = columns.first; s < columns.end; ++s)
            see(hogels(t, s), index, triangle, grid_.s(static_cast<double>(range.s0 + s)), hogel_t, near_);
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    bool strips_;
    std::vector<std::uint32_t> triangles_;
    double near_ = 0;  // ζ
    double min_forward_ = 0;
};

RendererInfo info(const char* name, const char* text, bool strips) {
    return {.name = name,
            .text = text,
            .make =
                [strips](std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) {
                    return std::make_unique<SimplexRenderer>(std::move(scene), grid, strips);
                },
            .crosses_plane = false,
            .cost = [](const LightFieldGrid& grid, const HogelRange& region,
                       std::size_t) { return RenderCost{buffer_bytes(simplex_buffer(grid, region))}; }};
}

}  // namespace

RendererInfo simplex_renderer() {
    return info("simplex", "a four-dimensional depth buffer for all hogels of a tile at once", false);
}

RendererInfo simplex_strips_renderer() {
    return info("simplex-strips", "as simplex, in strips of simplices that share corners", true);
}

}  // namespace hogel::simplex
