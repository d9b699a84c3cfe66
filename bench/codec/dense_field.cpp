// SPDX-License-Identifier: Apache-2.0
#include "bench/codec/dense_field.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hogel/core/random.h"

namespace hogel::bench {
namespace {

constexpr std::size_t ellipses = 28, waves = 4;
constexpr double max_disparity = 2;
constexpr double max_frequency = 0.22;  // of textures, in cycles per direction

// Sequence of random numbers from 0 to 1, the same in every run.
class Numbers {
  public:
    double operator()() { return core::philox({next_++, 0, 0, 0}, {2000, 4})[0] * 0x1p-32; }
    double between(double low, double high) { return low + (high - low) * (*this)(); }

  private:
    std::uint32_t next_ = 0;
};

// Part of a plane that the middle hogel sees as an ellipse. The coordinates (x, y) of its points are their directions
// from the middle hogel. Their disparity is p = p0 + a x + b y.
struct Surface {
    double p0, a, b;
    double x, y, along, across, cosine, sine;  // the ellipse: centre, half axes, rotation
    double brightness;
    struct Wave {
        double u, v, phase;
    };
    std::array<Wave, waves> texture;

    // Disparity seen by the hogel at (i, j) from the middle one in direction (u, v): x = u + p i, y = v + p j.
    double disparity(double u, double v, double i, double j) const {
        return (p0 + a * u + b * v) / (1 - a * i - b * j);
    }
    bool covers(double at_x, double at_y) const {
        const double dx = at_x - x, dy = at_y - y;
        const double m = (cosine * dx + sine * dy) / along, n = (cosine * dy - sine * dx) / across;
        return m * m + n * n < 1;
    }
    double radiance(double at_x, double at_y) const {
        double product = 1, sum = 0;
        for (const Wave& wave : texture) {
            const double value = std::sin(wave.u * at_x + wave.v * at_y + wave.phase);
            sum += value;
            product *= value;
        }
        return brightness * (0.5 + 0.3 * std::tanh(sum) + 0.2 * product);
    }
};

class DenseField final : public LightFieldSource {
  public:
    DenseField(const LightFieldGrid& grid, Brightness brightness) : grid_(grid) {
        grid_.channels = 1;
        Numbers number;
        const double width = static_cast<double>(grid.directions_u), height = static_cast<double>(grid.directions_v);
        for (std::size_t k = 0; k <= ellipses; ++k) {
            const bool ground = k == 0;
            Surface surface{};
            surface.p0 = ground ? 0.25 : number.between(0.3, 0.8 * max_disparity);
            const double slant = (ground ? 0.05 : 0.2) * max_disparity / width;
            surface.a = number.between(-slant, slant);
            surface.b = number.between(-slant, slant);
            surface.x = number() * width;
            surface.y = number() * height;
            surface.p0 -= surface.a * surface.x + surface.b * surface.y;
            surface.along = ground ? 1e9 : number.between(0.06, 0.25) * width;
            surface.across = ground ? 1e9 : number.between(0.06, 0.25) * width;
            const double angle = number() * std::numbers::pi;
            surface.cosine = std::cos(angle);
            surface.sine = std::sin(angle);
            surface.brightness = brightness == Brightness::even ? number.between(0.4, 1) : std::pow(10, -4 * number());
            for (Surface::Wave& wave : surface.texture) {
                const double rate = 2 * std::numbers::pi * max_frequency * std::pow(0.05, number());
                const double direction = 2 * std::numbers::pi * number();
                wave = {rate * std::cos(direction), rate * std::sin(direction), 2 * std::numbers::pi * number()};
            }
            surfaces_.push_back(surface);
        }
    }

    const LightFieldGrid& grid() const override { return grid_; }
    void read(LightFieldTile& tile) const override {
        validate(tile, grid_);
        const HogelRange& range = tile.range;
        for (std::size_t t = 0; t < range.nt; ++t)
            for (std::size_t s = 0; s < range.ns; ++s)
                for (std::size_t v = 0; v < grid_.directions_v; ++v)
                    for (std::size_t u = 0; u < grid_.directions_u; ++u)
                        tile.radiance(0, t, s, v, u) = static_cast<float>(radiance_of_ray(
                            from_middle(range.s0 + s, grid_.hogels_s), from_middle(range.t0 + t, grid_.hogels_t),
                            static_cast<double>(u), static_cast<double>(v)));
    }

  private:
    static double from_middle(std::size_t k, std::size_t count) {
        return static_cast<double>(k) - static_cast<double>(count - 1) / 2;
    }
    // Returns the radiance of the nearest surface on the ray, the one with the largest disparity.
    double radiance_of_ray(double i, double j, double u, double v) const {
        double nearest = surfaces_.front().disparity(u, v, i, j);
        const Surface* surface_at_ray = &surfaces_.front();
        for (const Surface& surface : surfaces_) {
            const double p = surface.disparity(u, v, i, j);
            if (p > nearest && surface.covers(u + p * i, v + p * j)) {
                nearest = p;
                surface_at_ray = &surface;
            }
        }
        return surface_at_ray->radiance(u + nearest * i, v + nearest * j);
    }

    LightFieldGrid grid_;
    std::vector<Surface> surfaces_;
};

}  // namespace

std::unique_ptr<LightFieldSource> make_dense_field(const LightFieldGrid& grid, Brightness brightness) {
    return std::make_unique<DenseField>(grid, brightness);
}

}  // namespace hogel::bench
