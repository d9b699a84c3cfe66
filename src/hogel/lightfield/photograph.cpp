// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/film.h"
#include "hogel/ray_photograph.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/lightfield/interpolation.h"

namespace hogel {
namespace {

using lightfield::Interpolation;
using lightfield::mix;

struct LensPoint {
    double x, y;              // metres from the centre of the lens
    double pixel_x, pixel_y;  // position of the ray within the pixel, −½..½
};

double van_der_corput(std::size_t i, std::size_t base) {
    double value = 0, place = 1;
    for (; i > 0; i /= base) {
        place /= static_cast<double>(base);
        value += place * static_cast<double>(i % base);
    }
    return value;
}

// Maximum number of values that the points of the lens see of one tile at a time: 64 MiB.
constexpr std::size_t max_seen = std::size_t{1} << 24;

// Points spread evenly over the pupil's disc (Halton sequence, mapped by equal areas), each with its own position in
// the pixel, so that one set of rays averages over both the pupil and the pixel's area.
std::vector<LensPoint> lens_points(double pupil, std::size_t count) {
    std::vector<LensPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 65536 == 0) core::throw_if_stopped();
        const double radius = 0.5 * pupil * std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(count));
        const double angle = 2 * std::numbers::pi * van_der_corput(i, 2);
        points.push_back({radius * std::cos(angle), radius * std::sin(angle), van_der_corput(i + 1, 3) - 0.5,
                          van_der_corput(i + 1, 5) - 0.5});
    }
    return points;
}

// The film of one camera, to which the hogels of one face after the other are added.
class Exposure {
  public:
    Exposure(std::vector<LightFieldGrid> faces, const Camera& camera, std::size_t lens_count, Image& image)
        : faces_(std::move(faces)),
          grid_(faces_.front()),
          camera_(camera),
          points_(lens_points(camera.pupil, lens_count)),
          image_(image) {}

    // Adds all rays of a face that cross the hologram plane in a cell whose upper left hogel is in `cells`; the tile
    // holds these hogels and their right and lower neighbours.
    void add(std::size_t face, const LightFieldTile& tile, const HogelRange& cells) {
        // The values that each point of the lens sees of each hogel, for a limited number of points at a time.
        const std::size_t seen_by_one = tile.range.nt * tile.range.ns * grid_.channels;
        const std::size_t together = std::clamp<std::size_t>(max_seen / seen_by_one, 1, points_.size());
        Array<float, 4> seen({together, tile.range.nt, tile.range.ns, grid_.channels});
        for (std::size_t first = 0; first < points_.size(); first += together) {
            const std::size_t count = std::min(together, points_.size() - first);
            std::ranges::fill(seen.elements(), 0.0f);
            core::parallel_for(count, [&](std::size_t i) { look(face, tile, points_[first + i], seen[i]); });
            core::parallel_for(camera_.picture.height, [&](std::size_t row) {
                for (std::size_t i = 0; i < count; ++i) expose(row, points_[first + i], tile.range, cells, seen[i]);
            });
        }
    }

    void finish() {
        const float mean = 1 / static_cast<float>(points_.size());
        for (float& value : image_.pixels.elements()) value *= mean;
    }

