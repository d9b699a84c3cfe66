#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/epi_cut_internal.h"
#include "hogel/render/epi_internal.h"
#include "hogel/render/epi_kernels_internal.h"
#include "hogel/render/epi_light_internal.h"
#include "hogel/render/epi_occlusion_internal.h"
#include "hogel/render/sample_store_internal.h"

namespace hogel {
namespace {

// So many samples of an epipolar plane are drawn at once that their words stay in the second level cache.
constexpr std::size_t most_words = std::size_t{96} << 10;

// A thread that copies a light field holds one tile.
constexpr std::size_t most_tile_bytes = std::size_t{96} << 20;

// After so many strips, or more if a plane has many samples, it is looked again which samples are covered: often enough
// to leave little in vain, and seldom enough to cost little.
constexpr std::size_t fewest_between_updates = 128, samples_between_updates = 256;

// Where a strip lies on its triangle. One corner of the triangle is alone on its side of the plane; end 0 lies between
// it and the next corner, end 1 between it and the last.
struct StripOrigin {
    float weight0, weight1;  // of the lone corner, at the two ends
    std::uint32_t triangle;
    std::uint32_t lone;  // 0, 1 or 2

    // Of the triangle's vertices, at this part of the way from end 0 to end 1.
    std::array<float, 3> weights(float part) const {
        std::array<float, 3> b;
        b[lone] = (1 - part) * weight0 + part * weight1;
        b[(lone + 1) % 3] = (1 - part) * (1 - weight0);
        b[(lone + 2) % 3] = part * (1 - weight1);
        return b;
    }
};

class EpiRenderer final : public LightFieldSource {
  public:
    EpiRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), axes_(grid), frame_(grid), clusters_(*scene_, frame_) {
        set_values(background_.value0, scene_->background, std::numeric_limits<double>::infinity());
        if (needs_samples_)
            for (const std::uint32_t triangle : clusters_.triangles) lights_.push_back(light_of(triangle));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    // Whole rows if they are not too large, or else parts of equal length; several rows if they are small.
    HogelRange preferred_tile() const override {
        const HogelRange all{0, 0, grid_.hogels_s, grid_.hogels_t};
        const std::size_t length = axes_.fast_hogels(all);
        const std::size_t hogel_bytes = (grid_.channels + 1) * grid_.directions() * sizeof(float);
        const std::size_t most = std::max<std::size_t>(1, most_tile_bytes / hogel_bytes);
        const std::size_t parts = (length + most - 1) / most, part = (length + parts - 1) / parts;
        const std::size_t rows =
            std::min(axes_.slow_hogels(all), std::max<std::size_t>(1, default_tile(grid_).hogels() / part));
        return axes_.turned() ? HogelRange{0, 0, rows, part} : HogelRange{0, 0, part, rows};
    }

    void read(LightFieldTile& tile) const override {
        const HogelRange& range = tile.range;
        const std::size_t hogels = axes_.fast_hogels(range), directions = axes_.fast_directions();
        const std::size_t columns = std::min(hogels, std::max<std::size_t>(16, most_words / directions));
        const std::size_t first_row = axes_.turned() ? range.s0 : range.t0;
        const std::size_t first_column = axes_.turned() ? range.t0 : range.s0;
        std::vector<std::uint64_t, CacheLineAllocator<std::uint64_t>> words(columns * directions +
                                                                            EpipolarPlane::spare);
        Work work;
        for (std::size_t slow = 0; slow < axes_.slow_directions(); ++slow)
            for (std::size_t row = 0; row < axes_.slow_hogels(range); ++row) {
                const EpipolarFrame::Plane place = frame_.plane(first_row + row, slow);
                for (std::size_t column = 0; column < hogels; column += columns) {
                    const EpipolarPlane plane{words.data(), std::min(columns, hogels - column), directions,
                                              frame_.first_column() + static_cast<std::int32_t>(first_column + column),
                                              frame_.first_direction()};
                    std::fill(words.begin(), words.end(), EpipolarPlane::nothing);
                    draw_plane(plane, place, work);
                    if (axes_.turned())
                        shade_turned_plane(tile, plane, work, {first_row + row, first_column + column, slow});
                    else
                        shade_plane(tile, plane, work, {first_row + row, first_column + column, slow});
                }
            }
    }

  private:
    // Where the light of a triangle's strips comes from.
    struct TriangleLight {
        StripLight::From from = StripLight::From::ends;
        LightGrid grid = {};
    };

    TriangleLight light_of(std::uint32_t triangle) const {
        if (!scene_->needs_samples(triangle)) return {};
        if (!scene_->light_cache || scene_->triangles[triangle].texture != ShadedScene::no_texture)
            return {StripLight::From::samples};
        const LightGrid& grid = scene_->light_cache->grid(triangle);
        if (!grid.points || !grid.is_radiance) return {StripLight::From::samples};
        return {StripLight::From::points, grid};
    }

    // The strips of one epipolar plane; number 0 is the background.
    struct Work {
        std::vector<Strip> strips;
        std::vector<StripShades, CacheLineAllocator<StripShades>> shades;
        std::vector<StripOrigin> origins;
        std::vector<StripLight, CacheLineAllocator<StripLight>> lights;
        Occlusion occlusion;
        std::array<std::vector<float>, 4> turned;  // values of a plane whose columns lie far apart in the tile
    };

    // The triangles of a cluster that a plane crosses, as bits.
    struct Crossed {
        std::uint32_t cluster;
        std::uint64_t triangles;
    };

    // From front to back, and what has been drawn hides what is behind it, cluster by cluster.
    void draw_plane(const EpipolarPlane& plane, const EpipolarFrame::Plane& place, Work& work) const {
        const double row = place.row, slope = place.slope;
        work.strips.assign(1, {});
        work.shades.assign(1, background_);
        work.origins.assign(1, {});
        work.lights.assign(1, {});
        work.occlusion.clear();
        const std::size_t between_updates =
            std::max(fewest_between_updates, plane.columns * plane.directions / samples_between_updates);
        std::size_t drawn = 1;
        const auto draw_rest = [&] {
            draw(std::span(work.strips).subspan(drawn), drawn, plane);
            drawn = work.strips.size();
        };
        const auto may_show = [&](const TriangleClusters::Bounds& bounds) {
            return bounds.may_cross(row, slope) && !work.occlusion.hides(bounds, plane, place.shift, place.z0);
        };
        // The last cluster that was crossed, whose triangles are on their way from memory.
        Crossed waiting{0, 0};
        for (const TriangleClusters::Group& group : clusters_.groups) {
            if (!may_show(group.bounds)) continue;
            for (const std::uint32_t cluster : group.clusters) {
                if (!may_show(clusters_.bounds[cluster])) continue;
                const Crossed next{cluster, crossing(clusters_.corners[cluster], row, slope)};
                if (next.triangles == 0) continue;
                prefetch(next);
                add_strips(waiting, place, work);
                waiting = next;
            }
            if (work.strips.size() < drawn + between_updates) continue;
            draw_rest();
            work.occlusion.update(plane);
        }
        add_strips(waiting, place, work);
        draw_rest();
    }

    void prefetch(const Crossed& crossed) const {
        for (std::uint64_t rest = crossed.triangles; rest != 0; rest &= rest - 1) {
            const auto number = static_cast<std::size_t>(std::countr_zero(rest));
            __builtin_prefetch(&clusters_.others[crossed.cluster * cluster_size + number]);
        }
    }

    void add_strips(const Crossed& crossed, const EpipolarFrame::Plane& place, Work& work) const {
        for (std::uint64_t rest = crossed.triangles; rest != 0; rest &= rest - 1)
            add_strip(crossed.cluster, static_cast<std::size_t>(std::countr_zero(rest)), place, work);
    }

    void add_strip(std::size_t cluster, std::size_t number, const EpipolarFrame::Plane& place, Work& work) const {
        const ClusterCorners& all = clusters_.corners[cluster];
        const std::size_t index = cluster * cluster_size + number;
        const TriangleCorners& own = clusters_.others[index];
        std::array<double, 3> x, z, height;
        for (std::size_t i = 0; i < 3; ++i) {
            x[i] = own.x[i];
            z[i] = all.z[i][number];
            // As in `crossing`, to the last bit.
            height[i] = (all.y[i][number] - place.slope * z[i]) - place.row;
        }
        auto [lone, next, last, end0, end1] = cut_triangle(x, z, height);
        for (Cut* end : {&end0, &end1}) {
            end->x += place.shift;
            end->z -= place.z0;
        }
        work.strips.push_back({static_cast<float>(end0.x), static_cast<float>(end0.z), static_cast<float>(end1.x),
                               static_cast<float>(end1.z)});

        const auto& radiance = own.radiance;
        const auto w0 = static_cast<float>(end0.weight), w1 = static_cast<float>(end1.weight);
        StripShades& shades = work.shades.emplace_back();
        shades.x0 = static_cast<float>(end0.x);
        shades.z0 = static_cast<float>(end0.z);
        shades.dx = static_cast<float>(end1.x - end0.x);
        shades.dz = static_cast<float>(end1.z - end0.z);
        set_values(shades.value0, w0 * radiance[lone] + (1 - w0) * radiance[next], place.deepening * end0.z);
        set_values(shades.difference, w1 * radiance[lone] + (1 - w1) * radiance[last], place.deepening * end1.z);
        for (int i = 0; i < 4; ++i) shades.difference[i] -= shades.value0[i];
        if (needs_samples_) {
            const StripOrigin& from = work.origins.emplace_back(StripOrigin{w0, w1, clusters_.triangles[index], lone});
            const auto& [source, grid] = lights_[index];
            if (source == StripLight::From::points)
                work.lights.push_back(light_of_points(grid, from.weights(0), from.weights(1)));
            else
                work.lights.emplace_back().from = source;
        }
    }

    void set_values(float (&values)[4], Rgb radiance, double z) const {
        values[0] = grid_.channels == 1 ? luminance(radiance) : radiance.r;
        values[1] = radiance.g;
        values[2] = radiance.b;
        values[3] = static_cast<float>(frame_.metres(z));
    }

    // The first sample of a plane, as the axes number hogels and directions.
    struct First {
        std::size_t slow_hogel, fast_hogel, slow_direction;
    };

    void shade_plane(LightFieldTile& tile, const EpipolarPlane& plane, const Work& work, const First& first) const {
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

    void shade_samples(const EpipolarPlane& plane, const Work& work, const First& first, const ShadedPlane& out) const {
        if (needs_samples_)
            shade_lit(plane, work.shades, work.lights, PlaneSamples(*this, work, first), out);
        else
            shade(plane, work.shades, out);
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
            const Sight sight =
                sight_along(grid, grid.u(static_cast<double>(sample.u)), grid.v(static_cast<double>(sample.v)), depth);
            return radiance_at(*renderer_.scene_, from.triangle, b0, b1, b2, sight);
        }

        LightCache::Corners corners(std::size_t strip, std::size_t row, std::size_t column) const override {
            return renderer_.scene_->light_cache->corners(*renderer_.scene_, work_.origins[strip].triangle, row,
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
    std::vector<TriangleLight> lights_;  // in the places of the clusters; empty where all are From::ends
    StripShades background_{0, 0, 1, 0, {}, {}};
    bool needs_samples_ = scene_->lighting || !scene_->textures.empty();
};

}  // namespace

std::unique_ptr<LightFieldSource> make_epi_renderer(std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid) {
    return std::make_unique<EpiRenderer>(std::move(scene), grid);
}

}  // namespace hogel
