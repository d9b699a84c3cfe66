// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/setup.h"
#include "hogel/shading/radiance_cache.h"

namespace hogel::render::epi {

/// Where the samples of a strip have their light from.
enum class LightFrom : std::uint32_t {
    ends,     ///< interpolated between the values of the strip's ends
    points,   ///< the light that is kept on its triangle is all of their radiance; the values of the ends have none
    samples,  ///< each is asked for
};

/// How a strip LightFrom::points crosses the grid on its triangle (LightGrid).
struct StripLight {
    /// Rows and columns: `towards` and `last` at end 0, and from there to end 1.
    float place[2], change[2];
    shading::LightGrid::Axis axis[2];
    const std::uint32_t* points;
    std::uint32_t down, right;  ///< words from a point to the next, where there are several

    StripLight(const shading::LightGrid& grid, const StripOrigin& strip);
    /// So many cells along the strip are at most half as long as those of the grid, unless they were more than
    /// `max_cells`.
    float cells() const;
    static constexpr float max_cells = 1 << 16, per_cell = 2;
};

/// What is worked out for single samples, points and strips while a plane is shaded.
class SampleSource {
  public:
    virtual ~SampleSource() = default;
    /// The radiance of sample (column, k) of the plane, `part` of the way along a strip LightFrom::samples.
    virtual Rgb radiance(std::size_t strip, float part, std::size_t column, std::size_t k) const = 0;
    /// Where the strips lie on their triangles, and the grids on those. For strips LightFrom::points.
    struct Grids {
        const StripOrigin* of_strips;
        const shading::LightGrid* of_triangles;
    };
    virtual Grids grids() const = 0;
    /// The light of four points that are not made yet (RadianceCache::corners).
    virtual shading::RadianceCache::Corners corners(std::size_t strip, std::size_t row, std::size_t column) const = 0;
};

/// What the strips of one plane show where they do not all have their light from their ends: each has nodes at equal
/// distances along it, and between two nodes all values are linear. Nodes of strips LightFrom::points are made of what
/// is kept on their triangles, once it is known which strips are seen; there are far fewer nodes than samples.
class LitStrips {
  public:
    /// R, G, B (or the only channel first), depth ζ in metres: NaN of a node that has yet to be made.
    using Node = std::array<float, 4>;
    /// All that is asked for each sample, side by side.
    struct alignas(32) Line {
        float x0, z0, dx, dz;  ///< of StripShades
        std::uint32_t first;   ///< number of its first node, less the bits of LightGrid::to_whole
        float cells, last;     ///< how many there are, one less than nodes; as of LightGrid::Axis
        LightFrom from;

        /// @param first_node  `unmade` where the strip has none yet
        void set_nodes(std::uint32_t first_node, float count) {
            first = first_node - std::bit_cast<std::uint32_t>(shading::LightGrid::to_whole);
            cells = count;
            last = count - 1.25f;
        }
        std::uint32_t first_node() const { return first + std::bit_cast<std::uint32_t>(shading::LightGrid::to_whole); }
    };
    /// Where part of the way along a strip lies.
    struct Place {
        std::uint32_t cell;
        float beyond;

        Place(const Line& line, float part) {
            const float at = part * line.cells;
            const float rounded = std::min(at - 0.5f, line.last) + shading::LightGrid::to_whole;
            cell = std::bit_cast<std::uint32_t>(rounded) & shading::LightGrid::node_bits;
            beyond = at - (rounded - shading::LightGrid::to_whole);
        }
    };
    /// Two nodes that are never made.
    static constexpr std::uint32_t unmade = 0;

    /// Forgets all strips but number 0, the background, whose depth is nobody's business here: it may be infinite.
    void clear(const StripShades& background);
    void add_lit_at_ends(const StripShades& strip);
    /// @param from  not LightFrom::ends
    void add_lit(const StripShades& strip, LightFrom from);

    const Line* lines() const { return lines_.data(); }
    const Node* nodes() const { return nodes_.data(); }
    Node* nodes() { return nodes_.data(); }
    /// Gives strip `number`, LightFrom::points, nodes, which hold anything at first, or which have yet to be made.
    /// Returns the number of the first.
    std::uint32_t add_nodes(std::size_t number, float cells);
    void add_unmade_nodes(std::size_t number, float cells);

    /// Whether there are strips LightFrom::points, and for each strip whether it is one that has no nodes yet.
    bool has_points() const { return has_points_; }
    std::uint8_t* waits() { return waits_.data(); }

  private:
    void add_line(const StripShades& strip, LightFrom from, std::uint32_t first_node);
    std::uint32_t take_nodes(std::size_t count);

    std::vector<Line, CacheLineAllocator<Line>> lines_;
    std::vector<Node, CacheLineAllocator<Node>> nodes_;  // of which so many are in use:
    std::size_t used_ = 0;
    std::vector<std::uint8_t> waits_;
    bool has_points_ = false;
};

/// Makes nodes of all strips that these words show and that wait, as far as no points have to be made for it, and not
/// of strips of very many cells, of which little may be seen. Strips of which some are missing have them when a sample
/// needs them.
void make_nodes_of_seen(std::span<const std::uint64_t> words, std::span<const StripShades> strips, LitStrips& lit,
                        const SampleSource& samples, bool colour);

/// Makes the nodes around part of strip `number`, LightFrom::points, of which some are missing.
void make_nodes_around(float part, std::size_t number, const StripShades& strip, LitStrips& lit,
                       const SampleSource& samples, bool colour);

/// As `shade` (epi_kernels_internal.h). `lit` has as many strips. Twins that give the same bits.
void shade_lit_plain(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
                     const SampleSource& samples, const ShadedPlane& out);
void shade_lit(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
               const SampleSource& samples, const ShadedPlane& out);

}  // namespace hogel::render::epi
