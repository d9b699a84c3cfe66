// SPDX-License-Identifier: Apache-2.0
#include "hogel/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/optics/lines.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/patterns/pupils/film.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {
namespace {

using Complex = std::complex<float>;

// Limits of the points of a led: wavelengths, and all points times wavelengths.
constexpr std::size_t max_led_wavelengths = 21, max_led_waves = 400;

double sinc(double x) {
    const double angle = std::numbers::pi * x;
    return std::abs(angle) < 1e-6 ? 1 : std::sin(angle) / angle;
}

// Point of a source: tilt of its light, radians.
struct SourcePoint {
    double x = 0, y = 0;
};

struct Wavelength {
    double metres = 0, weight = 1;
};

// The points and wavelengths that stand for a source; all points have the same weight.
struct SampledSource {
    std::vector<SourcePoint> points;
    std::vector<Wavelength> wavelengths;
    bool is_converged = true;
};

// Points of equal area in a disc (Vogel, A better way to construct the sunflower head, Math. Biosciences 44, 1979).
std::vector<SourcePoint> sunflower(std::size_t count, double radius) {
    if (count == 1) return {{}};
    std::vector<SourcePoint> points;
    for (std::size_t k = 0; k < count; ++k) {
        const double r = radius * std::sqrt((static_cast<double>(k) + 0.5) / static_cast<double>(count));
        const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(k);
        points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return points;
}

// Samples a Gaussian spectrum up to 1.5 times its full width at half maximum on both sides.
std::vector<Wavelength> gaussian(double mean, double width, std::size_t count) {
    if (count == 1) return {{mean, 1}};
    std::vector<Wavelength> wavelengths;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double part = 3 * (static_cast<double>(i) / static_cast<double>(count - 1)) - 1.5;  // of the width
        wavelengths.push_back({mean + part * width, std::exp2(-4 * part * part)});
        sum += wavelengths.back().weight;
    }
    for (Wavelength& each : wavelengths) each.weight /= sum;
    return wavelengths;
}

// Samples a led so that neighbouring points, and neighbouring wavelengths, move the light in the plane in focus by at
// most half a resolution cell p/2r, and the spectrum by at most an eighth of the aperture.
SampledSource sampled_led(const Bench& bench, double pitch) {
    const LightSource& led = bench.source;
    const double cell = pitch / (2 * bench.aperture.radius), depth = std::abs(bench.focus);
    const double moved = depth * led.size / bench.focal_length / cell,
                 shifted = led.size / bench.focal_length * pitch / led.wavelength / (2 * bench.aperture.radius);
    const double across = 1 + std::ceil(2 * moved + 8 * shifted);
    const double band = std::hypot(bench.aperture.x, bench.aperture.y) + bench.aperture.radius;
    const double dispersed = depth * 3 * led.bandwidth * band / pitch / cell;
    double wavelengths = led.bandwidth > 0 ? 5 + std::ceil(2 * dispersed) : 1;
    double points = std::ceil(0.25 * std::numbers::pi * across * across);
    SampledSource sampled;
    if (wavelengths > max_led_wavelengths) {
        wavelengths = max_led_wavelengths;
        sampled.is_converged = false;
    }
    if (points * wavelengths > max_led_waves) {
        points = std::floor(max_led_waves / wavelengths);
        sampled.is_converged = false;
    }
    sampled.points = sunflower(static_cast<std::size_t>(points), led.size / (2 * bench.focal_length));
    sampled.wavelengths = gaussian(led.wavelength, led.bandwidth, static_cast<std::size_t>(wavelengths));
    return sampled;
}

SampledSource sampled(const Bench& bench, double pitch, double wavelength) {
    const LightSource& source = bench.source;
    if (source.kind == LightSource::Kind::led) return sampled_led(bench, pitch);
    const std::size_t count = source.kind == LightSource::Kind::points ? source.points : 1;
    return {sunflower(count, source.size / (2 * bench.focal_length)), {{wavelength, 1}}};
}

[[noreturn]] void refuse_bench(const char* parameter, const std::string& why) {
    throw Error(ErrorCode::usage, parameter, why);
}

void require_source(const LightSource& source) {
    if (!(source.size >= 0 && std::isfinite(source.size)))
        refuse_bench("source", "the size of the source must not be negative");
    if (source.kind == LightSource::Kind::points && (source.points == 0 || source.points > max_source_points))
        refuse_bench("source", fmt::format("expected 1 to {} points", max_source_points));
    if (source.kind != LightSource::Kind::led) return;
    if (!(source.wavelength > 0 && source.wavelength < 1e-4))
        refuse_bench("source", "the mean wavelength of a led must be above 0 and below 0.1 mm");
    if (!(source.bandwidth >= 0 && source.bandwidth < 0.5 * source.wavelength))
        refuse_bench("source", "the width of a led's spectrum must be below half its mean wavelength");
}

void require_bench(const FieldGrid& grid, const Bench& bench) {
    validate(grid, ErrorCode::usage, "the pattern");
    if (std::abs(grid.plane.pitch_x - grid.plane.pitch_y) > 1e-6 * grid.plane.pitch_x)
        refuse_bench("pitch", "the bench needs square pixels");
    if (!(bench.focal_length > 0 && std::isfinite(bench.focal_length)))
        refuse_bench("focal", "the focal length of the bench's lenses must be positive");
    const Aperture& aperture = bench.aperture;
    if (!(aperture.radius > 0 && aperture.radius <= 0.5))
        refuse_bench("aperture", "expected a radius above 0, up to 0.5 cycles a pixel");
    if (!(std::abs(aperture.x) <= 0.5 && std::abs(aperture.y) <= 0.5))
        refuse_bench("order", "expected frequencies from -0.5 to 0.5 cycles a pixel");
    if (!(bench.zero_order_stop >= 0 && bench.zero_order_stop < 1))
        refuse_bench("zero_order_stop", "expected a radius from 0 to below 1 cycle a pixel");
    if (!(bench.fill_factor > 0 && bench.fill_factor <= 1))
        refuse_bench("fill_factor", "expected a share of the area above 0, at most 1");
    if (!std::isfinite(bench.focus)) refuse_bench("focus", "the focus is not finite");
    require_source(bench.source);
}

// Returns a number of samples along an axis that the light of `pixels` pixels does not leave on one side and enter on
// the other, up to the plane in focus. The spread does not depend on the wavelength, as the aperture has one size.
std::size_t padded_side(std::size_t pixels, double pitch, const Bench& bench, double wavelength) {
    constexpr double tail = 16;  // resolution cells p/r, for the light diffracted by the edges of aperture and stop
    const double radius = bench.aperture.radius, sine = wavelength * radius / pitch;
    const double smallest = bench.zero_order_stop > 0 ? std::min(radius, bench.zero_order_stop) : radius;
    if (!(sine < 1)) refuse_bench("aperture", "light of these frequencies does not propagate");
    const double spread = std::abs(bench.focus) * sine / std::sqrt(1 - sine * sine) / pitch + tail / smallest;
    if (!(static_cast<double>(pixels) + spread <= max_modulator_side))
        refuse_bench("focus", fmt::format("the light spreads over more than {} pixels up to the plane in focus",
                                          max_modulator_side));
    return math::good_fft_size(pixels + static_cast<std::size_t>(std::ceil(spread)));
}

// Factors of a panel's light along one axis, by column or row of a film's transform.
struct AxisFactors {
    // @param pixels  of the panel, in a period of `padded` pixels
    // @param active  side of the active square, pixels
    AxisFactors(std::size_t pixels, std::size_t padded, double active_side, std::ptrdiff_t first, std::size_t count) {
        const auto n = static_cast<double>(pixels);
        for (std::size_t k = 0; k < count; ++k) {
            const std::ptrdiff_t j = first + static_cast<std::ptrdiff_t>(k);
            const double f = static_cast<double>(j) / static_cast<double>(padded);
            frequency.push_back(f);
            index.push_back(optics::wrapped(j, padded));
            active.push_back(static_cast<float>(active_side * sinc(active_side * f)));
            // The transform of n ones is a Dirichlet kernel.
            const double kernel = std::sin(std::numbers::pi * f * n) / std::sin(std::numbers::pi * f);
            mirror.emplace_back(index.back() == 0 ? sinc(f) * n
                                                  : sinc(f) * kernel * optics::unit_phasor(-0.5 * f * (n - 1)));
        }
    }
    std::vector<double> frequency;  // cycles per pixel
    std::vector<std::size_t> index;
    std::vector<float> active;
    std::vector<Complex> mirror;
};

// Returns the value with its phase, from 0 to below 2π, times a factor.
Complex with_scaled_phase(Complex value, double factor) {
    if (factor == 1) return value;
    double phase = std::arg(value);
    if (phase < -1e-5) phase += 2 * std::numbers::pi;
    return Complex(std::polar(static_cast<double>(std::abs(value)), factor * phase));
}

// A panel with a dark border at its right and lower side, and its film.
class BenchFilm {
  public:
    BenchFilm(const FieldSource& pattern, const Bench& bench, double max_radius)
        : bench_(bench),
          samples_(Shape<2>{pattern.grid().plane.height, pattern.grid().plane.width}),
          pitch_(pattern.grid().plane.pitch_x),
          active_side_(std::sqrt(bench.fill_factor)),
          padded_{"", padded_side(width(), pitch_, bench, pattern.grid().wavelength),
                  padded_side(height(), pitch_, bench, pattern.grid().wavelength), pitch_},
          fft_(padded_.height, padded_.width),
          spectrum_(Shape<2>{padded_.height, padded_.width}),
          film_(padded_, max_radius),
          field_(film_.shape()),
          intensity_(film_.shape()) {
        pattern.read({0, 0, width(), height()}, 0, samples_);
        std::fill_n(intensity_.data(), intensity_.size(), 0.0);
    }

