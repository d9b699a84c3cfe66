// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <numbers>
#include <numeric>

#include "hogel/core/object_pool.h"
#include "hogel/hologram/hogel_synthesis.h"
#include "hogel/hologram/windows/overlap_add.h"
#include "hogel/units.h"

namespace hogel {

using namespace hologram;

namespace {

using Complex = std::complex<float>;

std::size_t samples_per_hogel(const LightFieldGrid& light_field, const HologramOptions& options) {
    return static_cast<std::size_t>(std::max(1.0, std::round(light_field.pitch / options.pitch)));
}

// Whether each ray is a wave with a phase of its own.
bool by_ray(const HologramOptions& options) {
    return options.phases == Phases::phase_added || options.phases == Phases::phase_added_exact;
}

// What the looks of a range of hogels share, [hogel][...], row by row.
struct Prepared {
    HogelRange range;
    Array<float, 2> values;
};

std::vector<LightFieldGrid> grids_of(std::span<const LightFieldSource* const> faces) {
    std::vector<LightFieldGrid> grids;
    for (const LightFieldSource* face : faces) grids.push_back(face->grid());
    return grids;
}

// Hogels side by side.
class Stereogram final : public FieldSource {
  public:
    Stereogram(std::span<const LightFieldSource* const> faces, const FieldGrid& grid, const HologramOptions& options,
               RayValues values)
        : faces_(faces.begin(), faces.end()),
          options_(options),
          grid_(grid),
          columns_(grid.plane.width / front().hogels_s),
          rows_(grid.plane.height / front().hogels_t) {
        for (const LightFieldSource* face : faces) rays_ += face->grid().directions();
        synthesis_ = options.method == Method::basis ? make_basis_synthesis(front(), columns_, options, values)
                     : by_ray(options)               ? make_phase_added_synthesis(front(), columns_, options)
                     : options.line_pitch > 0        ? make_line_synthesis(grids_of(faces), columns_, rows_, options)
                                                     : make_fourier_synthesis(grids_of(faces), columns_, options);
    }

    const FieldGrid& grid() const override { return grid_; }
    std::size_t looks() const override { return options_.looks; }
    std::size_t alignment() const override { return std::lcm(columns_, rows_); }

    void read(const Region& region, std::size_t look, View<Complex, 2> out) const override {
        if (region.samples() == 0) return;
        HogelRange hogels{region.x0 / columns_, region.y0 / rows_, 0, 0};
        hogels.ns = (region.x0 + region.width - 1) / columns_ + 1 - hogels.s0;
        hogels.nt = (region.y0 + region.height - 1) / rows_ + 1 - hogels.t0;
        auto room = rooms_.take();
        if (room->square.size() == 0) room->square = Array<Complex, 2>({rows_, columns_});
        if (options_.looks > 1) {
            write(prepare(hogels)->values, hogels, 0, look, region, room->square, out);
            return;
        }
        const View<const float, 5> whole = rays_in_memory(hogels);
        // What one look alone needs stays in the cache, a few hogels at a time.
        const std::size_t values = synthesis_->prepared_size();
        if (room->prepared.size() == 0) room->prepared = Array<float, 2>({hogels_together, values});
        for_each_band(hogels, [&](const HogelRange& band) {
            if (whole.size() == 0) read_rays(band, room->rays);
            for (std::size_t first = 0; first < band.hogels(); first += hogels_together) {
                const View<float, 2> some(room->prepared.data(),
                                          {std::min(hogels_together, band.hogels() - first), values});
                if (whole.size() > 0)
                    synthesis_->prepare(
                        {&whole(options_.channel, band.t0, band.s0, 0, 0) + first * rays_, {some.extent(0), rays_}}, {},
                        some);
                else
                    prepare(room->rays, first, some);
                write(some, band, first, look, region, room->square, out);
            }
        });
    }

  private:
    static constexpr std::size_t hogels_together = 16;
    // A region has hundreds of hogels, whose rays may be gigabytes: so many are read at a time, or one row of hogels.
    static constexpr std::size_t max_ray_bytes = std::size_t{1} << 27;

    const LightFieldGrid& front() const { return faces_.front()->grid(); }

    // What a region is made in.
    struct Room {
        std::vector<LightFieldTile> rays;  // of each face
        Array<float, 2> prepared;          // [hogels_together][...]
        Array<Complex, 2> square;          // a hogel
    };