  private:
    void look(std::size_t face, const LightFieldTile& tile, const LensPoint& point, View<float, 3> seen) const {
        const LightFieldGrid& grid = faces_[face];
        const double lens_x = camera_.eye.x + point.x, lens_y = camera_.eye.y + point.y, distance = camera_.eye.z;
        for (std::size_t t = 0; t < tile.range.nt; ++t) {
            const double V = (grid.t(static_cast<double>(tile.range.t0 + t)) - lens_y) / distance;
            for (std::size_t s = 0; s < tile.range.ns; ++s) {
                const auto i = static_cast<double>(tile.range.s0 + s), j = static_cast<double>(tile.range.t0 + t);
                const double U = (grid.s(i) - lens_x) / distance;
                const Vec3 direction = to_face(grid.face(), {U, V, 1});
                if (!(direction.z > 0) || shown_before(face, {U, V, 1})) continue;
                const double forward = grid.has_frequencies() ? length(direction) : direction.z;
                const LightFieldGrid own = grid.of_hogel(i, j);  // with the directions of this hogel
                const Interpolation u(own.column(direction.x / forward), grid.directions_u);
                const Interpolation v(own.row(direction.y / forward), grid.directions_v);
                if (u.outside || v.outside) continue;
                const std::size_t u1 = u.high(grid.directions_u), v1 = v.high(grid.directions_v);
                for (std::size_t c = 0; c < grid.channels; ++c) {
                    const View<const float, 2> hogel = tile.radiance.view()[c][t][s];
                    const float top = mix(hogel(v.low, u.low), hogel(v.low, u1), u.high_weight);
                    const float bottom = mix(hogel(v1, u.low), hogel(v1, u1), u.high_weight);
                    seen(t, s, c) = mix(top, bottom, v.high_weight);
                }
            }
        }
    }

    // Whether an earlier face has this direction: faces may overlap, and a direction belongs to the first one that has
    // it.
    bool shown_before(std::size_t face, Vec3 direction) const {
        return std::any_of(faces_.begin(), faces_.begin() + static_cast<std::ptrdiff_t>(face),
                           [&](const LightFieldGrid& earlier) { return earlier.covers(direction); });
    }

    void expose(std::size_t row, const LensPoint& point, const HogelRange& held, const HogelRange& cells,
                View<const float, 3> seen) {
        // A ray from a lens point to the pixel's point of the plane in focus crosses the hologram plane at the pixel's
        // position plus this fraction of the lens point's offset.
        const double R = camera_.eye.z, shift = 1 - R / (R + camera_.focus_depth);
        const double y = camera_.picture.y(static_cast<double>(row) + point.pixel_y) + shift * point.y;
        const Interpolation t(0.5 * static_cast<double>(grid_.hogels_t) - 0.5 - y / grid_.pitch, grid_.hogels_t);
        if (t.outside || t.low < cells.t0 || t.low >= cells.t0 + cells.nt) return;
        const std::size_t t0 = t.low - held.t0, t1 = t.high(grid_.hogels_t) - held.t0;

        // The columns that can be in these cells, plus one on each side so that rounding loses none.
        const double to_column = grid_.pitch / camera_.picture.pitch_x;
        const auto column_of = [&](double hogel) {
            return camera_.picture.column(grid_.s(hogel) - shift * point.x) - point.pixel_x;
        };
        const double first = std::floor(column_of(static_cast<double>(cells.s0)) - 0.5 * to_column) - 1;
        const double last = std::ceil(column_of(static_cast<double>(cells.s0 + cells.ns)) + 0.5 * to_column) + 1;
        const double width = static_cast<double>(camera_.picture.width);
        for (double column = std::max(first, 0.0); column <= std::min(last, width - 1); ++column) {
            const double x = camera_.picture.x(column + point.pixel_x) + shift * point.x;
            const Interpolation s(x / grid_.pitch + 0.5 * static_cast<double>(grid_.hogels_s) - 0.5, grid_.hogels_s);
            if (s.outside || s.low < cells.s0 || s.low >= cells.s0 + cells.ns) continue;
            const std::size_t s0 = s.low - held.s0, s1 = s.high(grid_.hogels_s) - held.s0;
            for (std::size_t c = 0; c < grid_.channels; ++c) {
                const float top = mix(seen(t0, s0, c), seen(t0, s1, c), s.high_weight);
                const float bottom = mix(seen(t1, s0, c), seen(t1, s1, c), s.high_weight);
                image_.pixels(row, static_cast<std::size_t>(column), c) += mix(top, bottom, t.high_weight);
            }
        }
    }