    std::size_t width() const { return samples_.extent(1); }
    std::size_t height() const { return samples_.extent(0); }

    // Computes the spectrum of the panel, with the phases of the pattern times a factor.
    void show(double factor) {
        std::fill_n(spectrum_.data(), spectrum_.size(), Complex(0));
        // With a gap, the spectrum is that of the pattern less a mirror; expose() adds the mirror.
        const float mirror = active_side_ < 1 ? 1 : 0;
        work::parallel_for(height(), [&](std::size_t y) {
            for (std::size_t x = 0; x < width(); ++x)
                spectrum_(y, x) = with_scaled_phase(samples_(y, x), factor) - mirror;
        });
        fft_.forward(spectrum_);
    }

    // Adds the intensity of the light of one point. The spectrum moves over the aperture.
    // @param radius_factor  of the aperture's place and radius, in cycles per pixel
    void expose(const SourcePoint& point, double wavelength, double radius_factor, double weight) {
        const double x = radius_factor * bench_.aperture.x, y = radius_factor * bench_.aperture.y;
        Pupil pupil{{x - point.x * pitch_ / wavelength, y - point.y * pitch_ / wavelength,
                     radius_factor * bench_.aperture.radius},
                    bench_.focus};
        pupil.axis_x = pupil.aperture.x;
        pupil.axis_y = pupil.aperture.y;
        const AxisFactors across(width(), padded_.width, active_side_, film_.first_x(pupil), film_.columns());
        const AxisFactors down(height(), padded_.height, active_side_, film_.first_y(pupil), film_.rows());
        const double softness = std::sqrt(static_cast<double>(spectrum_.size()));  // an edge is one frequency wide
        const double scale = 1 / static_cast<double>(spectrum_.size()), stop = radius_factor * bench_.zero_order_stop;
        std::fill_n(field_.data(), field_.size(), Complex(0));
        film_.for_frequencies(pupil, wavelength, scale, [&](std::size_t row, std::size_t column, Complex factor) {
            if (stop > 0) {
                const double distance =
                    std::hypot(across.frequency[column] - pupil.axis_x + x, down.frequency[row] - pupil.axis_y + y);
                factor *= static_cast<float>(std::clamp((distance - stop) * softness + 0.5, 0.0, 1.0));
            }
            Complex light = across.active[column] * down.active[row] * spectrum_(down.index[row], across.index[column]);
            if (active_side_ < 1) light += optics::times(across.mirror[column], down.mirror[row]);
            field_(row, column) = optics::times(light, factor);
        });
        film_.transform(field_);
        work::parallel_for(field_.extent(0), [&](std::size_t row) {
            for (std::size_t column = 0; column < field_.extent(1); ++column)
                intensity_(row, column) += weight * std::norm(field_(row, column));
        });
    }

