// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/array.h"
#include "hogel/geometry.h"
#include "hogel/progress.h"
namespace hogel {

/// The sides of a hemicube around a hogel ([K] 4.1): each looks at a part of the directions in a perspective of its
/// own. The front looks along +ζ, right and left along +x and −x, top and bottom along +y and −y. Of the four sides
/// only the half with ζ > 0 is used.
enum class Face { front, left, right, top, bottom };

inline constexpr std::array all_faces{Face::front, Face::left, Face::right, Face::top, Face::bottom};

/// The word for a face, as in files.
constexpr std::string_view name(Face face) {
    constexpr std::array<std::string_view, 5> names{"front", "left", "right", "top", "bottom"};
    return names[static_cast<std::size_t>(face)];
}

/// (x, y, ζ), relative to a hogel, as the face sees it: to the right in its picture, up, and forward. A rotation; the
/// five pictures side by side, the front in the middle, continue each other without a jump.
constexpr Vec3 to_face(Face face, Vec3 p) {
    switch (face) {
        case Face::left:
            return {p.z, p.y, -p.x};
        case Face::right:
            return {-p.z, p.y, p.x};
        case Face::top:
            return {p.x, -p.z, p.y};
        case Face::bottom:
            return {p.x, p.z, -p.y};
        case Face::front:
            break;
    }
    return p;
}

/// The way back: what the face sees right, up and forward, as (x, y, ζ).
constexpr Vec3 from_face(Face face, Vec3 q) {
    switch (face) {
        case Face::left:
            return {-q.z, q.y, q.x};
        case Face::right:
            return {q.z, q.y, -q.x};
        case Face::top:
            return {q.x, q.z, -q.y};
        case Face::bottom:
            return {q.x, -q.z, q.y};
        case Face::front:
            break;
    }
    return q;
}

/// In what a light field's directions are uniform.
enum class Spacing {
    tangents,  ///< U and V, as in a picture in perspective
    sines,     ///< U and V over √(1 + U² + V²), as the frequencies of one wavelength's plane waves are: [K] 4.1
};

/// How a light field L[c][t][s][v][u] is sampled (docs/notation.md, section 1). A ray crosses the hologram
/// plane at the centre (s, t) of a hogel and runs along x = s + Uζ, y = t + Vζ. Perspective directions: uniform in U
/// and V. On a side of a hemicube U and V are those of the face's own picture: right/forward and up/forward. Where
/// directions are spaced by sines, all that is said of U and V below is said of their sines.
struct LightFieldGrid {
    std::size_t hogels_s = 0, hogels_t = 0;          ///< S columns, T rows of hogels
    double pitch = 0;                                ///< d, metres between hogels
    std::size_t directions_u = 0, directions_v = 0;  ///< n_U, n_V samples of direction
    double tan_half_u = 0, tan_half_v = 0;           ///< |U - center_u| <= tan_half_u, |V - center_v| <= tan_half_v
    std::size_t channels = 3;                        ///< 1, or 3 for R, G, B
    double center_u = 0, center_v = 0;               ///< middle of the directions
    Face face = Face::front;                         ///< in whose picture directions are uniform
    Spacing spacing = Spacing::tangents;             ///< sines: the front alone

    double s(double i) const { return (i + 0.5 - 0.5 * static_cast<double>(hogels_s)) * pitch; }
    double t(double j) const { return (0.5 * static_cast<double>(hogels_t) - j - 0.5) * pitch; }
    double step_u() const { return 2 * tan_half_u / static_cast<double>(directions_u); }  ///< ΔU
    double step_v() const { return 2 * tan_half_v / static_cast<double>(directions_v); }  ///< ΔV
    double u(double k) const { return center_u + (k + 0.5 - 0.5 * static_cast<double>(directions_u)) * step_u(); }
    double v(double l) const { return center_v + (0.5 * static_cast<double>(directions_v) - l - 0.5) * step_v(); }
    /// The way back: the column of directions at U, the row at V, whole numbers at samples.
    double column(double U) const {
        return (U - center_u) / step_u() + (0.5 * static_cast<double>(directions_u) - 0.5);
    }
    double row(double V) const { return (0.5 * static_cast<double>(directions_v) - 0.5) - (V - center_v) / step_v(); }
    /// The way along the ray (U, V) as (x, y, ζ), one step forward as the face looks: (U, V, 1) for the front;
    /// nought where sines are those of no ray.
    Vec3 direction_of(double U, double V) const;
    /// Whether the way (x, y, ζ) from a hogel is one of the directions, or in the cell around one.
    bool covers(Vec3 way) const;
    std::size_t directions() const { return directions_u * directions_v; }
    std::size_t hogels() const { return hogels_s * hogels_t; }
    double samples() const { return static_cast<double>(channels * directions()) * static_cast<double>(hogels()); }
    friend bool operator==(const LightFieldGrid&, const LightFieldGrid&) = default;
};

/// Throws Error(code) naming `what` and the member that is wrong: nothing to sample, not finite, not positive, or more
/// samples than can be addressed.
void validate(const LightFieldGrid& grid, ErrorCode code, const std::string& what);

/// Throws Error(code) where directions are spaced by sines, which `what` cannot do.
void require_tangents(const LightFieldGrid& grid, ErrorCode code, const std::string& what);

/// Whether two light fields have the same hogels in the same places, and as many channels.
bool same_hogels(const LightFieldGrid& a, const LightFieldGrid& b);

/// The five faces of a hemicube around the hogels of `grid`, front first: all directions with ζ > 0, the front |U|, |V|
/// <= 1 with the directions of `grid`, the sides with as many along the front's edges and half as many away from it.
/// Of one row of directions a hemisquare, for horizontal parallax only: the front and its sides left and right, each
/// with the row V = 0. Throws Error(usage) unless the numbers of directions are even, or that of rows one.
std::vector<LightFieldGrid> hemicube(const LightFieldGrid& grid);

/// A rectangle of hogels with all their directions: the unit of work.
struct HogelRange {
    std::size_t s0 = 0, t0 = 0;  ///< first column and row of hogels
    std::size_t ns = 0, nt = 0;  ///< columns and rows of hogels

