#include "hogel/hologram/stereogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <numbers>

#include "hogel/core/units.h"
#include "hogel/hologram/frequency_grid.h"
#include "hogel/hologram/random_phase.h"
#include "hogel/math/fft.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;

std::size_t samples_per_hogel(const LightFieldGrid& light_field, const StereogramOptions& options) {
    return static_cast<std::size_t>(std::max(1.0, std::round(light_field.pitch / options.pitch)));
}

// The moduli of the DFT coefficients of a range of hogels, [nt][ns][n²]: the same for every look.
struct Moduli {
    HogelRange range;
    Array<float, 3> values;
};

class Stereogram final : public FieldSource {
  public:
    Stereogram(const LightFieldSource& light_field, const StereogramOptions& options)
        : light_field_(light_field),
          options_(options),
          grid_(stereogram_grid(light_field.grid(), options)),
          n_(samples_per_hogel(light_field.grid(), options)),
          frequencies_(light_field.grid(), n_, options.wavelength),
          fft_(n_, n_) {}

    const FieldGrid& grid() const override { return grid_; }
    std::size_t looks() const override { return options_.looks; }
    std::size_t alignment() const override { return n_; }

    void read(const Region& region, std::size_t look, View<Complex, 2> out) const override {
        if (region.samples() == 0) return;
        HogelRange hogels{region.x0 / n_, region.y0 / n_, 0, 0};
        hogels.ns = (region.x0 + region.width - 1) / n_ + 1 - hogels.s0;
        hogels.nt = (region.y0 + region.height - 1) / n_ + 1 - hogels.t0;
        const std::shared_ptr<const Moduli> moduli = moduli_of(hogels);
        Array<Complex, 2> hogel({n_, n_});
        for (std::size_t t = hogels.t0; t < hogels.t0 + hogels.nt; ++t)
            for (std::size_t s = hogels.s0; s < hogels.s0 + hogels.ns; ++s) {
                spread_random_phases(phases(s, t, look), moduli->values[t - hogels.t0][s - hogels.s0].elements(),
                                     hogel.elements());
                fft_.backward(hogel);
                // The part of the hogel that the region asks for.
                const std::size_t x0 = std::max(s * n_, region.x0),
                                  x1 = std::min((s + 1) * n_, region.x0 + region.width);
                const std::size_t y0 = std::max(t * n_, region.y0),
                                  y1 = std::min((t + 1) * n_, region.y0 + region.height);
                for (std::size_t y = y0; y < y1; ++y)
                    std::copy(&hogel(y - t * n_, x0 - s * n_), &hogel(y - t * n_, x0 - s * n_) + (x1 - x0),
                              &out(y - region.y0, x0 - region.x0));
            }
    }

  private:
    // Phases are counted from the hogel's first sample; the factor i of [K] (4.2) is part of them.
    PhaseSeries phases(std::size_t s, std::size_t t, std::size_t look) const {
        return {{static_cast<std::uint32_t>(options_.seed), static_cast<std::uint32_t>(options_.seed >> 32)},
                {static_cast<std::uint32_t>(look * 4 + options_.channel), static_cast<std::uint32_t>(s),
                 static_cast<std::uint32_t>(t)}};
    }

    std::shared_ptr<const Moduli> moduli_of(const HogelRange& hogels) const {
        {
            const std::lock_guard lock(recent_mutex_);
            for (const auto& entry : recent_)
                if (entry->range == hogels) return entry;
        }
        LightFieldTile tile(light_field_.grid(), hogels, false);
        light_field_.read(tile);
        auto moduli = std::make_shared<Moduli>();
        moduli->range = hogels;
        moduli->values = Array<float, 3>({hogels.nt, hogels.ns, n_ * n_});
        for (std::size_t t = 0; t < hogels.nt; ++t)
            for (std::size_t s = 0; s < hogels.ns; ++s) {
                const View<const float, 2> radiance = tile.radiance.view()[options_.channel][t][s];
                frequencies_.amplitudes(radiance.elements(), moduli->values[t][s].elements());
            }
        const std::lock_guard lock(recent_mutex_);
        recent_.push_front(moduli);
        if (recent_.size() > most_recent) recent_.pop_back();
        return moduli;
    }

    // Readers take the looks of a region one after the other, each in a thread of its own.
    static constexpr std::size_t most_recent = 64;

    const LightFieldSource& light_field_;
    StereogramOptions options_;
    FieldGrid grid_;
    std::size_t n_;
    FrequencyGrid frequencies_;
    Fft2 fft_;
    mutable std::mutex recent_mutex_;
    mutable std::list<std::shared_ptr<const Moduli>> recent_;
};

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
    FieldGrid grid;
    grid.plane = {light_field.hogels_s * n, light_field.hogels_t * n, pitch, pitch, 0, 0};
    grid.wavelength = options.wavelength;
    validate(grid, ErrorCode::usage, "stereogram");
    return grid;
}

std::unique_ptr<FieldSource> make_stereogram(const LightFieldSource& light_field, const StereogramOptions& options) {
    return std::make_unique<Stereogram>(light_field, options);
}

}  // namespace hogel