    // All rays where they lie, if they need not be read: in memory, and those of the hogels one after the other.
    View<const float, 5> rays_in_memory(const HogelRange& hogels) const {
        if (faces_.size() > 1 || needs_depth(options_) || (hogels.nt > 1 && hogels.ns < front().hogels_s)) return {};
        return faces_.front()->in_memory();
    }

    // Rows of hogels whose rays are read at once, from the first to the last.
    template <class Use>
    void for_each_band(const HogelRange& hogels, const Use& use) const {
        const std::size_t values = front().channels + (needs_depth(options_) ? 1 : 0);
        const std::size_t row_bytes = hogels.ns * rays_ * values * sizeof(float);
        const std::size_t most = std::max<std::size_t>(1, max_ray_bytes / row_bytes);
        const std::size_t bands = (hogels.nt + most - 1) / most, rows = (hogels.nt + bands - 1) / bands;
        for (std::size_t t = 0; t < hogels.nt; t += rows)
            use(HogelRange{hogels.s0, hogels.t0 + t, hogels.ns, std::min(rows, hogels.nt - t)});
    }

    void read_rays(const HogelRange& hogels, std::vector<LightFieldTile>& tiles) const {
        tiles.resize(faces_.size());
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            LightFieldTile& tile = tiles[i];
            if (tile.range.ns != hogels.ns || tile.range.nt != hogels.nt)
                tile = LightFieldTile(faces_[i]->grid(), hogels, needs_depth(options_));
            tile.range = hogels;
            faces_[i]->read(tile);
        }
    }

    // Hogels number first, first + 1, ... of the tiles, in each of which they lie one after the other, row by row.
    void prepare(std::span<const LightFieldTile> tiles, std::size_t first, View<float, 2> prepared) const {
        const Shape<2> rays{prepared.extent(0), rays_};
        if (tiles.size() > 1) {
            Array<float, 2> together(rays);
            float* to = together.data();
            for (std::size_t hogel = first; hogel < first + rays[0]; ++hogel)
                for (const LightFieldTile& face : tiles) {
                    const auto all = face.radiance.view()[options_.channel];
                    const std::size_t directions = all.extent(2) * all.extent(3);
                    to = std::copy_n(all.data() + hogel * directions, directions, to);
                }
            return synthesis_->prepare(together, {}, prepared);
        }
        const LightFieldTile& tile = tiles.front();
        const View<const float, 2> depths(tile.depth.data() + first * rays_, rays);
        synthesis_->prepare({tile.radiance.view()[options_.channel].data() + first * rays_, rays},
                            tile.depth.size() > 0 ? depths : View<const float, 2>(), prepared);
    }

    // The parts that the region asks for of hogels number first, first + 1, ... of a range.
    void write(View<const float, 2> prepared, const HogelRange& hogels, std::size_t first, std::size_t look,
               const Region& region, View<Complex, 2> square, View<Complex, 2> out) const {
        for (std::size_t i = 0; i < prepared.extent(0); ++i) {
            const HogelPlace place{hogels.s0 + (first + i) % hogels.ns, hogels.t0 + (first + i) / hogels.ns, look};
            const std::size_t y0 = std::max(place.t * rows_, region.y0),
                              y1 = std::min((place.t + 1) * rows_, region.y0 + region.height),
                              x0 = std::max(place.s * columns_, region.x0),
                              x1 = std::min((place.s + 1) * columns_, region.x0 + region.width);
            Complex* to = &out(y0 - region.y0, x0 - region.x0);
            if (y1 - y0 == rows_ && x1 - x0 == columns_) {
                synthesis_->synthesise_to(prepared[i].elements(), place, square, to, region.width);
                continue;
            }
            synthesis_->synthesise(prepared[i].elements(), place, square);
            for (std::size_t y = y0; y < y1; ++y)
                std::copy_n(&square(y - place.t * rows_, x0 - place.s * columns_), x1 - x0,
                            to + (y - y0) * region.width);
        }
    }

