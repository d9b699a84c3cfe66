// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/epi.h"

#include <algorithm>
#include <vector>

#include "hogel/array.h"
#include "hogel/core/stop_scope.h"
#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/crossed.h"
#include "hogel/render/epi/frame.h"
#include "hogel/render/epi/hierarchical_z.h"
#include "hogel/render/epi/plane_drawer.h"
#include "hogel/render/epi/plane_shader.h"
#include "hogel/render/epi/plane_spans.h"
#include "hogel/render/row_axes.h"

namespace hogel::render::epi {
namespace {

// Maximum number of samples of a plane that are drawn at once, so that their words stay in the second-level cache.
constexpr std::size_t max_words = std::size_t{96} << 10;

// Maximum size of a tile in bytes; each thread that copies a light field holds one.
constexpr std::size_t max_tile_bytes = std::size_t{384} << 20;

class EpiRenderer final : public LightFieldSource {
  public:
    EpiRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)),
          grid_(grid),
          axes_(grid),
          frame_(grid),
          clusters_(*scene_, frame_, grid.channels),
          radiance_(*scene_, clusters_, grid.channels) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    // Returns whole rows (several if they are small), or equal parts of a row that is too large.
    HogelRange preferred_tile() const override {
        const HogelRange all{0, 0, grid_.hogels_s, grid_.hogels_t};
        const std::size_t length = axes_.fast_hogels(all);
        const std::size_t hogel_bytes = (grid_.channels + 1) * grid_.directions() * sizeof(float);
        const std::size_t max_length = std::max<std::size_t>(1, max_tile_bytes / hogel_bytes);
        const std::size_t count = (length + max_length - 1) / max_length, tile_length = (length + count - 1) / count;
        const std::size_t rows =
            std::min(axes_.slow_hogels(all), std::max<std::size_t>(1, default_tile(grid_).hogels() / tile_length));
        return axes_.transposed() ? HogelRange{0, 0, rows, tile_length} : HogelRange{0, 0, tile_length, rows};
    }

    void read(LightFieldTile& tile) const override {
        const HogelRange& range = tile.range;
        const std::size_t hogels = axes_.fast_hogels(range), directions = axes_.fast_directions();
        const std::size_t columns =
            std::min({hogels, std::max<std::size_t>(16, max_words / directions), CellColumns::max_plane_columns});
        const std::size_t first_row = axes_.transposed() ? range.s0 : range.t0;
        const std::size_t first_column = axes_.transposed() ? range.t0 : range.s0;
        std::vector<std::uint64_t, CacheLineAllocator<std::uint64_t>> words(
            columns * directions + EpipolarPlane::padding, EpipolarPlane::empty);
        DepthCells cells;
        PlaneSpans spans(*scene_, clusters_, radiance_);
        PlaneDrawer drawer(clusters_, spans);
        PlaneShader shader(*scene_, grid_, spans);
        CrossedByPlane crossed;
        for (std::size_t row = first_row; row < first_row + axes_.slow_hogels(range); ++row)
            for (std::size_t column = 0; column < hogels; column += columns) {
                const EpipolarPlane plane{words.data(),
                                          &cells,
                                          std::min(columns, hogels - column),
                                          directions,
                                          frame_.first_column() + static_cast<std::int32_t>(first_column + column),
                                          frame_.first_direction(),
                                          scene_->fronts_only};
                const EpipolarFrame::Plane row_plane = frame_.plane(row, 0);
                drawer.begin_row(plane, row_plane.shift, row_plane.z0);
                for (std::size_t slow = 0; slow < axes_.slow_directions(); ++slow) {
                    core::throw_if_stopped();
                    const std::size_t i = slow % RowPlanes::max_planes;
                    if (i == 0) find_crossed(clusters_, planes_from(plane, row, slow), crossed);
                    drawer.draw(plane, cut_plane(row, slow), crossed[i]);
                    shader.shade(plane, {row, first_column + column, slow}, tile);
                }
            }
    }

  private:
    // Returns the planes of a row beginning with direction `slow`, with the samples of `plane`.
    RowPlanes planes_from(const EpipolarPlane& plane, std::size_t row, std::size_t slow) const {
        const EpipolarFrame::Plane first = frame_.plane(row, slow), next = frame_.plane(row, slow + 1);
        const double n_first = plane.first_column, K_first = plane.first_direction;
        return {first.row + first.slope * first.z0,
                first.z0,
                first.slope,
                next.slope - first.slope,
                std::min(RowPlanes::max_planes, axes_.slow_directions() - slow),
                first.shift,
                n_first,
                n_first + static_cast<double>(plane.columns) - 1,
                K_first,
                K_first + static_cast<double>(plane.directions) - 1};
    }

    CutPlane cut_plane(std::size_t row, std::size_t slow) const {
        const EpipolarFrame::Plane plane = frame_.plane(row, slow);
        return {plane.row, plane.slope, plane.shift, plane.z0, plane.depth_per_forward * frame_.metres(1)};
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    RowAxes axes_;
    EpipolarFrame frame_;
    TriangleClusters clusters_;
    RadianceTable radiance_;
};

}  // namespace

RendererInfo epi_renderer() {
    return {.name = "epi",
            .text = "epipolar planes: each triangle is set up once for a whole row of hogels",
            .make = [](std::shared_ptr<const ShadedScene> scene,
                       const LightFieldGrid& grid) { return std::make_unique<EpiRenderer>(std::move(scene), grid); },
            .time_of_a_ray = 1};
}

}  // namespace hogel::render::epi