    // Returns the share of the panel's light on the film and its border.
    double efficiency() const {
        double sum = 0;
        for (const double value : intensity_.elements()) sum += value;
        const double samples_a_pixel = static_cast<double>(intensity_.size()) / static_cast<double>(spectrum_.size());
        return sum / samples_a_pixel / static_cast<double>(samples_.size());
    }

    double contrast() const;
    Image picture() const;

  private:
    const Bench& bench_;
    Array<Complex, 2> samples_;
    double pitch_, active_side_;
    Modulator padded_;
    math::Fft2 fft_;
    Array<Complex, 2> spectrum_;
    PupilFilm film_;
    Array<Complex, 2> field_;
    Array<double, 2> intensity_;
};

// See BenchPhotograph::contrast.
double BenchFilm::contrast() const {
    constexpr std::size_t side = 32;
    constexpr double samples = side * side;
    struct Window {
        double mean = 0, contrast = 0;
    };
    std::vector<Window> windows;
    const std::size_t rows = film_.rows() * height() / padded_.height,
                      columns = film_.columns() * width() / padded_.width;
    for (std::size_t y0 = 0; y0 + side <= rows; y0 += side)
        for (std::size_t x0 = 0; x0 + side <= columns; x0 += side) {
            double sum = 0, squares = 0;
            for (std::size_t y = y0; y < y0 + side; ++y)
                for (std::size_t x = x0; x < x0 + side; ++x) {
                    const double value = intensity_(y, x);
                    sum += value, squares += value * value;
                }
            if (!(sum > 0)) continue;
            windows.push_back({sum / samples, std::sqrt(std::max(0.0, samples * squares / (sum * sum) - 1))});
        }
    if (windows.empty()) return 0;
    const double brightest = std::ranges::max(windows, {}, &Window::mean).mean;
    std::erase_if(windows, [&](const Window& window) { return window.mean < 0.5 * brightest; });
    const auto middle = windows.begin() + static_cast<std::ptrdiff_t>(windows.size() / 2);
    std::ranges::nth_element(windows, middle, {}, &Window::contrast);
    return middle->contrast;
}

// Means over pixels: the film's intensity has no frequencies beyond those of its samples, so that the means follow from
// its spectrum.
Image BenchFilm::picture() const {
    const std::size_t rows = film_.rows(), columns = film_.columns();
    Array<Complex, 2> film(film_.shape());
    std::copy_n(intensity_.data(), intensity_.size(), film.data());
    math::Fft2(rows, columns).forward(film);
    Array<Complex, 2> pixels(spectrum_.shape());
    std::fill_n(pixels.data(), pixels.size(), Complex(0));
    const auto signed_index = [](std::size_t k, std::size_t n) {
        return static_cast<std::ptrdiff_t>(k) - static_cast<std::ptrdiff_t>(2 * k < n ? 0 : n);
    };
    const double scale = 1 / static_cast<double>(intensity_.size());
    for (std::size_t row = 0; row < rows; ++row) {
        const std::ptrdiff_t j = signed_index(row, rows);
        const double of_row = scale * sinc(static_cast<double>(j) / static_cast<double>(padded_.height));
        const std::size_t to = optics::wrapped(j, padded_.height);
        for (std::size_t column = 0; column < columns; ++column) {
            const std::ptrdiff_t i = signed_index(column, columns);
            const double factor = of_row * sinc(static_cast<double>(i) / static_cast<double>(padded_.width));
            pixels(to, optics::wrapped(i, padded_.width)) += static_cast<float>(factor) * film(row, column);
        }
    }
    fft_.backward(pixels);
    Image image(width(), height(), 1);
    for (std::size_t y = 0; y < height(); ++y)
        for (std::size_t x = 0; x < width(); ++x) image.pixels(y, x, 0) = std::max(0.0F, pixels(y, x).real());
    return image;
}

}  // namespace
}  // namespace hogel::patterns

