// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hogel/array.h"
#include "hogel/export.h"
#include "hogel/geometry.h"
#include "hogel/progress.h"
#include "hogel/provenance.h"

namespace hogel {

/// Faces of a hemicube around a hogel ([K] 4.1). Each is a perspective picture of some of the directions: the front
/// looks along +ζ, right and left along +x and −x, top and bottom along +y and −y. Sides have only ζ > 0.
enum class Face { front, left, right, top, bottom };

inline constexpr std::array all_faces{Face::front, Face::left, Face::right, Face::top, Face::bottom};

/// Returns the name of a face, as stored in files.
constexpr std::string_view face_name(Face face) {
    constexpr std::array<std::string_view, 5> names{"front", "left", "right", "top", "bottom"};
    return names[static_cast<std::size_t>(face)];
}

/// Rotates a vector (x, y, ζ) from a hogel into the frame of a face: right in its picture, up, and forward. In a cross
/// with the front in the middle, the five pictures are continuous across their edges.
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

/// Rotates (right, up, forward) of a face into (x, y, ζ); the inverse of to_face().
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

/// A range of directions: |U − center_u| <= half_u and |V − center_v| <= half_v.
struct DirectionRange {
    double half_u = 0, half_v = 0;
    double center_u = 0, center_v = 0;

    friend bool operator==(const DirectionRange&, const DirectionRange&) = default;
};

/// Directions of a perspective picture, uniform in the tangents U and V. On a side of a hemicube U = right/forward and
/// V = up/forward in the face's own frame.
struct Perspective : DirectionRange {
    Face face = Face::front;

    friend bool operator==(const Perspective&, const Perspective&) = default;
};

/// Directions uniform in the sines U/√(1 + U² + V²) and V/√(1 + U² + V²), like the frequencies of plane waves of one
/// wavelength ([K] 4.1). In a grid with these directions, U and V always mean these sines. Front face only.
struct Frequencies : DirectionRange {
    friend bool operator==(const Frequencies&, const Frequencies&) = default;
};

/// Directions through the points of a fixed focal plane ζ = depth, the same points for all hogels ([K] 3.7.1 and figure
/// 5.1a). Camera arrays and most light fields of other programs have them. With u = x/depth of a point, uniform in
/// center_u ± half_u, and v alike, the hogel at (s, t) has the directions U = u − s/depth and V = v − t/depth: rays
/// from (s, t, 0) through (u·depth, v·depth, depth). Cameras on the plane ζ = −D in front of the hologram have `depth`
/// −D; the camera at x = c has u = −c/D.
///
/// In a grid with these directions u(), v(), column() and row() refer to u and v, which are U and V of a central hogel,
/// s = t = 0. LightFieldGrid::of_hogel() returns those of each hogel. Depth → ±∞ gives Perspective. Front face only.
struct FocalPlane : DirectionRange {
    double depth = 0;  ///< ζ of the plane, metres: positive behind the hologram, negative in front; not 0

    friend bool operator==(const FocalPlane&, const FocalPlane&) = default;
};

/// Returns the perspective with the full angles `across` and `down` (radians) around an axis tilted from the
/// perpendicular by `toward_right` and `toward_up` (radians). Throws Error(usage) for an angle outside 0 … π, and for a
/// tilted range that reaches π/2 from the perpendicular.
HOGEL_API Perspective field_of_view(double across, double down, double toward_right = 0, double toward_up = 0);
/// Returns a perspective with the same full angle (radians) across and down.
inline Perspective field_of_view(double angle) { return field_of_view(angle, angle); }

/// Sampling of a light field L[c][t][s][v][u] (docs/notation.md, section 1). A ray crosses the hologram plane at the
/// centre (s, t) of a hogel and follows x = s + Uζ, y = t + Vζ. `view` has the directions (U, V) of each hogel; they
/// are the same for all hogels unless there is a fixed focal plane.
struct HOGEL_API LightFieldGrid {
    std::size_t hogels_s = 0, hogels_t = 0;                   ///< S columns, T rows of hogels
    double pitch = 0;                                         ///< d, metres between hogels
    std::size_t directions_u = 0, directions_v = 0;           ///< n_U, n_V samples of direction
    std::variant<Perspective, Frequencies, FocalPlane> view;  ///< their range and spacing
    std::size_t channels = 3;                                 ///< 1, or 3 for R, G, B

    double width() const { return static_cast<double>(hogels_s) * pitch; }   ///< of the hologram, metres
    double height() const { return static_cast<double>(hogels_t) * pitch; }  ///< of the hologram, metres
    /// Returns the centre of a hogel, metres: s of column i, t of row j. Columns run to the right, rows down.
    double s(double i) const { return (i + 0.5 - 0.5 * static_cast<double>(hogels_s)) * pitch; }
    double t(double j) const { return (0.5 * static_cast<double>(hogels_t) - j - 0.5) * pitch; }

