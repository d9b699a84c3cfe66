#include <algorithm>
#include <bit>
#include <vector>

#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/epi_internal.h"
#include "hogel/render/epi_kernels_internal.h"
#include "hogel/render/sample_store_internal.h"

namespace hogel {
namespace {

// A strip as shading needs it: its ends in full precision, and where they lie on the triangle. One corner of the
// triangle is alone on its side of the plane; end 0 lies between it and the next corner, end 1 between it and the last.
struct StripOrigin {
    double x0, z0, x1, z1;
    float weight0, weight1;  // of the lone corner, at the two ends
    std::uint32_t triangle;
    std::uint32_t lone;  // 0, 1 or 2
};

// A corner of a triangle with its signed distance from the plane.
struct Corner {
    double x, z, height;
};

struct Cut {
    double x, z, weight;  // weight of the first of the two corners
};

// Where an edge crosses the plane. Always computed from the lower end to the upper, so that the triangles that share
// the edge get the same point.
Cut cut(const Corner& a, const Corner& b) {
    const auto upwards = [](const Corner& low, const Corner& high) {
        const double part = low.height / (low.height - high.height);
        return Cut{low.x + part * (high.x - low.x), low.z + part * (high.z - low.z), part};
    };
    if (!(a.height < 0)) return upwards(b, a);
    const Cut point = upwards(a, b);
    return {point.x, point.z, 1 - point.weight};
}

class EpiRenderer final : public LightFieldSource {
  public:
    EpiRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), frame_(grid), clusters_(*scene_, frame_) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    void read(LightFieldTile& tile) const override {
        std::vector<std::uint64_t, CacheLineAllocator<std::uint64_t>> words(tile.range.ns * grid_.directions_u);
        const EpipolarPlane plane{words.data(), tile.range.ns, grid_.directions_u,
                                  frame_.first_column + static_cast<std::int32_t>(tile.range.s0),
                                  frame_.first_direction};
        Strips strips;
        for (std::size_t v = 0; v < grid_.directions_v; ++v)
            for (std::size_t t = 0; t < tile.range.nt; ++t) {
                cut_triangles(frame_.row(tile.range.t0 + t), frame_.slope(v), strips);
                std::fill(words.begin(), words.end(), EpipolarPlane::nothing);
                draw_plain(strips.drawn, plane);
                for (std::size_t s = 0; s < tile.range.ns; ++s) shade_row(tile, plane, strips.origins, t, s, v);
            }
    }

  private:
    struct Strips {
        std::vector<Strip> drawn;
        std::vector<StripOrigin> origins;
    };

    void cut_triangles(double row, double slope, Strips& strips) const {
        strips.drawn.clear();
        strips.origins.clear();
        for (std::size_t cluster = 0; cluster < clusters_.corners.size(); ++cluster) {
            if (!clusters_.may_cross(cluster, row, slope)) continue;
            std::uint64_t crossed = crossing_plain(clusters_.corners[cluster], row, slope);
            for (; crossed != 0; crossed &= crossed - 1)
                add_strip(cluster, static_cast<std::size_t>(std::countr_zero(crossed)), row, slope, strips);
        }
    }

    void add_strip(std::size_t cluster, std::size_t place, double row, double slope, Strips& strips) const {
        const ClusterCorners& all = clusters_.corners[cluster];
        const auto corner = [&](std::size_t i) {
            // As in `crossing`, to the last bit.
            return Corner{all.x[i][place], all.z[i][place], (all.y[i][place] - slope * all.z[i][place]) - row};
        };
        const std::array corners{corner(0), corner(1), corner(2)};
        const auto below = [&](std::size_t i) { return corners[i].height < 0; };
        const std::uint32_t lone = below(1) == below(2) ? 0 : below(2) == below(0) ? 1 : 2;
        const Cut end0 = cut(corners[lone], corners[(lone + 1) % 3]),
                  end1 = cut(corners[lone], corners[(lone + 2) % 3]);
        strips.drawn.push_back({static_cast<float>(end0.x), static_cast<float>(end0.z), static_cast<float>(end1.x),
                                static_cast<float>(end1.z)});
        strips.origins.push_back({end0.x, end0.z, end1.x, end1.z, static_cast<float>(end0.weight),
                                  static_cast<float>(end1.weight), clusters_.triangles[cluster * cluster_size + place],
                                  lone});
    }

    void shade_row(LightFieldTile& tile, const EpipolarPlane& plane, const std::vector<StripOrigin>& origins,
                   std::size_t t, std::size_t s, std::size_t v) const {
        const double n = plane.first_column + static_cast<double>(s);
        for (std::size_t u = 0; u < plane.directions; ++u) {
            const std::uint64_t word = plane.words[s * plane.directions + u];
            VisiblePoint point;
            if (word != EpipolarPlane::nothing)
                point = seen(origins[word & 0xffffffff], n,
                             static_cast<double>(plane.first_direction) + static_cast<double>(u));
            store(tile, *scene_, point, t, s, v, u);
        }
    }

    VisiblePoint seen(const StripOrigin& strip, double n, double K) const {
        const double c0 = strip.x0 - K * strip.z0, c1 = strip.x1 - K * strip.z1;
        // Single precision decided that the sample is covered, which double precision need not confirm.
        const double part = c0 == c1 ? 0 : std::clamp((n - c0) / (c1 - c0), 0.0, 1.0);
        const auto w = static_cast<float>(part);
        std::array<float, 3> b;
        b[strip.lone] = (1 - w) * strip.weight0 + w * strip.weight1;
        b[(strip.lone + 1) % 3] = (1 - w) * (1 - strip.weight0);
        b[(strip.lone + 2) % 3] = w * (1 - strip.weight1);
        return {strip.triangle, b[0], b[1], b[2], frame_.metres_deep(strip.z0 + part * (strip.z1 - strip.z0))};
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    EpipolarFrame frame_;
    TriangleClusters clusters_;
};

}  // namespace

std::unique_ptr<LightFieldSource> make_epi_renderer(std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid) {
    return std::make_unique<EpiRenderer>(std::move(scene), grid);
}

}  // namespace hogel
