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

// After so many strips it is first looked which samples are covered; then whenever their number has doubled.
constexpr std::size_t first_update = 128;

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
        : scene_(std::move(scene)), grid_(grid), frame_(grid), clusters_(*scene_, frame_) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    // Whole rows if they are not too large, or else parts of equal length; several rows if they are small.
    HogelRange preferred_tile() const override {
        const std::size_t hogel_bytes = (grid_.channels + 1) * grid_.directions() * sizeof(float);
        const std::size_t most = std::max<std::size_t>(1, most_tile_bytes / hogel_bytes);
        const std::size_t parts = (grid_.hogels_s + most - 1) / most, ns = (grid_.hogels_s + parts - 1) / parts;
        const std::size_t rows = std::max<std::size_t>(1, default_tile(grid_).hogels() / ns);
        return {0, 0, ns, std::min(grid_.hogels_t, rows)};
    }

    void read(LightFieldTile& tile) const override {
        const std::size_t columns = std::min(tile.range.ns, std::max<std::size_t>(16, most_words / grid_.directions_u));
        std::vector<std::uint64_t, CacheLineAllocator<std::uint64_t>> words(columns * grid_.directions_u);
        Work work;
        for (std::size_t v = 0; v < grid_.directions_v; ++v)
            for (std::size_t t = 0; t < tile.range.nt; ++t) {
                for (std::size_t s = 0; s < tile.range.ns; s += columns) {
                    const EpipolarPlane plane{words.data(), std::min(columns, tile.range.ns - s), grid_.directions_u,
                                              frame_.first_column + static_cast<std::int32_t>(tile.range.s0 + s),
                                              frame_.first_direction};
                    std::fill(words.begin(), words.end(), EpipolarPlane::nothing);
                    draw_plane(plane, frame_.row(tile.range.t0 + t), frame_.slope(v), work);
                    shade_plane(tile, plane, work, t, s, v);
                }
            }
    }

  private:
    // The strips of one epipolar plane.
    struct Work {
        std::vector<Strip> strips;
        std::vector<StripEnds> ends;
        std::vector<StripOrigin> origins;
        Occlusion occlusion;
    };

    // From front to back, and what has been drawn hides what is behind it, cluster by cluster.
    void draw_plane(const EpipolarPlane& plane, double row, double slope, Work& work) const {
        work.strips.clear();
        work.ends.clear();
        work.origins.clear();
        work.occlusion.clear();
        std::size_t drawn = 0, next_update = first_update;
        const auto draw_rest = [&] {
            draw(std::span(work.strips).subspan(drawn), drawn, plane);
            drawn = work.strips.size();
        };
        for (const TriangleClusters::Group& group : clusters_.groups) {
            if (!group.bounds.may_cross(row, slope) || work.occlusion.hides(group.bounds, plane)) continue;
            for (const std::uint32_t cluster : group.clusters) {
                const TriangleClusters::Bounds& bounds = clusters_.bounds[cluster];
                if (!bounds.may_cross(row, slope) || work.occlusion.hides(bounds, plane)) continue;
                std::uint64_t crossed = crossing(clusters_.corners[cluster], row, slope);
                for (; crossed != 0; crossed &= crossed - 1)
                    add_strip(cluster, static_cast<std::size_t>(std::countr_zero(crossed)), row, slope, work);
            }
            if (work.strips.size() < next_update) continue;
            draw_rest();
            work.occlusion.update(plane);
            next_update = 2 * drawn;
        }
        draw_rest();
    }

    void add_strip(std::size_t cluster, std::size_t place, double row, double slope, Work& work) const {
        const ClusterCorners& all = clusters_.corners[cluster];
        std::array<double, 3> x, z, height;
        for (std::size_t i = 0; i < 3; ++i) {
            x[i] = all.x[i][place];
            z[i] = all.z[i][place];
            // As in `crossing`, to the last bit.
            height[i] = (all.y[i][place] - slope * z[i]) - row;
        }
        const auto [lone, next, last, end0, end1] = cut_triangle(x, z, height);
        work.strips.push_back({static_cast<float>(end0.x), static_cast<float>(end0.z), static_cast<float>(end1.x),
                               static_cast<float>(end1.z)});

        const std::size_t index = cluster * cluster_size + place;
        const auto& radiance = clusters_.radiance[index];
        const auto w0 = static_cast<float>(end0.weight), w1 = static_cast<float>(end1.weight);
        StripEnds& ends = work.ends.emplace_back(StripEnds{end0.x, end1.x, end0.z, end1.z, {}, {}});
        set_values(ends.value0, w0 * radiance[lone] + (1 - w0) * radiance[next], end0.z);
        set_values(ends.value1, w1 * radiance[lone] + (1 - w1) * radiance[last], end1.z);
        if (needs_samples_) work.origins.push_back({w0, w1, clusters_.triangles[index], lone});
    }

    void set_values(float (&values)[4], Rgb radiance, double z) const {
        values[0] = grid_.channels == 1 ? luminance(radiance) : radiance.r;
        values[1] = radiance.g;
        values[2] = radiance.b;
        values[3] = static_cast<float>(frame_.metres_deep(z));
    }

    void shade_plane(LightFieldTile& tile, const EpipolarPlane& plane, const Work& work, std::size_t t, std::size_t s,
                     std::size_t v) const {
        const std::size_t stride = grid_.directions();
        const bool colour = grid_.channels == 3;
        const ShadedPlane out{{&tile.radiance(0, t, s, v, 0), colour ? &tile.radiance(1, t, s, v, 0) : nullptr,
                               colour ? &tile.radiance(2, t, s, v, 0) : nullptr,
                               tile.depth.size() > 0 ? &tile.depth(t, s, v, 0) : nullptr},
                              {stride, stride, stride, stride}};
        const Rgb& b = scene_->background;
        const float background[4] = {colour ? b.r : luminance(b), b.g, b.b, std::numeric_limits<float>::infinity()};
        shade(plane, work.ends, background, out);
        if (needs_samples_)
            for (std::size_t column = 0; column < plane.columns; ++column)
                shade_samples(tile, plane, column, work, t, s + column, v);
    }

    // Once more the samples for which interpolating the vertices' radiance is not enough.
    void shade_samples(LightFieldTile& tile, const EpipolarPlane& plane, std::size_t column, const Work& work,
                       std::size_t t, std::size_t s, std::size_t v) const {
        const double n = plane.first_column + static_cast<double>(column), K = plane.first_direction;
        for (std::size_t u = 0; u < plane.directions; ++u) {
            const std::uint64_t word = plane.words[column * plane.directions + u];
            if (word == EpipolarPlane::nothing) continue;
            const std::size_t number = word & 0xffffffff;
            const StripOrigin& from = work.origins[number];
            if (!scene_->needs_samples(from.triangle)) continue;
            const StripEnds& strip = work.ends[number];
            const float w = part_of_strip(strip, n, K + static_cast<double>(u));
            std::array<float, 3> b;
            b[from.lone] = (1 - w) * from.weight0 + w * from.weight1;
            b[(from.lone + 1) % 3] = (1 - w) * (1 - from.weight0);
            b[(from.lone + 2) % 3] = w * (1 - from.weight1);
            const float depth = strip.value0[3] + w * (strip.value1[3] - strip.value0[3]);
            store(tile, *scene_, grid_, {from.triangle, b[0], b[1], b[2], depth}, t, s, v, u);
        }
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    EpipolarFrame frame_;
    TriangleClusters clusters_;
    bool needs_samples_ = scene_->lighting || !scene_->textures.empty();
};

}  // namespace

std::unique_ptr<LightFieldSource> make_epi_renderer(std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid) {
    return std::make_unique<EpiRenderer>(std::move(scene), grid);
}

}  // namespace hogel