    /// Returns whether directions are uniform in the tangents U and V, and the same for all hogels.
    bool is_perspective() const { return view.index() == 0; }
    /// Returns whether directions are uniform in sines.
    bool has_frequencies() const { return view.index() == 1; }
    /// Returns the fixed focal plane, or null if all hogels have the same directions.
    const FocalPlane* focal_plane() const { return std::get_if<FocalPlane>(&view); }
    /// Returns a grid with the directions of the hogel in column i and row j for all hogels. Without a fixed focal
    /// plane that is this grid; with one it is a Perspective around U₀ − s/depth and V₀ − t/depth.
    LightFieldGrid of_hogel(double i, double j) const;
    /// Returns the face with uniform directions in its picture.
    Face face() const { return is_perspective() ? std::get_if<Perspective>(&view)->face : Face::front; }
    const DirectionRange& range() const {
        if (const auto* perspective = std::get_if<Perspective>(&view)) return *perspective;
        if (const auto* plane = focal_plane()) return *plane;
        return *std::get_if<Frequencies>(&view);
    }
    DirectionRange& range() { return const_cast<DirectionRange&>(std::as_const(*this).range()); }
    double half_u() const { return range().half_u; }
    double half_v() const { return range().half_v; }
    double center_u() const { return range().center_u; }
    double center_v() const { return range().center_v; }
    double step_u() const { return 2 * half_u() / static_cast<double>(directions_u); }  ///< ΔU
    double step_v() const { return 2 * half_v() / static_cast<double>(directions_v); }  ///< ΔV
    /// Returns the direction of column k or row l of directions. Columns run to the right, rows down.
    double u(double k) const { return center_u() + (k + 0.5 - 0.5 * static_cast<double>(directions_u)) * step_u(); }
    double v(double l) const { return center_v() + (0.5 * static_cast<double>(directions_v) - l - 0.5) * step_v(); }
    /// Returns the column of directions at U and the row at V, the inverse of u() and v(); whole numbers at samples.
    double column(double U) const {
        return (U - center_u()) / step_u() + (0.5 * static_cast<double>(directions_u) - 0.5);
    }
    double row(double V) const { return (0.5 * static_cast<double>(directions_v) - 0.5) - (V - center_v()) / step_v(); }
    /// Returns the direction (x, y, ζ) of the ray (U, V), with component 1 along the axis of the face: (U, V, 1) for
    /// the front. Returns zero for sines without a ray.
    Vec3 direction_of(double U, double V) const;
    /// Returns whether a direction (x, y, ζ) is in a sampled direction's cell; with a fixed focal plane, of a central
    /// hogel.
    bool covers(Vec3 direction) const;
    std::size_t directions() const { return directions_u * directions_v; }
    std::size_t hogels() const { return hogels_s * hogels_t; }
    double samples() const { return static_cast<double>(channels * directions()) * static_cast<double>(hogels()); }
    friend bool operator==(const LightFieldGrid&, const LightFieldGrid&) = default;
};

/// Throws Error(code) for zero samples, a value that is not finite or not positive, a requested hologram above 10 m
/// (only ErrorCode::usage), or more samples than can be addressed. The message names `what` and the wrong member.
HOGEL_API void validate(const LightFieldGrid& grid, ErrorCode code, const std::string& what);

/// Throws Error(code) unless is_perspective(). The message says that `what` needs a perspective.
HOGEL_API void require_perspective(const LightFieldGrid& grid, ErrorCode code, const std::string& what);

/// Throws Error(code) for a fixed focal plane. The message says that `what` needs the same directions at all hogels.
HOGEL_API void require_common_directions(const LightFieldGrid& grid, ErrorCode code, const std::string& what);

/// Returns whether two light fields have the same hogels at the same positions and the same number of channels.
HOGEL_API bool same_hogels(const LightFieldGrid& a, const LightFieldGrid& b);

/// Returns the grids of the faces of a hemicube around the hogels of `grid`, front first. The front has |U|, |V| <= 1
/// and as many directions as `grid`. Along the front's edge a side has as many directions as the front. Away from it, a
/// side continues at the front's spacing up to the full angles `across` and `down` (radians, above π/2 and at most π).
/// For π the sides have half as many, and the faces contain all directions with ζ > 0; smaller angles shrink the sides
/// ([K] 4.1). A single row of directions gives a hemisquare, for horizontal parallax only: front, left and right, each
/// with the row V = 0. Throws Error(usage) for other angles, and if a side would reach beyond the hologram plane: for π
/// the numbers of directions must be even, or the number of rows one.
HOGEL_API std::vector<LightFieldGrid> hemicube(const LightFieldGrid& grid, double across = std::numbers::pi,
                                               double down = std::numbers::pi);

/// A rectangle of hogels with all their directions; the unit of work.
struct HogelRange {
    std::size_t s0 = 0, t0 = 0;  ///< first column and row of hogels
    std::size_t ns = 0, nt = 0;  ///< columns and rows of hogels

