// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/simplex/simploid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hogel/render/oblique_triangle.h"
#include "hogel/render/region_memory.h"
#include "hogel/render/row_axes.h"
#include "hogel/render/span.h"

namespace hogel::render::simplex {
namespace {

// A point (x, ζ) in the plane of the rays of one t and one V, with x counted in hogels from the tile's first, and in
// the same unit the way x goes for a U of one.
struct StripPoint {
    double x = 0, depth = 0;
};

// What the rays of one t and one V can see of a triangle: as a rule the segment between the points where two edges
// cross their plane. In the plane (s, U) each point is a line, and the segment the strip between the two.
struct ThinStrip {
    std::array<StripPoint, 5> points;  // on two edges at most, and at three vertices
    std::size_t count = 0;

    void include(StripPoint p) { points[count++] = p; }
};

// The corners of a triangle for the directions of one V: which row they are seen from, in hogels, and x and ζ.
struct SlidTriangle {
    std::array<double, 3> row;
    std::array<StripPoint, 3> at;

    // Interpolation the places where edges cross the row, and corners within the margin of it.
    ThinStrip cut(double level) const {
        ThinStrip strip;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = i == 2 ? 0 : i + 1;
            if (std::abs(row[i] - level) <= scan_margin) strip.include(at[i]);
            if ((row[i] < level && level < row[j]) || (row[j] < level && level < row[i])) {
                const double part = (level - row[i]) / (row[j] - row[i]);
                strip.include({at[i].x + part * (at[j].x - at[i].x), at[i].depth + part * (at[j].depth - at[i].depth)});
            }
        }
        return strip;
    }
};

// In this file t, V, s and U are the slow and fast axes of RowAxes: on the left and right of a hemicube s, U, t and V.
class SimploidRenderer final : public LightFieldSource {
  public:
    SimploidRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), axes_(grid), triangles_(triangles_with_area(*scene_)) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    void read(LightFieldTile& tile) const override {
        const std::size_t rows = axes_.slow_hogels(tile.range), hogels = axes_.fast_hogels(tile.range);
        const std::size_t directions = axes_.fast_directions();
        // One V at a time, so that what the triangles of a neighbourhood write to stays close together.
        Array<NearestTriangle, 3> buffer(simplex_strip_buffer(axes_, tile.range));
        for (std::size_t slow = 0; slow < axes_.slow_directions(); ++slow) {
            std::ranges::fill(buffer.elements(), NearestTriangle{});
            const Slab slab(*this, tile.range, slow);
            for (std::uint32_t index : triangles_) slab.scan_convert(index, buffer);
            for (std::size_t row = 0; row < rows; ++row)
                for (std::size_t i = 0; i < hogels; ++i)
                    for (std::size_t fast = 0; fast < directions; ++fast) {
                        const auto [t, s, v, u] = axes_.sample(row, i, slow, fast);
                        store(tile, *scene_, grid_, buffer(row, i, fast), t, s, v, u);
                    }
        }
    }

  private:
    // The rays of a tile with one V.
    class Slab {
      public:
        Slab(const SimploidRenderer& renderer, const HogelRange& range, std::size_t slow)
            : scene_(*renderer.scene_), grid_(renderer.grid_), axes_(renderer.axes_), range_(range), slow_(slow) {
            const double pitch = grid_.pitch;
            for (std::size_t k = 0; k < axes_.fast_directions(); ++k) {
                const auto [t, s, v, u] = axes_.sample(0, 0, slow, k);
                const Vec3 way = grid_.direction_of(grid_.u(static_cast<double>(u)), grid_.v(static_cast<double>(v)));
                slopes_.push_back({way.x / way.z, way.y / way.z});
                // dx/dζ of the fast axis, and of the slow one, which is the same for all k.
                fast_slopes_.push_back((axes_.turned() ? slopes_[k].y : slopes_[k].x) * axes_.fast_sign());
                slow_slope_ = axes_.turned() ? slopes_[k].x : slopes_[k].y;
            }
            first_row_ = axes_.slow_hogel(range, 0) / pitch;
            first_hogel_ = axes_.fast_hogel(range, 0) / pitch * axes_.fast_sign();
            rows_ = axes_.slow_hogels(range);
            hogels_ = axes_.fast_hogels(range);
        }