    std::shared_ptr<const Prepared> prepare(const HogelRange& hogels) const {
        {
            const std::lock_guard lock(recent_mutex_);
            for (const auto& entry : recent_)
                if (entry->range == hogels) return entry;
        }
        const std::size_t values = synthesis_->prepared_size();
        auto prepared = std::make_shared<Prepared>();
        prepared->range = hogels;
        prepared->values = Array<float, 2>({hogels.hogels(), values});
        std::vector<LightFieldTile> tiles;
        for_each_band(hogels, [&](const HogelRange& band) {
            read_rays(band, tiles);
            const std::size_t first = (band.t0 - hogels.t0) * band.ns;
            prepare(tiles, 0, {prepared->values.data() + first * values, {band.hogels(), values}});
        });
        const std::lock_guard lock(recent_mutex_);
        recent_.push_front(prepared);
        if (recent_.size() > max_recent) recent_.pop_back();
        return prepared;
    }

    // Readers take the looks of a region one after the other, each in a thread of its own.
    static constexpr std::size_t max_recent = 64;

    std::vector<const LightFieldSource*> faces_;  // the front first
    HologramOptions options_;
    FieldGrid grid_;
    std::size_t columns_, rows_;  // samples of a hogel
    std::size_t rays_ = 0;        // of a hogel, of all faces
    std::unique_ptr<HogelSynthesis> synthesis_;
    mutable core::ObjectPool<Room> rooms_;
    mutable std::mutex recent_mutex_;
    mutable std::list<std::shared_ptr<const Prepared>> recent_;
};

// Added phases give every ray one wave, so rays farther apart than a hogel's lobes would leave gaps between them.
void require_enough_directions(const LightFieldGrid& light_field, const HologramOptions& options) {
    const double step = options.wavelength / light_field.pitch;
    if (std::max(light_field.step_u(), light_field.step_v()) <= step) return;
    const auto enough = [&](double half) { return std::ceil(2 * half / step); };
    throw Error(
        ErrorCode::usage,
        fmt::format("a hogel of {} shows directions {:.4f} apart at {}, but the light field's are {:.4f} apart; "
                    "added phases need {}x{} directions or more",
                    format_length(light_field.pitch), step, format_length(options.wavelength),
                    std::max(light_field.step_u(), light_field.step_v()), enough(light_field.half_u()),
                    enough(light_field.half_v())));
}

void require_diffraction(const LightFieldGrid& light_field, const HologramOptions& options, double pitch) {
    // The steepest frequencies on the axes; the corners of the field of view are cut by the light field's own square.
    const double edge = std::max(std::abs(light_field.center_u()) + light_field.half_u(),
                                 std::abs(light_field.center_v()) + light_field.half_v());
    // The outermost cells of a frequency grid are those of its outermost frequencies.
    const double needed = !light_field.is_perspective() ? std::min(1.0, edge - 0.5 * light_field.step_u())
                                                        : edge / std::sqrt(1 + edge * edge);
    const double possible = options.wavelength / (2 * pitch);
    if (needed > possible)
        throw Error(
            ErrorCode::usage,
            fmt::format(
                "a pitch of {} diffracts {} no farther than {:.2f} degrees, but the light field reaches {:.2f}; "
                "a pitch of {} or less would do",
                format_length(pitch), format_length(options.wavelength),
                std::asin(std::min(possible, 1.0)) * 180 / std::numbers::pi, std::asin(needed) * 180 / std::numbers::pi,
                format_length(options.wavelength / (2 * needed))));
}

// How many lines a hogel holds of a hologram with horizontal parallax only.
std::size_t lines_per_hogel(std::span<const LightFieldGrid> faces, const HologramOptions& options) {
    if (options.method != Method::fourier || by_ray(options))
        throw Error(ErrorCode::usage,
                    "lines of a hologram with horizontal parallax only know nothing of each other; expected the method "
                    "fourier with random, fixed or designed phases");
    for (const LightFieldGrid& face : faces) {
        if (face.directions_v != 1)
            throw Error(ErrorCode::usage,
                        fmt::format("a hologram with horizontal parallax only is made of one row of directions, but "
                                    "the light field has {}; {}x1 directions would do",
                                    face.directions_v, face.directions_u));
        if (face.face() == Face::top || face.face() == Face::bottom)
            throw Error(ErrorCode::usage, fmt::format("a hologram with horizontal parallax only has no use for the {} "
                                                      "face; front, left and right would do",
                                                      face_name(face.face())));
    }
    return static_cast<std::size_t>(std::max(1.0, std::round(faces.front().pitch / options.line_pitch)));
}

}  // namespace