    std::size_t hogels() const { return ns * nt; }
    friend bool operator==(const HogelRange&, const HogelRange&) = default;
};

/// The values of a range of hogels. `radiance` has shape [c][nt][ns][n_V][n_U]. `depth` (ζ in metres, +infinity if the
/// ray meets nothing) has shape [nt][ns][n_V][n_U], or no elements without depth.
struct HOGEL_API LightFieldTile {
    HogelRange range;
    Array<float, 5> radiance;
    Array<float, 4> depth;

    LightFieldTile() = default;
    LightFieldTile(const LightFieldGrid& grid, const HogelRange& r, bool with_depth);
};

/// Throws Error(usage) if a tile's range is empty or leaves the grid, or if its arrays do not have its shapes.
HOGEL_API void validate(const LightFieldTile& tile, const LightFieldGrid& grid);

/// Returns the tile size that suits most sources: about 16 MiB of samples, at least one hogel.
HOGEL_API HogelRange default_tile(const LightFieldGrid& grid);

/// Copies the hogels that two tiles have in common, with depth if both have it. `to` receives its number of directions,
/// starting at row first_v and column first_u of `from`.
HOGEL_API void copy_common(const LightFieldTile& from, LightFieldTile& to, std::size_t first_v = 0,
                           std::size_t first_u = 0);

/// Source of a light field: memory, a file, a decoder, or a renderer on demand. read() is thread-safe, and the values
/// of a hogel do not depend on the range that is read.
class HOGEL_API LightFieldSource {
  public:
    virtual ~LightFieldSource() = default;
    virtual const LightFieldGrid& grid() const = 0;
    virtual bool has_depth() const { return false; }
    /// Returns the tile size (s0 = t0 = 0) with the lowest cost per hogel. Any other size works too.
    virtual HogelRange preferred_tile() const { return default_tile(grid()); }
    /// Returns all radiances, [c][t][s][v][u], if the light field is in memory; otherwise a view without elements.
    virtual View<const float, 5> in_memory() const { return {}; }
    /// Reads the radiance for tile.range, and depth if the tile has an array for it and has_depth().
    virtual void read(LightFieldTile& tile) const = 0;
};

/// Destination of a light field. write() is thread-safe; each hogel is written once.
class HOGEL_API LightFieldSink {
  public:
    virtual ~LightFieldSink() = default;
    virtual void write(const LightFieldTile& tile) = 0;
    /// Returns whether write() uses depth.
    virtual bool wants_depth() const { return true; }
    /// Returns true if the sink continues an interrupted run that wrote exactly this tile. The tile then counts as
    /// written, and the caller skips it.
    virtual bool has_already(const HogelRange&) { return false; }
    /// Completes the output after the last tile. Only then does a file appear under its name. Call it once.
    virtual void finish() {}
};

/// A light field in memory, both source and sink.
class HOGEL_API LightFieldBuffer final : public LightFieldSource, public LightFieldSink {
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

/// A light field: a single front, or the three or five faces of a hemisquare or hemicube, front first. It is a value
/// type: copies share the sources, which live as long as any copy or any object made from one.
class HOGEL_API LightField {
  public:
    using Source = std::shared_ptr<const LightFieldSource>;

    /// Constructs a light field with a single front.
    template <std::derived_from<LightFieldSource> S>
    LightField(std::shared_ptr<S> front) : LightField(std::vector<Source>{std::move(front)}) {}
    template <std::derived_from<LightFieldSource> S>
    LightField(std::unique_ptr<S> front) : LightField(std::vector<Source>{Source(std::move(front))}) {}
    /// Constructs a light field with these faces. Throws Error(usage) unless the first is a front, no face occurs
    /// twice, and all have the same hogels and channels.
    explicit LightField(std::vector<Source> faces, Provenance provenance = {});

