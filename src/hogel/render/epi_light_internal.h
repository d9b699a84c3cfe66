#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/core/array.h"
#include "hogel/render/epi_kernels_internal.h"
#include "hogel/shading/light_cache.h"

namespace hogel {

/// Where the samples of a strip have their light from.
enum class LightFrom : std::uint32_t {
    ends,     ///< interpolated between the values of the strip's ends
    points,   ///< the light that is kept on its triangle is all of their radiance; the values of the ends have none
    samples,  ///< each is asked for
};

/// How a strip LightFrom::points crosses the grid on its triangle (LightGrid).
struct alignas(64) StripLight {
    /// Rows and columns: `towards` and `last` at end 0, and from there to end 1.
    float place[2], change[2];
    float scale[2], last_cell[2];  ///< of LightGrid::Axis
    const std::uint32_t* points;
    std::uint32_t down, right;  ///< words from a point to the next, where there are several

    /// @param weights0, weights1  of the triangle's vertices, at the strip's ends
    void set(const LightGrid& grid, const std::array<float, 3>& weights0, const std::array<float, 3>& weights1) {
        const LightGrid::Axis rows(grid.rows), columns(grid.columns);
        place[0] = grid.towards(weights0);
        place[1] = grid.last(weights0);
        change[0] = grid.towards(weights1) - place[0];
        change[1] = grid.last(weights1) - place[1];
        scale[0] = rows.scale;
        scale[1] = columns.scale;
        last_cell[0] = rows.last;
        last_cell[1] = columns.last;
        points = grid.points;
        down = grid.rows > 0 ? grid.down : 0;
        right = grid.columns > 0 ? grid.right : 0;
    }

    /// So many cells along the strip are at most half as long as those of the grid, unless they were more than
    /// `most_cells`.
    float cells() const;
    static constexpr float most_cells = 1 << 16;
};

/// What is worked out for single samples, points and strips while a plane is shaded.
class SampleSource {
  public:
    virtual ~SampleSource() = default;
    /// The radiance of sample (column, k) of the plane, `part` of the way along a strip LightFrom::samples.
    virtual Rgb radiance(std::size_t strip, float part, std::size_t column, std::size_t k) const = 0;
    /// Of a strip LightFrom::points.
    virtual void find_light(std::size_t strip, StripLight& light) const = 0;
    /// The light of four points that are not made yet (LightCache::corners).
    virtual LightCache::Corners corners(std::size_t strip, std::size_t row, std::size_t column) const = 0;
};

/// What the strips of one plane show where they do not all have their light from their ends: each has nodes at equal
/// distances along it, and between two nodes all values are linear. Nodes of strips LightFrom::points are made of what
/// is kept on their triangles when the first sample needs them; there are far fewer nodes that are seen than samples.
class LitStrips {
  public:
    /// R, G, B (or the only channel first), depth ζ in metres: NaN of a node that has yet to be made.
    using Node = std::array<float, 4>;
    struct Line {
        std::uint32_t first;  ///< node, of cells + 1; of `unmade` where the strip has none yet
        float cells, last;    ///< how many there are, and the number of the last
        LightFrom from;
    };
    /// Where part of the way along a strip lies.
    struct Place {
        float cell, beyond;

        Place(const Line& line, float part)
            : cell(std::min(static_cast<float>(static_cast<std::int32_t>(part * line.cells)), line.last)),
              beyond(part * line.cells - cell) {}
    };
    /// Two nodes that are never made.
    static constexpr std::uint32_t unmade = 0;

    /// Forgets all strips but number 0, the background, whose depth is nobody's business here: it may be infinite.
    void clear(const StripShades& background);
    void add_lit_at_ends(const StripShades& strip);
    /// @param from  not LightFrom::ends
    void add_lit(LightFrom from) { lines_.push_back({unmade, 1, 0, from}); }

    const Line* lines() const { return lines_.data(); }
    const Node* nodes() const { return nodes_.data(); }
    Node* nodes() { return nodes_.data(); }
    /// Of strip `number`, LightFrom::points, which from now on has nodes.
    const StripLight& light(std::size_t number, const SampleSource& samples);

  private:
    std::vector<Line> lines_;
    std::vector<Node, CacheLineAllocator<Node>> nodes_;
    std::vector<StripLight> lights_;  // of strips that have nodes of points, under their numbers
};

/// As `shade` (epi_kernels_internal.h). `lit` has as many strips. Twins that give the same bits.
void shade_lit_plain(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
                     const SampleSource& samples, const ShadedPlane& out);
void shade_lit(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
               const SampleSource& samples, const ShadedPlane& out);

}  // namespace hogel