FieldGrid hologram_grid(const LightFieldGrid& light_field, const HologramOptions& options) {
    return hologram_grid(std::span(&light_field, 1), options);
}

FieldGrid hologram_grid(std::span<const LightFieldGrid> faces, const HologramOptions& options) {
    const LightFieldGrid& front = faces.front();
    for (const LightFieldGrid& face : faces) {
        validate(face, ErrorCode::usage, "light field");
        if (!same_hogels(face, front))
            throw Error(ErrorCode::usage, fmt::format("the {} face has other hogels or channels than the {} face",
                                                      face_name(face.face()), face_name(front.face())));
    }
    if (front.face() != Face::front)
        throw Error(ErrorCode::usage, fmt::format("a stereogram begins with the front face of a light field, not with "
                                                  "the {} face",
                                                  face_name(front.face())));
    if (!(options.pitch > 0) || !(options.wavelength > 0) || !(options.line_pitch >= 0))
        throw Error(ErrorCode::usage, "a stereogram needs a positive pitch and wavelength");
    if (options.channel >= front.channels)
        throw Error(ErrorCode::usage, fmt::format("the light field has {} channels, so there is no channel {}",
                                                  front.channels, options.channel));
    if (options.method == Method::overlap_add && (by_ray(options) || options.phases == Phases::designed))
        throw Error(ErrorCode::usage,
                    "overlapping windows carry the phases of the scene's points, which are random or fixed (none)");
    if (options.method == Method::basis && (by_ray(options) || options.phases == Phases::random))
        throw Error(ErrorCode::usage,
                    "basis fringes are the same in all hogels, so their phases are fixed or designed");
    const bool front_alone = options.method != Method::fourier || by_ray(options);
    if (faces.size() > 1 && front_alone)
        throw Error(ErrorCode::usage,
                    "of a hemicube's sides only the method fourier knows, with random, fixed or designed phases; "
                    "others expect a light field of one face");
    if (needs_depth(options)) require_perspective(front, ErrorCode::usage, "a hologram with phases by depth");
    const std::size_t n = samples_per_hogel(front, options);
    const double pitch = front.pitch / static_cast<double>(n);
    if (faces.size() == 1) require_diffraction(front, options, pitch);
    const std::size_t rows = options.line_pitch > 0 ? lines_per_hogel(faces, options) : n;
    if (by_ray(options)) require_enough_directions(front, options);
    FieldGrid grid;
    grid.plane = {front.hogels_s * n, front.hogels_t * rows, pitch, front.pitch / static_cast<double>(rows), 0, 0};
    grid.wavelength = options.wavelength;
    validate(grid, ErrorCode::usage, "stereogram");
    return grid;
}

bool needs_depth(const HologramOptions& options) { return options.method == Method::overlap_add || by_ray(options); }

std::unique_ptr<FieldSource> make_hologram(const LightFieldSource& light_field, const HologramOptions& options) {
    const LightFieldSource* const only = &light_field;
    return make_hologram({&only, 1}, options);
}

std::unique_ptr<FieldSource> make_hologram(std::span<const LightFieldSource* const> faces,
                                           const HologramOptions& options) {
    const FieldGrid grid = hologram_grid(grids_of(faces), options);
    if (needs_depth(options) && !faces.front()->has_depth())
        throw Error(ErrorCode::usage,
                    "this hologram needs the depth of every ray, and the light field has none; render it with depth");
    if (options.method == Method::overlap_add) return windows::make_overlap_add(*faces.front(), grid, options);
    return std::make_unique<Stereogram>(faces, grid, options, RayValues::radiance);
}

std::unique_ptr<FieldSource> make_hologram_of_coefficients(const LightFieldSource& coefficients,
                                                           const HologramOptions& options) {
    const FieldGrid grid = hologram_grid(coefficients.grid(), options);
    if (options.method != Method::basis) throw Error(ErrorCode::usage, "only basis fringes are made of coefficients");
    const LightFieldSource* const only = &coefficients;
    return std::make_unique<Stereogram>(std::span(&only, 1), grid, options, RayValues::coefficients);
}

}  // namespace hogel