    const LightFieldSource& front() const { return *faces_.front(); }
    std::span<const Source> faces() const { return faces_; }
    /// Returns the grid of the front.
    const LightFieldGrid& grid() const { return front().grid(); }
    /// Returns the grids of all faces.
    std::vector<LightFieldGrid> grids() const;
    bool has_sides() const { return faces_.size() > 1; }
    /// Returns whether every face has depth.
    bool has_depth() const;
    /// Returns the number of samples of all faces.
    double samples() const;
    /// Returns the origin of the light field, from its file or renderer.
    const Provenance& provenance() const { return provenance_; }
    /// Returns the same light field with another provenance.
    LightField with(Provenance provenance) const { return LightField(faces_, std::move(provenance)); }
    /// Returns a light field with the faces make(face). make() returns a LightFieldSource, usually one that wraps the
    /// face.
    template <std::invocable<const Source&> Make>
    LightField wrapped(const Make& make) const {
        std::vector<Source> wrapped;
        for (const Source& face : faces_) wrapped.push_back(make(face));
        return LightField(std::move(wrapped), provenance_);
    }

  private:
    std::vector<Source> faces_;
    Provenance provenance_;
};

/// Returns the light field of a function, computed when it is read. radiance(s, t, U, V) is that of the ray x = s + Uζ,
/// y = t + Vζ, with s and t in metres. With Frequencies, U and V are the sines. A grid with one channel takes r. The
/// function must be thread-safe. Throws Error(usage) for an invalid grid, and for a grid that is not of a front.
HOGEL_API LightField light_field_from(const LightFieldGrid& grid,
                                      std::function<Rgb(double s, double t, double u, double v)> radiance);
/// Does the same for a function that returns a number, the radiance in every channel.
template <class Radiance>
requires std::is_arithmetic_v<std::invoke_result_t<const Radiance&, double, double, double, double>> LightField
light_field_from(const LightFieldGrid& grid, Radiance radiance) {
    return light_field_from(
        grid, std::function<Rgb(double, double, double, double)>([radiance](double s, double t, double u, double v) {
            const auto value = static_cast<float>(radiance(s, t, u, v));
            return Rgb{value, value, value};
        }));
}

/// Returns a light field of sources that the caller owns. They must outlive it and everything made from it.
HOGEL_API LightField borrow(const LightFieldSource& front);
HOGEL_API LightField borrow(std::span<const LightFieldSource* const> faces);

/// Throws Error(usage) unless the grids are those of one light field, see LightField.
HOGEL_API void require_faces(std::span<const LightFieldGrid> faces);

/// Copies one face in the source's preferred tiles, on all threads, and calls finish(). Memory: one tile per thread.
HOGEL_API void copy(const LightFieldSource& source, LightFieldSink& sink, const Progress& progress = {});

/// Returns the grid of with_common_directions(): a perspective with all directions of any hogel, at the same steps
/// around the same centre. A single row or column of directions stays single, because without parallax along that axis
/// it represents all. Without a fixed focal plane it is the grid itself. Throws Error(usage) for more samples than can
/// be addressed.
HOGEL_API LightFieldGrid common_directions(const LightFieldGrid& grid);

/// Returns the light field resampled to the same directions at all hogels, as holograms, printers and hemicubes need:
/// on the grid common_directions(), or on a given perspective with the same hogels. Resampling happens on reading.
/// Radiance is interpolated linearly between the hogel's neighbouring directions in U and V. It is zero outside its
/// directions, half a step beyond the last. Depth is that of the nearest direction, +infinity outside. A light field
/// without a fixed focal plane is returned unchanged, or refused with Error(usage) if a grid is given.
HOGEL_API LightField with_common_directions(const LightField& light_field);
HOGEL_API LightField with_common_directions(const LightField& light_field, const LightFieldGrid& grid);

/// Returns a light field of one face with the same samples at another scale: hogels `pitch` apart (metres), and all
/// directions U and V times `factor`. A fixed focal plane becomes directions in common, as if it were at infinity.
/// Depth ζ becomes pitch/(d factor) ζ/(1 − ζ/D), for the earlier pitch d and the depth D of a fixed focal plane, so
/// that neighbouring directions see a point as many hogels apart as before; +infinity for ζ/D ≥ 1. Throws Error(usage)
/// for a hemicube, and for a pitch or factor that is not positive.
HOGEL_API LightField with_scale(const LightField& light_field, double pitch, double factor);

/// Returns the light field with a cache of tiles, for readers with tiles that do not suit the sources: for example a
/// renderer that is fast in long rows, read in narrow tiles. Sources are read in their preferred tiles. The last used
/// tiles are kept, at most `bytes` in total; a read that needs more bypasses the cache. Depth is cached if
/// `with_depth`, otherwise read from the source.
HOGEL_API LightField cached_tiles(const LightField& light_field, double bytes, bool with_depth = false);

}  // namespace hogel