    std::vector<LightFieldGrid> faces_;
    LightFieldGrid grid_;  // its hogels and channels are those of all faces
    Camera camera_;
    std::vector<LensPoint> points_;
    Image& image_;
};

// A block of cells between hogels, and the hogels at the cells' corners.
struct Block {
    HogelRange cells, hogels;
};

struct FaceBlock {
    std::size_t face;
    Block block;
};

// The size of blocks: rows of hogels as long as possible, which suits the fastest renderer and files, and enough rows
// for the hogels shared by neighbouring blocks to be a small part. It depends on the sampling alone, so that sums have
// the same order for every source.
HogelRange block_size(const LightFieldGrid& grid) {
    constexpr std::size_t rows = 16, max_bytes = std::size_t{64} << 20;
    const std::size_t hogel_bytes = grid.channels * grid.directions() * sizeof(float);
    const std::size_t max_hogels = std::max<std::size_t>(1, max_bytes / hogel_bytes);
    const std::size_t nt = std::min({rows, grid.hogels_t, max_hogels});
    return {0, 0, std::min(grid.hogels_s, max_hogels / nt), nt};
}

std::vector<Block> blocks(const LightFieldGrid& grid) {
    const HogelRange size = block_size(grid);
    // Cells are between neighbours, so there is one less than hogels; a single hogel is its own cell.
    const std::size_t cells_s = std::max<std::size_t>(grid.hogels_s - 1, 1),
                      cells_t = std::max<std::size_t>(grid.hogels_t - 1, 1);
    std::vector<Block> list;
    for (std::size_t t = 0; t < cells_t; t += size.nt)
        for (std::size_t s = 0; s < cells_s; s += size.ns) {
            const HogelRange cells{s, t, std::min(size.ns, cells_s - s), std::min(size.nt, cells_t - t)};
            list.push_back(
                {cells, {s, t, std::min(cells.ns + 1, grid.hogels_s - s), std::min(cells.nt + 1, grid.hogels_t - t)}});
        }
    return list;
}

}  // namespace

std::vector<Image> photograph(const LightField& light_field, std::span<const Camera> cameras,
                              const RayPhotographOptions& options, const Progress& progress) {
    std::vector<Image> pictures(cameras.size());
    photograph_into(light_field, cameras, options, pictures, progress);
    return pictures;
}

void photograph_into(const LightField& light_field, std::span<const Camera> cameras,
                     const RayPhotographOptions& options, std::span<Image> pictures, const Progress& progress) {
    const core::StopScope scope(progress);
    image::require_a_picture_for_each(cameras, pictures);
    const std::vector<LightFieldGrid> grids = light_field.grids();
    const std::span<const LightField::Source> faces = light_field.faces();
    std::vector<Exposure> exposures;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Camera& camera = cameras[i];
        validate(camera);
        if (camera.focus_slope_x != 0 || camera.focus_slope_y != 0)
            throw Error(ErrorCode::usage,
                        "rays are photographed on a film parallel to the hologram; it cannot be tilted");
        exposures.emplace_back(grids, camera, std::max<std::size_t>(options.pupil_samples, 1), pictures[i]);
    }
    image::load_film(cameras, light_field.grid().channels, light_field.provenance(), pictures);
    std::vector<FaceBlock> list;
    for (std::size_t face = 0; face < faces.size(); ++face)
        for (const Block& block : blocks(grids[face])) list.push_back({face, block});
    // Reading may involve rendering, so several blocks are read in parallel; they are added in order.
    core::parallel_ordered<LightFieldTile>(
        list.size(), thread_count(),
        [&](std::size_t i) {
            LightFieldTile tile(grids[list[i].face], list[i].block.hogels, false);
            faces[list[i].face]->read(tile);
            return tile;
        },
        [&](std::size_t i, LightFieldTile& tile) {
            for (Exposure& exposure : exposures) exposure.add(list[i].face, tile, list[i].block.cells);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(list.size()));
        });
    for (Exposure& exposure : exposures) exposure.finish();
}

}  // namespace hogel