        void scan_convert(std::uint32_t index, Array<NearestTriangle, 3>& buffer) const {
            const SlidTriangle slid = slide(index);
            const auto [low, high] = std::minmax({slid.row[0], slid.row[1], slid.row[2]});
            const Span rows = samples_between(low, high, rows_);
            for (std::size_t row = rows.first; row < rows.end; ++row) {
                const ThinStrip strip = slid.cut(static_cast<double>(row));
                if (strip.count > 0) scan_convert(index, strip, row, buffer[row]);
            }
        }

      private:
        SlidTriangle slide(std::uint32_t index) const {
            SlidTriangle slid;
            const auto& vertices = scene_.triangles[index].vertices;
            const double row_sign = -axes_.fast_sign();  // t is counted downwards, s to the right
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3& p = scene_.positions[vertices[i]];
                const double depth = -p.z / grid_.pitch;
                const double fast = (axes_.turned() ? p.y : p.x) / grid_.pitch;
                const double slow = (axes_.turned() ? p.x : p.y) / grid_.pitch;
                slid.row[i] = row_sign * (slow - slow_slope_ * depth - first_row_);
                slid.at[i] = {axes_.fast_sign() * fast - first_hogel_, depth};
            }
            return slid;
        }

        void scan_convert(std::uint32_t index, const ThinStrip& strip, std::size_t row,
                          View<NearestTriangle, 2> buffer) const {
            const Span columns = columns_of_directions(strip);
            for (std::size_t k = columns.first; k < columns.end; ++k) {
                double low = std::numeric_limits<double>::infinity(), high = -low;
                for (std::size_t i = 0; i < strip.count; ++i) {
                    const double s = strip.points[i].x - fast_slopes_[k] * strip.points[i].depth;
                    low = std::min(low, s);
                    high = std::max(high, s);
                }
                const Span hogels = samples_between(low, high, hogels_);
                if (hogels.first == hogels.end) continue;
                const ObliqueTriangle triangle(scene_, index, slopes_[k].x, slopes_[k].y);
                for (std::size_t i = hogels.first; i < hogels.end; ++i) {
                    const auto [at_t, at_s, at_v, at_u] = axes_.sample(row, i, slow_, k);
                    see(buffer(i, k), index, triangle, grid_.s(static_cast<double>(range_.s0 + at_s)),
                        grid_.t(static_cast<double>(range_.t0 + at_t)));
                }
            }
        }

        // The directions in which hogels of the tile may see a strip; all where it comes close to the hologram, whose
        // points have no direction.
        Span columns_of_directions(const ThinStrip& strip) const {
            constexpr double least = 1e-3, infinity = std::numeric_limits<double>::infinity();
            double low = infinity, high = -infinity, shallow = infinity, deep = -infinity;
            for (std::size_t i = 0; i < strip.count; ++i) {
                const auto [x, depth] = strip.points[i];
                shallow = std::min(shallow, depth);
                deep = std::max(deep, depth);
                const double from = x / depth, to = (x - static_cast<double>(hogels_ - 1)) / depth;
                low = std::min({low, from, to});
                high = std::max({high, from, to});
            }
            if ((shallow < least && deep > -least) || fast_slopes_.size() == 1) return {0, fast_slopes_.size()};
            const double step = fast_slopes_[1] - fast_slopes_[0];
            return samples_between((low - fast_slopes_[0]) / step, (high - fast_slopes_[0]) / step,
                                   fast_slopes_.size());
        }

        const ShadedScene& scene_;
        const LightFieldGrid& grid_;
        const RowAxes& axes_;
        const HogelRange& range_;
        std::size_t slow_;
        std::size_t rows_ = 0, hogels_ = 0;
        double first_row_ = 0, first_hogel_ = 0, slow_slope_ = 0;
        struct Slopes {
            double x, y;  // by depth
        };
        std::vector<Slopes> slopes_;
        std::vector<double> fast_slopes_;
    };

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    RowAxes axes_;
    std::vector<std::uint32_t> triangles_;
};
}  // namespace

std::unique_ptr<LightFieldSource> make_simploid_renderer(std::shared_ptr<const ShadedScene> scene,
                                                         const LightFieldGrid& grid) {
    return std::make_unique<SimploidRenderer>(std::move(scene), grid);
}

}  // namespace hogel::render::simplex
