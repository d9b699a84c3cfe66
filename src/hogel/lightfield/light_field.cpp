// SPDX-License-Identifier: Apache-2.0
#include "hogel/light_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "hogel/core/require_positive.h"
#include "hogel/core/stop_scope.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"
#include "hogel/work/shared_tiles.h"

namespace hogel {
namespace {

constexpr std::size_t tile_bytes = std::size_t{16} << 20;
constexpr std::size_t max_bytes = std::numeric_limits<std::size_t>::max() >> 1;

void require_finite(double value, const char* parameter, ErrorCode code, const std::string& what, const char* member) {
    if (!std::isfinite(value))
        throw Error(code, parameter, fmt::format("{}: {} is {}, but must be finite", what, member, value));
}

// Throws unless all cells of a side face are at ζ > 0.
void require_in_front_half(const LightFieldGrid& grid, ErrorCode code, const std::string& what) {
    const double u_low = grid.center_u() - grid.half_u(), u_high = grid.center_u() + grid.half_u();
    const double v_low = grid.center_v() - grid.half_v(), v_high = grid.center_v() + grid.half_v();
    const bool good = grid.face() == Face::front || (grid.face() == Face::left && u_low >= 0) ||
                      (grid.face() == Face::right && u_high <= 0) || (grid.face() == Face::top && v_high <= 0) ||
                      (grid.face() == Face::bottom && v_low >= 0);
    if (!good)
        throw Error(code, "fov, toward",
                    fmt::format("{}: the {} face reaches beyond the hologram plane; its directions are {} in U "
                                "and {} in V, but must lie where ζ > 0",
                                what, face_name(grid.face()), fmt::format("{:g} to {:g}", u_low, u_high),
                                fmt::format("{:g} to {:g}", v_low, v_high)));
}

// Throws unless the depth of the focal plane gives all hogels finite directions.
void require_depth(const LightFieldGrid& grid, const FocalPlane& plane, ErrorCode code, const std::string& what) {
    if (!std::isfinite(plane.depth) || plane.depth == 0)
        throw Error(code, "focal_plane",
                    fmt::format("{}: the depth of the fixed focal plane is {}, but must be finite and not zero", what,
                                plane.depth));
    const LightFieldGrid first = grid.of_hogel(0, 0);
    if (!std::isfinite(first.center_u()) || !std::isfinite(first.center_v()))
        throw Error(code, "focal_plane",
                    fmt::format("{}: the fixed focal plane at a depth of {} m is too close to the hologram plane "
                                "for its hogels to have directions",
                                what, plane.depth));
}

Shape<5> radiance_shape(const LightFieldGrid& grid, const HogelRange& range) {
    return {grid.channels, range.nt, range.ns, grid.directions_v, grid.directions_u};
}

Shape<4> depth_shape(const LightFieldGrid& grid, const HogelRange& range) {
    return {range.nt, range.ns, grid.directions_v, grid.directions_u};
}

HogelRange all_hogels(const LightFieldGrid& grid) { return {0, 0, grid.hogels_s, grid.hogels_t}; }

// Rows of a range are contiguous in the light field and in the tile.
void copy_row(const float* from, float* to, std::size_t hogels, std::size_t directions) {
    std::copy_n(from, hogels * directions, to);
}

// Returns the number of directions beside a hemicube's front, which has `front` across 90 degrees.
std::size_t directions_aside(std::size_t front, double angle) {
    using std::numbers::pi;
    if (!(angle > pi / 2 && angle <= pi))
        throw Error(ErrorCode::usage, "hemicube, fov",
                    fmt::format("a hemicube spans more than 90 degrees and at most 180, not {:.6g}", angle * 180 / pi));
    const double count = 0.5 * static_cast<double>(front) * (1 - 1 / std::tan(angle / 2));
    const auto side = static_cast<std::size_t>(std::ceil(count - 1e-9));
    if (2 * side > front)
        throw Error(ErrorCode::usage, "hemicube, directions",
                    fmt::format("a hemicube of {:.6g} degrees needs an even number of directions in front, not {}",
                                angle * 180 / pi, front));
    return std::max<std::size_t>(side, 1);
}

// Metres; larger sizes are taken for a wrong unit.
constexpr double max_hologram_size = 10;

void require_metres(const LightFieldGrid& grid, ErrorCode code, const std::string& what) {
    const double width = static_cast<double>(grid.hogels_s) * grid.pitch,
                 height = static_cast<double>(grid.hogels_t) * grid.pitch;
    if (std::max(width, height) <= max_hologram_size) return;
    const char* side = width > max_hologram_size ? "wide" : "high";
    const double size = width > max_hologram_size ? width : height;
    throw Error(code, "size",
                fmt::format("{}: the hologram is {:g} m {}; expected at most {}: lengths are in metres, and {:g} "
                            "millimetres are {:g}*mm",
                            what, size, side, format_length(max_hologram_size), size, size));
}

}  // namespace

void validate(const LightFieldGrid& grid, ErrorCode code, const std::string& what) {
    if (grid.hogels_s == 0 || grid.hogels_t == 0)
        throw Error(code, "hogels",
                    fmt::format("{}: {}x{} hogels, but at least 1x1 are needed", what, grid.hogels_s, grid.hogels_t));
    if (grid.directions_u == 0 || grid.directions_v == 0)
        throw Error(code, "directions",
                    fmt::format("{}: {}x{} directions, but at least 1x1 are needed", what, grid.directions_u,
                                grid.directions_v));
    if (grid.channels != 1 && grid.channels != 3)
        throw Error(code, fmt::format("{}: {} channels, but 1 or 3 were expected", what, grid.channels));
    core::require_positive(grid.pitch, "size", code, what, "hogel pitch");
    core::require_positive(grid.half_u(), "fov", code, what, "tan_half_u");
    core::require_positive(grid.half_v(), "fov", code, what, "tan_half_v");
    require_finite(grid.center_u(), "toward", code, what, "center_u");
    require_finite(grid.center_v(), "toward", code, what, "center_v");
    require_in_front_half(grid, code, what);
    core::require_positive(grid.step_u(), "fov, directions", code, what, "the step between directions in u");
    core::require_positive(grid.step_v(), "fov, directions", code, what, "the step between directions in v");
    core::require_positive(static_cast<double>(grid.hogels_s) * grid.pitch, "size", code, what,
                           "the width of the hologram");
    core::require_positive(static_cast<double>(grid.hogels_t) * grid.pitch, "size", code, what,
                           "the height of the hologram");
    if (const FocalPlane* plane = grid.focal_plane()) require_depth(grid, *plane, code, what);
    std::size_t budget = max_bytes / sizeof(float);
    for (std::size_t extent : radiance_shape(grid, all_hogels(grid))) budget /= extent;
    if (budget == 0)
        throw Error(
            code, "hogels, directions",
            fmt::format("{}: {}x{} hogels of {}x{} directions in {} channels are more samples than can "
                        "be addressed",
                        what, grid.hogels_s, grid.hogels_t, grid.directions_u, grid.directions_v, grid.channels));
    // Files may have any size; in a request, such a size is a wrong unit.
    if (code == ErrorCode::usage) require_metres(grid, code, what);
}

void require_common_directions(const LightFieldGrid& grid, ErrorCode code, const std::string& what) {
    if (const FocalPlane* plane = grid.focal_plane())
        throw Error(code,
                    fmt::format("{} needs the same directions at all hogels; these go through a fixed focal plane "
                                "at a depth of {}",
                                what, format_length(plane->depth)));
}

void require_perspective(const LightFieldGrid& grid, ErrorCode code, const std::string& what) {
    require_common_directions(grid, code, what);
    if (!grid.is_perspective())
        throw Error(code, fmt::format("{} needs directions in perspective, uniform in tangents; these are uniform in "
                                      "sines, on the frequency grid of a hologram",
                                      what));
}

Perspective field_of_view(double across, double down, double toward_right, double toward_up) {
    constexpr double quarter = std::numbers::pi / 2;
    const auto span = [](double angle, double toward) -> std::pair<double, double> {
        if (!(angle > 0 && angle < 2 * quarter))
            throw Error(ErrorCode::usage, "fov",
                        fmt::format("field of view: the full angle is {:.6g} degrees; expected one "
                                    "between 0 and 180",
                                    angle * 90 / quarter));
        if (toward == 0) return {0, std::tan(angle / 2)};
        if (!(std::abs(toward) + angle / 2 < quarter))
            throw Error(ErrorCode::usage, "fov, toward", "field of view: it must end before 90 degrees on either side");
        const double low = std::tan(toward - angle / 2), high = std::tan(toward + angle / 2);
        return {(low + high) / 2, (high - low) / 2};
    };
    const auto [center_u, half_u] = span(across, toward_right);
    const auto [center_v, half_v] = span(down, toward_up);
    return Perspective{{half_u, half_v, center_u, center_v}, Face::front};
}

LightFieldGrid LightFieldGrid::of_hogel(double i, double j) const {
    LightFieldGrid grid = *this;
    if (const FocalPlane* plane = focal_plane()) {
        DirectionRange range = *plane;
        range.center_u -= s(i) / plane->depth;
        range.center_v -= t(j) / plane->depth;
        grid.view = Perspective{range};
    }
    return grid;
}

Vec3 LightFieldGrid::direction_of(double U, double V) const {
    if (!has_frequencies()) return from_face(face(), {U, V, 1});
    const double cos2 = 1 - U * U - V * V;
    const double cosine = std::sqrt(std::max(cos2, 0.0));
    return cos2 > 0 ? Vec3{U / cosine, V / cosine, 1} : Vec3{0, 0, 0};
}

bool LightFieldGrid::covers(Vec3 direction) const {
    const Vec3 q = to_face(face(), direction);
    if (!(q.z > 0)) return false;
    const double forward = has_frequencies() ? length(q) : q.z;
    const double k = column(q.x / forward), l = row(q.y / forward);
    return k >= -0.5 && k <= static_cast<double>(directions_u) - 0.5 && l >= -0.5 &&
           l <= static_cast<double>(directions_v) - 0.5;
}

bool same_hogels(const LightFieldGrid& a, const LightFieldGrid& b) {
    return a.hogels_s == b.hogels_s && a.hogels_t == b.hogels_t && a.pitch == b.pitch && a.channels == b.channels;
}

std::vector<LightFieldGrid> hemicube(const LightFieldGrid& grid, double across, double down) {
    const bool square = grid.directions_v == 1;
    const std::size_t aside = directions_aside(grid.directions_u, across),
                      above = square ? 0 : directions_aside(grid.directions_v, down);
    // Tangents ζ/|x| of a side: 1 at the front's edge, 0 in the hologram plane.
    const double half_u = static_cast<double>(aside) / static_cast<double>(grid.directions_u),
                 half_v = static_cast<double>(above) / static_cast<double>(grid.directions_v);
    std::vector<LightFieldGrid> faces;
    for (const Face face : all_faces) {
        if (square && (face == Face::top || face == Face::bottom)) continue;
        LightFieldGrid& g = faces.emplace_back(grid);
        DirectionRange range{1, square ? grid.half_v() : 1};
        if (face == Face::left || face == Face::right) {
            g.directions_u = aside;
            range.half_u = half_u;
            range.center_u = face == Face::left ? 1 - half_u : half_u - 1;
        }
        if (face == Face::top || face == Face::bottom) {
            g.directions_v = above;
            range.half_v = half_v;
            range.center_v = face == Face::bottom ? 1 - half_v : half_v - 1;
        }
        g.view = Perspective{range, face};
    }
    return faces;
}

LightFieldTile::LightFieldTile(const LightFieldGrid& grid, const HogelRange& r, bool with_depth)
    : range(r), radiance(radiance_shape(grid, r)) {
    if (with_depth) depth = Array<float, 4>(depth_shape(grid, r));
}

void validate(const LightFieldTile& tile, const LightFieldGrid& grid) {
    const HogelRange& r = tile.range;
    if (r.hogels() == 0 || r.s0 >= grid.hogels_s || r.ns > grid.hogels_s - r.s0 || r.t0 >= grid.hogels_t ||
        r.nt > grid.hogels_t - r.t0)
        throw Error(ErrorCode::usage,
                    fmt::format("tile of {}x{} hogels at ({}, {}) is not inside a light field of {}x{} hogels", r.ns,
                                r.nt, r.s0, r.t0, grid.hogels_s, grid.hogels_t));
    if (tile.radiance.shape() != radiance_shape(grid, r) ||
        (tile.depth.size() > 0 && tile.depth.shape() != depth_shape(grid, r)))
        throw Error(ErrorCode::usage,
                    fmt::format("tile at ({}, {}): its arrays are not those of {}x{} hogels with {}x{} directions in "
                                "{} channels",
                                r.s0, r.t0, r.ns, r.nt, grid.directions_u, grid.directions_v, grid.channels));
}

LightFieldBuffer::LightFieldBuffer(const LightFieldGrid& grid, bool with_depth) : grid_(grid) {
    validate(grid, ErrorCode::usage, "light field");
    radiance = Array<float, 5>(radiance_shape(grid, all_hogels(grid)));
    if (with_depth)
        depth = Array<float, 4>(depth_shape(grid, all_hogels(grid)), std::numeric_limits<float>::infinity());
}

void copy_common(const LightFieldTile& from, LightFieldTile& to, std::size_t first_v, std::size_t first_u) {
    const HogelRange &a = from.range, &b = to.range;
    const std::size_t s0 = std::max(a.s0, b.s0), s1 = std::min(a.s0 + a.ns, b.s0 + b.ns);
    const std::size_t t0 = std::max(a.t0, b.t0), t1 = std::min(a.t0 + a.nt, b.t0 + b.nt);
    const auto& shape = to.radiance.shape();
    const bool with_depth = from.depth.size() > 0 && to.depth.size() > 0;
    for (std::size_t t = t0; t < t1; ++t)
        for (std::size_t s = s0; s < s1; ++s)
            for (std::size_t v = 0; v < shape[3]; ++v) {
                for (std::size_t c = 0; c < shape[0]; ++c)
                    std::copy_n(&from.radiance(c, t - a.t0, s - a.s0, first_v + v, first_u), shape[4],
                                &to.radiance(c, t - b.t0, s - b.s0, v, 0));
                if (with_depth)
                    std::copy_n(&from.depth(t - a.t0, s - a.s0, first_v + v, first_u), shape[4],
                                &to.depth(t - b.t0, s - b.s0, v, 0));
            }
}

void LightFieldBuffer::read(LightFieldTile& tile) const {
    validate(tile, grid_);
    const HogelRange& r = tile.range;
    work::parallel_for(r.nt, [&](std::size_t j) {
        for (std::size_t c = 0; c < grid_.channels; ++c)
            copy_row(&radiance(c, r.t0 + j, r.s0, 0, 0), &tile.radiance(c, j, 0, 0, 0), r.ns, grid_.directions());
        if (has_depth() && tile.depth.size() > 0)
            copy_row(&depth(r.t0 + j, r.s0, 0, 0), &tile.depth(j, 0, 0, 0), r.ns, grid_.directions());
    });
}

void LightFieldBuffer::write(const LightFieldTile& tile) {
    validate(tile, grid_);
    const HogelRange& r = tile.range;
    if (has_depth() && tile.depth.size() == 0)
        throw Error(ErrorCode::usage, "a tile without depth was written to a light field with depth");
    for (std::size_t j = 0; j < r.nt; ++j) {
        for (std::size_t c = 0; c < grid_.channels; ++c)
            copy_row(&tile.radiance(c, j, 0, 0, 0), &radiance(c, r.t0 + j, r.s0, 0, 0), r.ns, grid_.directions());
        if (has_depth()) copy_row(&tile.depth(j, 0, 0, 0), &depth(r.t0 + j, r.s0, 0, 0), r.ns, grid_.directions());
    }
}

HogelRange default_tile(const LightFieldGrid& grid) {
    const std::size_t hogel_bytes = grid.channels * grid.directions() * sizeof(float);
    HogelRange tile{0, 0, 1, 1};
    // Power-of-two sides (or the whole hologram) align with the chunks of a file.
    while (2 * tile.hogels() <= tile_bytes / hogel_bytes && (tile.ns < grid.hogels_s || tile.nt < grid.hogels_t)) {
        const bool widen = tile.ns < grid.hogels_s && (tile.ns <= tile.nt || tile.nt >= grid.hogels_t);
        (widen ? tile.ns : tile.nt) *= 2;
    }
    tile.ns = std::min(tile.ns, grid.hogels_s);
    tile.nt = std::min(tile.nt, grid.hogels_t);
    return tile;
}

void copy(const LightFieldSource& source, LightFieldSink& sink, const Progress& progress) {
    const core::StopScope scope(progress);
    const LightFieldGrid& grid = source.grid();
    const HogelRange size = source.preferred_tile();
    const std::size_t across = (grid.hogels_s + size.ns - 1) / size.ns;
    const std::size_t down = (grid.hogels_t + size.nt - 1) / size.nt;
    const auto shared = dynamic_cast<work::SharedSink*>(&sink);
    work::for_each_tile(across * down, shared, progress, [&](std::size_t i) {
        HogelRange range{(i % across) * size.ns, (i / across) * size.nt, size.ns, size.nt};
        range.ns = std::min(range.ns, grid.hogels_s - range.s0);
        range.nt = std::min(range.nt, grid.hogels_t - range.t0);
        if (!sink.has_already(range)) {
            LightFieldTile tile(grid, range, source.has_depth() && sink.wants_depth());
            source.read(tile);
            sink.write(tile);
        }
    });
    sink.finish();
}

void require_faces(std::span<const LightFieldGrid> faces) {
    if (faces.empty() || faces.front().face() != Face::front)
        throw Error(ErrorCode::usage, "a light field begins with its front; there is none");
    if (faces.size() > 1) require_common_directions(faces.front(), ErrorCode::usage, "a light field of several faces");
    std::set<Face> faces_seen;
    for (const LightFieldGrid& face : faces) {
        if (!faces_seen.insert(face.face()).second)
            throw Error(ErrorCode::usage, fmt::format("a light field has the face '{}' twice", face_name(face.face())));
        if (!same_hogels(faces.front(), face))
            throw Error(ErrorCode::usage, fmt::format("the {} face of a light field has other hogels or channels than "
                                                      "its front",
                                                      face_name(face.face())));
    }
}

LightField::LightField(std::vector<Source> faces, Provenance provenance)
    : faces_(std::move(faces)), provenance_(std::move(provenance)) {
    require_faces(grids());
}

std::vector<LightFieldGrid> LightField::grids() const {
    std::vector<LightFieldGrid> grids;
    for (const Source& face : faces_) grids.push_back(face->grid());
    return grids;
}

bool LightField::has_depth() const {
    return std::ranges::all_of(faces_, [](const Source& face) { return face->has_depth(); });
}

double LightField::samples() const {
    double samples = 0;
    for (const Source& face : faces_) samples += face->grid().samples();
    return samples;
}

LightField borrow(const LightFieldSource& front) {
    const LightFieldSource* const only = &front;
    return borrow({&only, 1});
}

LightField borrow(std::span<const LightFieldSource* const> faces) {
    std::vector<LightField::Source> sources;
    for (const LightFieldSource* face : faces) sources.emplace_back(std::shared_ptr<void>(), face);
    return LightField(std::move(sources));
}

}  // namespace hogel
