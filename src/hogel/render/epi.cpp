#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/epi_cut_internal.h"
#include "hogel/render/epi_internal.h"
#include "hogel/render/epi_kernels_internal.h"
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
};

class EpiRenderer final : public LightFieldSource {
  public:
    EpiRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), axes_(grid), frame_(grid), clusters_(*scene_, frame_) {
        set_values(background_.value0, scene_->background, std::numeric_limits<double>::infinity());
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
                        shade_turned_plane(tile, plane, work, row, column, slow);
                    else
                        shade_plane(tile, plane, work, row, column, slow);
                }
            }
    }

  private:
    // The strips of one epipolar plane; number 0 is the background.
    struct Work {
        std::vector<Strip> strips;
        std::vector<StripShades> shades;
        std::vector<StripOrigin> origins;
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
        if (needs_samples_) work.origins.push_back({w0, w1, clusters_.triangles[index], lone});
    }

    void set_values(float (&values)[4], Rgb radiance, double z) const {
        values[0] = grid_.channels == 1 ? luminance(radiance) : radiance.r;
        values[1] = radiance.g;
        values[2] = radiance.b;
        values[3] = static_cast<float>(frame_.metres(z));
    }

    void shade_plane(LightFieldTile& tile, const EpipolarPlane& plane, const Work& work, std::size_t t, std::size_t s,
                     std::size_t v) const {
        const std::size_t stride = grid_.directions();
        const bool colour = grid_.channels == 3;
        const ShadedPlane out{{&tile.radiance(0, t, s, v, 0), colour ? &tile.radiance(1, t, s, v, 0) : nullptr,
                               colour ? &tile.radiance(2, t, s, v, 0) : nullptr,
                               tile.depth.size() > 0 ? &tile.depth(t, s, v, 0) : nullptr},
                              {stride, stride, stride, stride}};
        shade(plane, work.shades, out);
        shade_samples(tile, plane, work, t, s, v);
    }

    // The same where a row of directions is a column of the tile's.
    void shade_turned_plane(LightFieldTile& tile, const EpipolarPlane& plane, Work& work, std::size_t row,
                            std::size_t first, std::size_t slow) const {
        ShadedPlane out{};
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == 3 ? tile.depth.size() == 0 : i >= grid_.channels) continue;
            work.turned[i].resize(plane.columns * plane.directions);
            out.values[i] = work.turned[i].data();
            out.strides[i] = plane.directions;
        }
        shade(plane, work.shades, out);
        for (std::size_t i = 0; i < 4; ++i) {
            if (!out.values[i]) continue;
            for (std::size_t column = 0; column < plane.columns; ++column) {
                float* to = i == 3 ? &tile.depth(first + column, row, 0, slow)
                                   : &tile.radiance(i, first + column, row, 0, slow);
                const float* from = out.values[i] + column * plane.directions;
                for (std::size_t k = 0; k < plane.directions; ++k) to[k * grid_.directions_u] = from[k];
            }
        }
        shade_samples(tile, plane, work, row, first, slow);
    }

    // Once more the samples for which interpolating the vertices' radiance is not enough.
    void shade_samples(LightFieldTile& tile, const EpipolarPlane& plane, const Work& work, std::size_t row,
                       std::size_t first, std::size_t slow) const {
        if (!needs_samples_) return;
        for (std::size_t i = 0; i < plane.columns * plane.directions; ++i) {
            if (plane.words[i] == EpipolarPlane::nothing) continue;
            const std::size_t column = i / plane.directions, k = i % plane.directions;
            const std::size_t number = plane.words[i] & 0xffffffff;
            const StripOrigin& from = work.origins[number];
            if (!scene_->needs_samples(from.triangle)) continue;
            const StripShades& strip = work.shades[number];
            const float w = part_of_strip(strip, static_cast<float>(plane.first_column) + static_cast<float>(column),
                                          plane.first_direction + static_cast<float>(k));
            std::array<float, 3> b;
            b[from.lone] = (1 - w) * from.weight0 + w * from.weight1;
            b[(from.lone + 1) % 3] = (1 - w) * (1 - from.weight0);
            b[(from.lone + 2) % 3] = w * (1 - from.weight1);
            const float depth = strip.value0[3] + w * strip.difference[3];
            const auto [t, s, v, u] = axes_.sample(row, first + column, slow, k);
            store(tile, *scene_, grid_, {from.triangle, b[0], b[1], b[2], depth}, t, s, v, u);
        }
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    RowAxes axes_;
    EpipolarFrame frame_;
    TriangleClusters clusters_;
    StripShades background_{0, 0, 1, 0, {}, {}};
    bool needs_samples_ = scene_->lighting || !scene_->textures.empty();
};

}  // namespace

std::unique_ptr<LightFieldSource> make_epi_renderer(std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid) {
    return std::make_unique<EpiRenderer>(std::move(scene), grid);
}

}  // namespace hogel
