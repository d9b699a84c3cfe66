// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/crossings.h"
#include "hogel/render/epi/epi.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/light.h"
#include "hogel/render/epi/occlusion.h"
#include "hogel/render/epi/setup.h"
#include "hogel/render/sample_store.h"

namespace hogel::render::epi {
namespace {

// So many samples of an epipolar plane are drawn at once that their words stay in the second level cache.
constexpr std::size_t max_words = std::size_t{96} << 10;

// So many triangles, or a few more, are set up together.
constexpr std::size_t max_waiting = 64;

// What is known of clusters' boxes is asked for so many clusters ahead.
constexpr std::size_t boxes_ahead = 8;

// A thread that copies a light field holds one tile.
constexpr std::size_t max_tile_bytes = std::size_t{384} << 20;

// After so many strips, or more if a plane has many samples, it is looked again which samples are covered: often enough
// to leave little in vain, and seldom enough to cost little. Strips that cover many cells are looked at sooner: as soon
// as so much has been drawn as would fill the plane.
constexpr std::size_t min_between_updates = 128, samples_between_updates = 256;

class EpiRenderer final : public LightFieldSource {
  public:
    EpiRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), axes_(grid), frame_(grid), clusters_(*scene_, frame_, grid.channels) {
        const Rgb sky = scene_->background;
        const bool grey = grid.channels == 1;
        const float values[] = {grey ? luminance(sky) : sky.r, sky.g, sky.b, std::numeric_limits<float>::infinity()};
        std::ranges::copy(values, background_.value0);
        if (needs_samples_)
            for (const std::uint32_t triangle : clusters_.triangles) lights_.push_back(light_from(triangle));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    // Whole rows if they are not too large, or else parts of equal length; several rows if they are small.
    HogelRange preferred_tile() const override {
        const HogelRange all{0, 0, grid_.hogels_s, grid_.hogels_t};
        const std::size_t length = axes_.fast_hogels(all);
        const std::size_t hogel_bytes = (grid_.channels + 1) * grid_.directions() * sizeof(float);
        const std::size_t most = std::max<std::size_t>(1, max_tile_bytes / hogel_bytes);
        const std::size_t parts = (length + most - 1) / most, part = (length + parts - 1) / parts;
        const std::size_t rows =
            std::min(axes_.slow_hogels(all), std::max<std::size_t>(1, default_tile(grid_).hogels() / part));
        return axes_.transposed() ? HogelRange{0, 0, rows, part} : HogelRange{0, 0, part, rows};
    }

    void read(LightFieldTile& tile) const override {
        const HogelRange& range = tile.range;
        const std::size_t hogels = axes_.fast_hogels(range), directions = axes_.fast_directions();
        const std::size_t columns =
            std::min({hogels, std::max<std::size_t>(16, max_words / directions), CellColumns::most});
        const std::size_t first_row = axes_.transposed() ? range.s0 : range.t0;
        const std::size_t first_column = axes_.transposed() ? range.t0 : range.s0;
        std::vector<std::uint64_t, CacheLineAllocator<std::uint64_t>> words(columns * directions + EpipolarPlane::spare,
                                                                            EpipolarPlane::nothing);
        PlaneCells cells;
        Work work;
        for (std::size_t row = 0; row < axes_.slow_hogels(range); ++row)
            for (std::size_t column = 0; column < hogels; column += columns) {
                const EpipolarPlane plane{words.data(),
                                          &cells,
                                          std::min(columns, hogels - column),
                                          directions,
                                          frame_.first_column() + static_cast<std::int32_t>(first_column + column),
                                          frame_.first_direction(),
                                          scene_->fronts_only};
                // Which the same samples of all its planes see.
                const EpipolarFrame::Plane any = frame_.plane(first_row + row, 0);
                work.boxes.begin_row(clusters_.boxes, plane, any.shift, any.z0);
                for (std::size_t slow = 0; slow < axes_.slow_directions(); ++slow) {
                    const std::size_t of_slab = slow % RowRays::max_planes;
                    if (of_slab == 0) find_crossings(clusters_, rays_of(plane, first_row + row, slow), work.crossings);
                    draw_plane(plane, frame_.plane(first_row + row, slow), work.crossings[of_slab], work);
                    const First first{first_row + row, first_column + column, slow};
                    if (axes_.transposed())
                        shade_turned_plane(tile, plane, work, first);
                    else
                        shade_plane(tile, plane, work, first);
                }
            }
    }

  private:
    // Where the light of a triangle's strips comes from.
    LightFrom light_from(std::uint32_t triangle) const {
        if (!scene_->needs_samples(triangle)) return LightFrom::ends;
        if (!scene_->radiance_cache || scene_->triangles[triangle].texture != ShadedScene::no_texture)
            return LightFrom::samples;
        const shading::LightGrid& grid = scene_->radiance_cache->grid(triangle);
        return grid.points && grid.is_radiance ? LightFrom::points : LightFrom::samples;
    }

    // The strips of one epipolar plane; number 0 is the background.
    struct Work {
        std::size_t count = 0;
        std::vector<Strip> strips;
        std::vector<StripShades, CacheLineAllocator<StripShades>> shades;
        std::vector<StripOrigin> origins;
        LitStrips lit;  // empty where all light comes from the ends
        Occlusion occlusion;
        Crossings crossings;                       // of some planes
        SeenBoxes boxes;                           // of all clusters
        std::vector<std::uint32_t> waiting;        // triangles on their way from memory
        std::array<std::vector<float>, 4> turned;  // values of a plane whose columns lie far apart in the tile
    };

    // Of planes from a row's direction `slow` on.
    RowRays rays_of(const EpipolarPlane& plane, std::size_t row, std::size_t slow) const {
        const EpipolarFrame::Plane first = frame_.plane(row, slow), next = frame_.plane(row, slow + 1);
        const double n_first = plane.first_column, k_first = plane.first_direction;
        return {first.row + first.slope * first.z0,
                first.z0,
                first.slope,
                next.slope - first.slope,
                std::min(RowRays::max_planes, axes_.slow_directions() - slow),
                first.shift,
                n_first,
                n_first + static_cast<double>(plane.columns) - 1,
                k_first,
                k_first + static_cast<double>(plane.directions) - 1};
    }

    // From front to back, and what has been drawn hides what is behind it, cluster by cluster.
    void draw_plane(const EpipolarPlane& plane, const EpipolarFrame::Plane& at, const std::vector<Crossing>& crossings,
                    Work& work) const {
        const PlaneCells& cells = *plane.cells;
        const PlanePlace place{at.row, at.slope, at.shift, at.z0, at.deepening * frame_.metres(1)};
        work.occlusion.clear(plane);
        work.count = 0;
        make_room(work, 1);
        work.strips[0] = {};
        work.shades[0] = background_;
        work.count = 1;
        if (needs_samples_) work.lit.clear(background_);
        std::size_t between_updates =
            std::max(min_between_updates, plane.columns * plane.directions / samples_between_updates);
        std::size_t drawn = 1, updated = 1;
        const auto draw_rest = [&] {
            draw(std::span(work.strips).subspan(drawn, work.count - drawn), drawn, plane);
            drawn = work.count;
        };
        for (std::size_t i = 0; i < crossings.size(); ++i) {
            const auto [triangles, cluster] = crossings[i];
            work.boxes.prefetch(crossings[std::min(i + boxes_ahead, crossings.size() - 1)].cluster);
            if (work.occlusion.hides(work.boxes, cluster, plane)) continue;
            const std::size_t first = cluster * cluster_size;
            for (std::uint64_t rest = triangles; rest != 0; rest &= rest - 1) {
                const std::size_t next = first + static_cast<std::size_t>(std::countr_zero(rest));
                work.waiting.push_back(static_cast<std::uint32_t>(next));
                const auto* lines = reinterpret_cast<const char*>(&clusters_.corners[next]);
                __builtin_prefetch(lines);
                __builtin_prefetch(lines + 64);
            }
            if (work.waiting.size() < max_waiting) continue;
            add_strips(work, place);
            if (work.count < drawn + min_between_updates) continue;
            draw_rest();
            const bool after_many = work.count >= updated + between_updates;
            if (!after_many && cells.drawn < plane.columns * PlaneCells::rows(plane.directions)) continue;
            work.occlusion.update(plane);
            updated = work.count;
            if (after_many) between_updates += between_updates / 2;
        }
        add_strips(work, place);
        draw_rest();
    }

    // Of the triangles that wait.
    void add_strips(Work& work, const PlanePlace& place) const {
        if (work.waiting.empty()) return;
        const std::size_t first = work.count;
        make_room(work, work.waiting.size());
        set_up(clusters_, work.waiting, place, &work.strips[first], &work.shades[first],
               needs_samples_ ? &work.origins[first] : nullptr);
        work.count += work.waiting.size();
        for (std::size_t i = 0; needs_samples_ && i < work.waiting.size(); ++i) {
            const LightFrom from = lights_[work.waiting[i]];
            if (from == LightFrom::ends) {
                work.lit.add_lit_at_ends(work.shades[first + i]);
                continue;
            }
            work.lit.add_lit(work.shades[first + i], from);
            if (from == LightFrom::points)
                __builtin_prefetch(&scene_->radiance_cache->grid(work.origins[first + i].triangle));
        }
        work.waiting.clear();
    }

    void make_room(Work& work, std::size_t more) const {
        const std::size_t needed = work.count + more;
        if (needed <= work.strips.size()) return;
        const std::size_t size = std::max(needed, 2 * work.strips.size());
        work.strips.resize(size);
        work.shades.resize(size);
        if (needs_samples_) work.origins.resize(size);
    }

    // The first sample of a plane, as the axes number hogels and directions.
    struct First {
        std::size_t slow_hogel, fast_hogel, slow_direction;
    };

    void shade_plane(LightFieldTile& tile, const EpipolarPlane& plane, Work& work, const First& first) const {
        const std::size_t t = first.slow_hogel - tile.range.t0, s = first.fast_hogel - tile.range.s0;
        const std::size_t v = first.slow_direction, stride = grid_.directions();
        const bool colour = grid_.channels == 3;
        shade_samples(plane, work, first,
                      {{&tile.radiance(0, t, s, v, 0), colour ? &tile.radiance(1, t, s, v, 0) : nullptr,
                        colour ? &tile.radiance(2, t, s, v, 0) : nullptr,
                        tile.depth.size() > 0 ? &tile.depth(t, s, v, 0) : nullptr},
                       {stride, stride, stride, stride}});
    }

    // The same where a row of directions is a column of the tile's.
    void shade_turned_plane(LightFieldTile& tile, const EpipolarPlane& plane, Work& work, const First& first) const {
        ShadedPlane out{};
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == 3 ? tile.depth.size() == 0 : i >= grid_.channels) continue;
            work.turned[i].resize(plane.columns * plane.directions);
            out.values[i] = work.turned[i].data();
            out.strides[i] = plane.directions;
        }
        shade_samples(plane, work, first, out);
        const std::size_t t = first.fast_hogel - tile.range.t0, s = first.slow_hogel - tile.range.s0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!out.values[i]) continue;
            for (std::size_t column = 0; column < plane.columns; ++column) {
                float* to = i == 3 ? &tile.depth(t + column, s, 0, first.slow_direction)
                                   : &tile.radiance(i, t + column, s, 0, first.slow_direction);
                const float* from = out.values[i] + column * plane.directions;
                for (std::size_t k = 0; k < plane.directions; ++k) to[k * grid_.directions_u] = from[k];
            }
        }
    }

    void shade_samples(const EpipolarPlane& plane, Work& work, const First& first, const ShadedPlane& out) const {
        if (needs_samples_)
            shade_lit(plane, work.shades, work.lit, PlaneSamples(*this, work, first), out);
        else
            shade_scene(plane, std::span(work.shades).first(work.count), out);
    }

    // What is worked out for single samples of a plane.
    class PlaneSamples final : public SampleSource {
      public:
        PlaneSamples(const EpiRenderer& renderer, const Work& work, const First& first)
            : renderer_(renderer), work_(work), first_(first) {}

        Rgb radiance(std::size_t strip, float part, std::size_t column, std::size_t k) const override {
            const StripOrigin& from = work_.origins[strip];
            const StripShades& shades = work_.shades[strip];
            const auto [b0, b1, b2] = from.weights(part);
            const float depth = shades.value0[3] + part * shades.difference[3];
            const auto sample =
                renderer_.axes_.sample(first_.slow_hogel, first_.fast_hogel + column, first_.slow_direction, k);
            const LightFieldGrid& grid = renderer_.grid_;
            const ViewSample sight =
                view_sample(grid, grid.u(static_cast<double>(sample.u)), grid.v(static_cast<double>(sample.v)), depth);
            return radiance_at(*renderer_.scene_, from.triangle, b0, b1, b2, sight);
        }

        Grids grids() const override {
            return {work_.origins.data(), renderer_.scene_->radiance_cache->grids().data()};
        }

        shading::RadianceCache::Corners corners(std::size_t strip, std::size_t row, std::size_t column) const override {
            return renderer_.scene_->radiance_cache->corners(*renderer_.scene_, work_.origins[strip].triangle, row,
                                                             column);
        }

      private:
        const EpiRenderer& renderer_;
        const Work& work_;
        First first_;
    };

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    RowAxes axes_;
    EpipolarFrame frame_;
    TriangleClusters clusters_;
    std::vector<LightFrom> lights_;  // in the places of the clusters; empty where all light comes from the ends
    StripShades background_{0, 0, 1, 0, {}, {}};
    bool needs_samples_ = scene_->lighting || !scene_->textures.empty();
};

}  // namespace

RendererInfo epi_renderer() {
    return {.name = "epi",
            .text = "epipolar planes: each triangle is set up once for a whole row of hogels",
            .make = [](std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) {
                return std::make_unique<EpiRenderer>(std::move(scene), grid);
            }};
}

}  // namespace hogel::render::epi
