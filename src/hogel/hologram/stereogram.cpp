#include "hogel/hologram/stereogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <numbers>

#include "hogel/core/units.h"
#include "hogel/hologram/hogel_synthesis_internal.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;

std::size_t samples_per_hogel(const LightFieldGrid& light_field, const StereogramOptions& options) {
    return static_cast<std::size_t>(std::max(1.0, std::round(light_field.pitch / options.pitch)));
}

// Whether each ray is a wave with a phase of its own.
bool by_ray(const StereogramOptions& options) {
    return options.phases == Phases::added || options.phases == Phases::added_exactly;
}

// What the looks of a range of hogels share, [nt][ns][...].
struct Prepared {
    HogelRange range;
    Array<float, 3> values;
};

// Hogels side by side.
class Stereogram final : public FieldSource {
  public:
    Stereogram(const LightFieldSource& light_field, const FieldGrid& grid, const StereogramOptions& options,
               Values values)
        : light_field_(light_field),
          options_(options),
          grid_(grid),
          n_(samples_per_hogel(light_field.grid(), options)) {
        synthesis_ = options.method == Method::basis ? make_basis_synthesis(light_field.grid(), n_, options, values)
                     : by_ray(options)               ? make_phase_added_synthesis(light_field.grid(), n_, options)
                                                     : make_fourier_synthesis(light_field.grid(), n_, options);
    }

    const FieldGrid& grid() const override { return grid_; }
    std::size_t looks() const override { return options_.looks; }
    std::size_t alignment() const override { return n_; }

    void read(const Region& region, std::size_t look, View<Complex, 2> out) const override {
        if (region.samples() == 0) return;
        HogelRange hogels{region.x0 / n_, region.y0 / n_, 0, 0};
        hogels.ns = (region.x0 + region.width - 1) / n_ + 1 - hogels.s0;
        hogels.nt = (region.y0 + region.height - 1) / n_ + 1 - hogels.t0;
        Array<Complex, 2> square({n_, n_});
        if (options_.looks > 1) {
            const std::shared_ptr<const Prepared> prepared = prepare(hogels);
            for (std::size_t t = 0; t < hogels.nt; ++t)
                write_row(prepared->values[t], {hogels.s0, hogels.t0 + t, look}, region, square, out);
            return;
        }
        // What one look alone needs stays in the cache, a few hogels at a time.
        const LightFieldTile tile = read_rays(hogels);
        Array<float, 2> prepared({std::min(hogels_together, hogels.ns), synthesis_->prepared_size()});
        for (std::size_t t = 0; t < hogels.nt; ++t)
            for (std::size_t s = 0; s < hogels.ns; s += hogels_together) {
                const std::size_t count = std::min(hogels_together, hogels.ns - s);
                const View<float, 2> some(prepared.data(), {count, synthesis_->prepared_size()});
                prepare(tile, t, s, some);
                write_row(some, {hogels.s0 + s, hogels.t0 + t, look}, region, square, out);
            }
    }

  private:
    static constexpr std::size_t hogels_together = 16;

    LightFieldTile read_rays(const HogelRange& hogels) const {
        LightFieldTile tile(light_field_.grid(), hogels, needs_depth(options_));
        light_field_.read(tile);
        return tile;
    }

    // Hogels s, s+1, ... of row t of a tile, which lie one after the other.
    void prepare(const LightFieldTile& tile, std::size_t t, std::size_t s, View<float, 2> prepared) const {
        const Shape<2> rays{prepared.extent(0), light_field_.grid().directions()};
        synthesis_->prepare(
            {&tile.radiance(options_.channel, t, s, 0, 0), rays},
            tile.depth.size() > 0 ? View<const float, 2>(&tile.depth(t, s, 0, 0), rays) : View<const float, 2>(),
            prepared);
    }

    // The parts of hogels in a row, the first of them at `place`, that the region asks for.
    void write_row(View<const float, 2> prepared, HogelPlace place, const Region& region, View<Complex, 2> square,
                   View<Complex, 2> out) const {
        const std::size_t y0 = std::max(place.t * n_, region.y0),
                          y1 = std::min((place.t + 1) * n_, region.y0 + region.height);
        for (std::size_t i = 0; i < prepared.extent(0); ++i, ++place.s) {
            synthesis_->synthesise(prepared[i].elements(), place, square);
            const std::size_t x0 = std::max(place.s * n_, region.x0),
                              x1 = std::min((place.s + 1) * n_, region.x0 + region.width);
            for (std::size_t y = y0; y < y1; ++y)
                std::copy_n(&square(y - place.t * n_, x0 - place.s * n_), x1 - x0, &out(y - region.y0, x0 - region.x0));
        }
    }

    std::shared_ptr<const Prepared> prepare(const HogelRange& hogels) const {
        {
            const std::lock_guard lock(recent_mutex_);
            for (const auto& entry : recent_)
                if (entry->range == hogels) return entry;
        }
        const LightFieldTile tile = read_rays(hogels);
        auto prepared = std::make_shared<Prepared>();
        prepared->range = hogels;
        prepared->values = Array<float, 3>({hogels.nt, hogels.ns, synthesis_->prepared_size()});
        for (std::size_t t = 0; t < hogels.nt; ++t) prepare(tile, t, 0, prepared->values[t]);
        const std::lock_guard lock(recent_mutex_);
        recent_.push_front(prepared);
        if (recent_.size() > most_recent) recent_.pop_back();
        return prepared;
    }

