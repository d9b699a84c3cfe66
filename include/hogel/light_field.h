// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hogel/array.h"
#include "hogel/export.h"
#include "hogel/geometry.h"
#include "hogel/progress.h"
#include "hogel/provenance.h"

namespace hogel {

/// The sides of a hemicube around a hogel ([K] 4.1): each looks at a part of the directions in a perspective of its
/// own. The front looks along +ζ, right and left along +x and −x, top and bottom along +y and −y. Of the four sides
/// only the half with ζ > 0 is used.
enum class Face { front, left, right, top, bottom };

inline constexpr std::array all_faces{Face::front, Face::left, Face::right, Face::top, Face::bottom};

/// The word for a face, as in files.
constexpr std::string_view face_name(Face face) {
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

/// A range of directions: |U − center_u| <= half_u and |V − center_v| <= half_v.
struct DirectionRange {
    double half_u = 0, half_v = 0;
    double center_u = 0, center_v = 0;

    friend bool operator==(const DirectionRange&, const DirectionRange&) = default;
};

/// Directions of a picture in perspective: uniform in the tangents U and V. On a side of a hemicube these are those of
/// the face's own picture, right/forward and up/forward.
struct Perspective : DirectionRange {
    Face face = Face::front;

    friend bool operator==(const Perspective&, const Perspective&) = default;
};

/// Directions uniform in their sines, U and V over √(1 + U² + V²), as the frequencies of one wavelength's plane waves
/// are: [K] 4.1. All that is said of U and V elsewhere is said of these sines. Of the front alone.
struct Frequencies : DirectionRange {
    friend bool operator==(const Frequencies&, const Frequencies&) = default;
};

/// A perspective that spans a full angle (radians), around the axis that is `toward` from the perpendicular. Throws
/// Error(usage) for an angle outside 0 … π, and for one that reaches π/2 from the perpendicular while `toward` is not
/// 0.
HOGEL_API Perspective field_of_view(double across, double down, double toward_right = 0, double toward_up = 0);
inline Perspective field_of_view(double angle) { return field_of_view(angle, angle); }

/// How a light field L[c][t][s][v][u] is sampled (docs/notation.md, section 1). A ray crosses the hologram plane at the
/// centre (s, t) of a hogel and runs along x = s + Uζ, y = t + Vζ. Which rays a hogel has, `view` says.
struct HOGEL_API LightFieldGrid {
    std::size_t hogels_s = 0, hogels_t = 0;          ///< S columns, T rows of hogels
    double pitch = 0;                                ///< d, metres between hogels
    std::size_t directions_u = 0, directions_v = 0;  ///< n_U, n_V samples of direction
    std::variant<Perspective, Frequencies> view;     ///< where they lie; a fixed focal plane will be a third kind
    std::size_t channels = 3;                        ///< 1, or 3 for R, G, B

    double width() const { return static_cast<double>(hogels_s) * pitch; }   ///< of the hologram, metres
    double height() const { return static_cast<double>(hogels_t) * pitch; }  ///< likewise
    double s(double i) const { return (i + 0.5 - 0.5 * static_cast<double>(hogels_s)) * pitch; }
    double t(double j) const { return (0.5 * static_cast<double>(hogels_t) - j - 0.5) * pitch; }

    bool is_perspective() const { return view.index() == 0; }
    /// In whose picture directions are uniform.
    Face face() const { return is_perspective() ? std::get_if<Perspective>(&view)->face : Face::front; }
    const DirectionRange& range() const {
        if (const auto* perspective = std::get_if<Perspective>(&view)) return *perspective;
        return *std::get_if<Frequencies>(&view);
    }
    DirectionRange& range() { return const_cast<DirectionRange&>(std::as_const(*this).range()); }
    double half_u() const { return range().half_u; }
    double half_v() const { return range().half_v; }
    double center_u() const { return range().center_u; }
    double center_v() const { return range().center_v; }
    double step_u() const { return 2 * half_u() / static_cast<double>(directions_u); }  ///< ΔU
    double step_v() const { return 2 * half_v() / static_cast<double>(directions_v); }  ///< ΔV
    double u(double k) const { return center_u() + (k + 0.5 - 0.5 * static_cast<double>(directions_u)) * step_u(); }
    double v(double l) const { return center_v() + (0.5 * static_cast<double>(directions_v) - l - 0.5) * step_v(); }
    /// The inverse of u and v: the column of directions at U, the row at V, whole numbers at samples.
    double column(double U) const {
        return (U - center_u()) / step_u() + (0.5 * static_cast<double>(directions_u) - 0.5);
    }
    double row(double V) const { return (0.5 * static_cast<double>(directions_v) - 0.5) - (V - center_v()) / step_v(); }
    /// The direction (x, y, ζ) of the ray (U, V), one step forward as the face looks: (U, V, 1) for the front; zero
    /// where sines are those of no ray.
    Vec3 direction_of(double U, double V) const;
    /// Whether a direction (x, y, ζ) from a hogel is one of the directions, or in the cell around one.
    bool covers(Vec3 direction) const;
    std::size_t directions() const { return directions_u * directions_v; }
    std::size_t hogels() const { return hogels_s * hogels_t; }
    double samples() const { return static_cast<double>(channels * directions()) * static_cast<double>(hogels()); }
    friend bool operator==(const LightFieldGrid&, const LightFieldGrid&) = default;
};

/// Throws Error(code) naming `what` and the member that is wrong: nothing to sample, not finite, not positive, or more
/// samples than can be addressed.
HOGEL_API void validate(const LightFieldGrid& grid, ErrorCode code, const std::string& what);

/// Throws Error(code) where directions are uniform in sines, which `what` cannot do.
HOGEL_API void require_perspective(const LightFieldGrid& grid, ErrorCode code, const std::string& what);

/// Whether two light fields have the same hogels in the same places, and as many channels.
HOGEL_API bool same_hogels(const LightFieldGrid& a, const LightFieldGrid& b);

/// The five faces of a hemicube around the hogels of `grid`, front first: all directions with ζ > 0, the front |U|, |V|
/// <= 1 with the directions of `grid`, the sides with as many along the front's edges and half as many away from it.
/// Of one row of directions a hemisquare, for horizontal parallax only: the front and its sides left and right, each
/// with the row V = 0. Throws Error(usage) unless the numbers of directions are even, or that of rows one.
HOGEL_API std::vector<LightFieldGrid> hemicube(const LightFieldGrid& grid);

/// A rectangle of hogels with all their directions: the unit of work.
struct HogelRange {
    std::size_t s0 = 0, t0 = 0;  ///< first column and row of hogels
    std::size_t ns = 0, nt = 0;  ///< columns and rows of hogels

    std::size_t hogels() const { return ns * nt; }
    friend bool operator==(const HogelRange&, const HogelRange&) = default;
};

/// The values of a range of hogels. `radiance` has shape [c][nt][ns][n_V][n_U]; `depth` (ζ in metres, +infinity where
/// the ray meets nothing) has shape [nt][ns][n_V][n_U], or no elements where nobody asked for it.
struct HOGEL_API LightFieldTile {
    HogelRange range;
    Array<float, 5> radiance;
    Array<float, 4> depth;

    LightFieldTile() = default;
    LightFieldTile(const LightFieldGrid& grid, const HogelRange& r, bool with_depth);
};

/// Throws Error(usage) when a tile's range is empty or leaves the grid, or its arrays do not have the range's shapes.
HOGEL_API void validate(const LightFieldTile& tile, const LightFieldGrid& grid);

/// The size of tile that suits most sources: as many hogels as about 16 MiB of samples hold, 1×1 at least.
HOGEL_API HogelRange default_tile(const LightFieldGrid& grid);

/// Copies the hogels that two tiles have in common, with depth where both have it: of `from` the directions from row
/// first_v and column first_u on, as many as `to` has.
HOGEL_API void copy_common(const LightFieldTile& from, LightFieldTile& to, std::size_t first_v = 0,
                           std::size_t first_u = 0);

/// Where light fields come from: memory, a file, a decoder, a renderer working on demand. read() may be called from
/// several threads at once and gives the same values for a hogel whatever the range it is asked for in.
class HOGEL_API LightFieldSource {
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
class HOGEL_API LightFieldSink {
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

/// A light field: a front, or all three or five faces of a hemicube with the front first. A value: copies share the
/// sources, which live as long as anybody holds the light field or something made of it.
class HOGEL_API LightField {
  public:
    using Source = std::shared_ptr<const LightFieldSource>;

    /// A front alone.
    template <std::derived_from<LightFieldSource> S>
    LightField(std::shared_ptr<S> front) : LightField(std::vector<Source>{std::move(front)}) {}
    template <std::derived_from<LightFieldSource> S>
    LightField(std::unique_ptr<S> front) : LightField(std::vector<Source>{Source(std::move(front))}) {}
    /// All faces. Throws Error(usage) unless the first is a front, no face stands twice, and all have the same hogels
    /// and channels.
    explicit LightField(std::vector<Source> faces, Provenance provenance = {});

    const LightFieldSource& front() const { return *faces_.front(); }
    std::span<const Source> faces() const { return faces_; }
    /// How the front is sampled.
    const LightFieldGrid& grid() const { return front().grid(); }
    /// How each face is.
    std::vector<LightFieldGrid> grids() const;
    bool has_sides() const { return faces_.size() > 1; }
    /// Whether every face has depth.
    bool has_depth() const;
    /// Of all faces.
    double samples() const;
    /// Where it comes from: what its file or its renderer says.
    const Provenance& provenance() const { return provenance_; }
    /// The same light field with another provenance.
    LightField with(Provenance provenance) const { return LightField(faces_, std::move(provenance)); }
    /// The light field whose faces are make(face), a LightFieldSource each: the same light field wrapped.
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

/// A light field of a source that somebody else owns, and that must outlive all that is made of it.
HOGEL_API LightField borrow(const LightFieldSource& front);
HOGEL_API LightField borrow(std::span<const LightFieldSource* const> faces);

/// Throws Error(usage) where grids are not those of one light field: see LightField.
HOGEL_API void require_faces(std::span<const LightFieldGrid> faces);

/// Streams a face of a light field from a source to a sink in the source's preferred tiles on all threads; memory: a
/// tile a thread. Calls finish().
HOGEL_API void copy(const LightFieldSource& source, LightFieldSink& sink, const Progress& progress = {});

/// The same light field, for readers whose tiles suit the sources badly, such as narrow ones of a renderer that is fast
/// in long rows: it is read in tiles that suit, and those used last are kept, `bytes` of them at most. Where the tiles
/// that a reader asks for would not fit, it reads from the source itself. Depths are kept if `with_depth`, else read
/// from the source.
HOGEL_API LightField cached_tiles(const LightField& light_field, double bytes, bool with_depth = false);

}  // namespace hogel