    std::size_t hogels() const { return ns * nt; }
    friend bool operator==(const HogelRange&, const HogelRange&) = default;
};

/// The values of a range of hogels. `radiance` has shape [c][nt][ns][n_V][n_U]; `depth` (ζ in metres, +infinity where
/// the ray meets nothing) has shape [nt][ns][n_V][n_U], or no elements where nobody asked for it.
struct LightFieldTile {
    HogelRange range;
    Array<float, 5> radiance;
    Array<float, 4> depth;

    LightFieldTile() = default;
    LightFieldTile(const LightFieldGrid& grid, const HogelRange& r, bool with_depth);
};

/// Throws Error(usage) when a tile's range is empty or leaves the grid, or its arrays do not have the range's shapes.
void validate(const LightFieldTile& tile, const LightFieldGrid& grid);

/// The size of tile that suits most sources: as many hogels as about 16 MiB of samples hold, 1×1 at least.
HogelRange default_tile(const LightFieldGrid& grid);

/// Copies the hogels that two tiles have in common, with depth where both have it: of `from` the directions from row
/// first_v and column first_u on, as many as `to` has.
void copy_common(const LightFieldTile& from, LightFieldTile& to, std::size_t first_v = 0, std::size_t first_u = 0);

/// Where light fields come from: memory, a file, a decoder, a renderer working on demand. read() may be called from
/// several threads at once and gives the same values for a hogel whatever the range it is asked for in.
class LightFieldSource {
  public:
    virtual ~LightFieldSource() = default;
    virtual const LightFieldGrid& grid() const = 0;
    virtual bool has_depth() const { return false; }
    /// The size of tile (s0 = t0 = 0) that this source reads at the least cost per hogel; any other works too.
    virtual HogelRange preferred_tile() const { return default_tile(grid()); }
    /// All radiances where they lie, [c][t][s][v][u], if they are whole in memory; otherwise no elements.
    virtual View<const float, 5> in_memory() const { return {}; }
    /// Fills the tile's radiance for tile.range, and its depth where the tile has room for it and has_depth().
    virtual void read(LightFieldTile& tile) const = 0;
};

/// Where light fields go. write() may be called from several threads at once, each hogel once.
class LightFieldSink {
  public:
    virtual ~LightFieldSink() = default;
    virtual void write(const LightFieldTile& tile) = 0;
    /// Whether write() has a use for depth.
    virtual bool wants_depth() const { return true; }
    /// Whether the sink goes on with earlier work in which this very tile was written; then it counts as written now.
    virtual bool has_already(const HogelRange&) { return false; }
    /// Called once after the last tile; a file appears under its own name only now.
    virtual void finish() {}
};

/// A light field that is whole in memory: source and sink.
class LightFieldBuffer final : public LightFieldSource, public LightFieldSink {
  public:
    explicit LightFieldBuffer(const LightFieldGrid& grid, bool with_depth = false);
    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return depth.size() > 0; }
    View<const float, 5> in_memory() const override { return radiance.view(); }
    void read(LightFieldTile& tile) const override;
    void write(const LightFieldTile& tile) override;
    bool wants_depth() const override { return has_depth(); }

    Array<float, 5> radiance;  ///< [c][t][s][v][u]
    Array<float, 4> depth;     ///< [t][s][v][u], metres; empty without depth

  private:
    LightFieldGrid grid_;
};

/// Streams a light field from a source to a sink in the source's preferred tiles on all threads; memory: a tile a
/// thread. Calls finish().
void copy(const LightFieldSource& source, LightFieldSink& sink, const Progress& progress = {});

/// The same light field, for readers whose tiles suit the source badly, such as narrow ones of a renderer that is fast
/// in long rows: it is read in tiles that suit, and those used last are kept, `bytes` of them at most. Where the tiles
/// that a reader asks for would not fit, it reads from the source itself. Depths are kept if `with_depth`, else read
/// from the source.
std::unique_ptr<LightFieldSource> cached_tiles(std::unique_ptr<LightFieldSource> source, double bytes,
                                               bool with_depth = false);

}  // namespace hogel