    // Readers take the looks of a region one after the other, each in a thread of its own.
    static constexpr std::size_t most_recent = 64;

    const LightFieldSource& light_field_;
    StereogramOptions options_;
    FieldGrid grid_;
    std::size_t n_;
    std::unique_ptr<HogelSynthesis> synthesis_;
    mutable std::mutex recent_mutex_;
    mutable std::list<std::shared_ptr<const Prepared>> recent_;
};

// Added phases give every ray one wave, so rays farther apart than a hogel's lobes would leave gaps between them.
void require_enough_directions(const LightFieldGrid& light_field, const StereogramOptions& options) {
    const double step = options.wavelength / light_field.pitch;
    if (std::max(light_field.step_u(), light_field.step_v()) <= step) return;
    const auto enough = [&](double half) { return std::ceil(2 * half / step); };
    throw Error(
        ErrorCode::usage,
        fmt::format("a hogel of {} shows directions {:.4f} apart at {}, but the light field's are {:.4f} apart; "
                    "added phases need {}x{} directions or more",
                    format_length(light_field.pitch), step, format_length(options.wavelength),
                    std::max(light_field.step_u(), light_field.step_v()), enough(light_field.tan_half_u),
                    enough(light_field.tan_half_v)));
}

}  // namespace

FieldGrid stereogram_grid(const LightFieldGrid& light_field, const StereogramOptions& options) {
    validate(light_field, ErrorCode::usage, "light field");
    if (light_field.face != Face::front)
        throw Error(ErrorCode::usage, fmt::format("a stereogram is made of the front face of a light field, not of the "
                                                  "{} face",
                                                  name(light_field.face)));
    if (!(options.pitch > 0) || !(options.wavelength > 0))
        throw Error(ErrorCode::usage, "a stereogram needs a positive pitch and wavelength");
    if (options.channel >= light_field.channels)
        throw Error(ErrorCode::usage, fmt::format("the light field has {} channels, so there is no channel {}",
                                                  light_field.channels, options.channel));
    const std::size_t n = samples_per_hogel(light_field, options);
    const double pitch = light_field.pitch / static_cast<double>(n);
    // The steepest frequencies on the axes; the corners of the field of view are cut by the light field's own square.
    const double tangent = std::max(std::abs(light_field.center_u) + light_field.tan_half_u,
                                    std::abs(light_field.center_v) + light_field.tan_half_v);
    const double needed = tangent / std::sqrt(1 + tangent * tangent), possible = options.wavelength / (2 * pitch);
    if (needed > possible)
        throw Error(
            ErrorCode::usage,
            fmt::format(
                "a pitch of {} diffracts {} no farther than {:.2f} degrees, but the light field reaches {:.2f}; "
                "a pitch of {} or less would do",
                format_length(pitch), format_length(options.wavelength),
                std::asin(std::min(possible, 1.0)) * 180 / std::numbers::pi,
                std::atan(tangent) * 180 / std::numbers::pi, format_length(options.wavelength / (2 * needed))));
    if (options.method == Method::overlap_add && (by_ray(options) || options.phases == Phases::designed))
        throw Error(ErrorCode::usage,
                    "overlapping windows carry the phases of the scene's points, which are random or fixed (none)");
    if (options.method == Method::basis && (by_ray(options) || options.phases == Phases::random))
        throw Error(ErrorCode::usage,
                    "basis fringes are the same in all hogels, so their phases are fixed or designed");
    if (by_ray(options)) require_enough_directions(light_field, options);
    FieldGrid grid;
    grid.plane = {light_field.hogels_s * n, light_field.hogels_t * n, pitch, pitch, 0, 0};
    grid.wavelength = options.wavelength;
    validate(grid, ErrorCode::usage, "stereogram");
    return grid;
}

bool needs_depth(const StereogramOptions& options) { return options.method == Method::overlap_add || by_ray(options); }

std::unique_ptr<FieldSource> make_stereogram(const LightFieldSource& light_field, const StereogramOptions& options) {
    const FieldGrid grid = stereogram_grid(light_field.grid(), options);
    if (needs_depth(options) && !light_field.has_depth())
        throw Error(ErrorCode::usage,
                    "this hologram needs the depth of every ray, and the light field has none; render it with depth");
    if (options.method == Method::overlap_add) return make_overlap_add(light_field, grid, options);
    return std::make_unique<Stereogram>(light_field, grid, options, Values::radiance);
}

std::unique_ptr<FieldSource> make_stereogram_of_coefficients(const LightFieldSource& coefficients,
                                                             const StereogramOptions& options) {
    const FieldGrid grid = stereogram_grid(coefficients.grid(), options);
    if (options.method != Method::basis) throw Error(ErrorCode::usage, "only basis fringes are made of coefficients");
    return std::make_unique<Stereogram>(coefficients, grid, options, Values::coefficients);
}

}  // namespace hogel