namespace hogel {

BenchPhotograph photograph_on_bench(const FieldSource& pattern, const Bench& bench, const Progress& progress) {
    const core::StopScope scope(progress);
    Bench used = bench;
    if (used.aperture.radius == 0) used.aperture.radius = 0.5;
    const FieldGrid& grid = pattern.grid();
    patterns::require_bench(grid, used);
    const double design = grid.wavelength, pitch = grid.plane.pitch_x;
    const patterns::SampledSource source = patterns::sampled(used, pitch, design);
    // The aperture has one size in metres, that of `bench` at the pattern's wavelength.
    patterns::BenchFilm film(pattern, used, used.aperture.radius * design / source.wavelengths.front().metres);
    const double points = static_cast<double>(source.points.size());
    double done = 0;
    for (const auto& [wavelength, weight] : source.wavelengths) {
        film.show(design / wavelength);
        for (const patterns::SourcePoint& point : source.points) {
            progress.report(done++ / (points * static_cast<double>(source.wavelengths.size())));
            film.expose(point, wavelength, design / wavelength, weight / points);
        }
    }
    BenchPhotograph photograph{.picture = film.picture(), .contrast = film.contrast(), .efficiency = film.efficiency()};
    photograph.resolution = 0.61 * pitch / used.aperture.radius;
    photograph.points = source.points.size();
    photograph.wavelengths = source.wavelengths.size();
    photograph.is_converged = source.is_converged;
    return photograph;
}

}  // namespace hogel
