// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/pupils/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/core/stop_scope.h"
#include "hogel/math/fft.h"
#include "hogel/optics/lines.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/patterns/pupils/camera.h"
#include "hogel/work/parallel.h"

namespace hogel {

using namespace patterns;

namespace {

using Complex = std::complex<float>;

constexpr std::uint32_t pupils = 50, test_sequence = 2;

// Photographs through one pupil.
struct Pictures {
    Array<float, 2> amplitudes, intensity;
    float peak = 0;  // largest amplitude by rays in the interior
};

Pictures photograph(const PupilCamera& camera, std::span<const Array<Complex, 2>> spectra, const Pupil& pupil) {
    const Shape<2> shape = camera.film(pupil).shape();
    Pictures pictures{Array<float, 2>(shape), Array<float, 2>(shape)};
    std::vector<Array<Complex, 2>> fields;
    for (std::size_t f = 0; f < spectra.size(); ++f) fields.emplace_back(shape);
    camera.photograph_rays(pupil, pictures.amplitudes);
    camera.photograph_waves(spectra, pupil, fields, pictures.intensity);
    const Region region = camera.interior(pupil);
    for (std::size_t y = region.y0; y < region.y0 + region.height; ++y)
        for (std::size_t x = region.x0; x < region.x0 + region.width; ++x)
            pictures.peak = std::max(pictures.peak, pictures.amplitudes(y, x));
    return pictures;
}

// Sums over a window of the amplitudes a by waves and b by rays.
struct Window {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
};

constexpr std::size_t side = 8;  // of a window, samples

// Calls visit(window, first row, first column) for windows side by side.
template <class Visit>
void for_windows(const Pictures& pictures, const Region& region, const Visit& visit) {
    for (std::size_t y0 = region.y0; y0 + side <= region.y0 + region.height; y0 += side)
        for (std::size_t x0 = region.x0; x0 + side <= region.x0 + region.width; x0 += side) {
            Window window;
            for (std::size_t y = y0; y < y0 + side; ++y)
                for (std::size_t x = x0; x < x0 + side; ++x) {
                    const double a = std::sqrt(pictures.intensity(y, x)), b = pictures.amplitudes(y, x);
                    window.a += a, window.b += b, window.aa += a * a, window.bb += b * b, window.ab += a * b;
                }
            visit(window, y0, x0);
        }
}

// Wang, Bovik, Sheikh and Simoncelli, Image quality assessment, IEEE Trans. Image Processing 13(4), 2004, (13).
// @param factor  of the amplitudes by waves
double similarity(const Window& sums, double factor, double peak) {
    constexpr double n = side * side;
    const double c1 = 1e-4 * peak * peak, c2 = 9e-4 * peak * peak, a = factor * sums.a / n, b = sums.b / n;
    const double variance_a = factor * factor * sums.aa / n - a * a, variance_b = sums.bb / n - b * b;
    const double covariance = factor * sums.ab / n - a * b;
    return (2 * a * b + c1) * (2 * covariance + c2) / ((a * a + b * b + c1) * (variance_a + variance_b + c2));
}

// σ/mean of the intensities by waves in the window where the photograph by rays is flattest, of those at least half as
// bright as its peak.
double contrast_of(const Pictures& pictures, const Region& region) {
    constexpr double n = side * side;
    double flattest = std::numeric_limits<double>::max(), contrast = 0;
    for_windows(pictures, region, [&](const Window& sums, std::size_t y0, std::size_t x0) {
        const double b = sums.b / n, variation = (sums.bb / n - b * b) / std::max(b * b, 1e-30);
        if (b < 0.5 * pictures.peak || variation >= flattest) return;
        flattest = variation;
        double sum = 0, squares = 0;
        for (std::size_t y = y0; y < y0 + side; ++y)
            for (std::size_t x = x0; x < x0 + side; ++x) {
                const double value = pictures.intensity(y, x);
                sum += value, squares += value * value;
            }
        contrast = sum > 0 ? std::sqrt(std::max(0.0, n * squares / (sum * sum) - 1)) : 0;
    });
    return contrast;
}

// Share of the light of spectra that goes to a light field's directions.
double share_in(const PupilRange& range, std::span<const Array<Complex, 2>> spectra) {
    struct Light {
        double within = 0, all = 0;
        void operator+=(const Light& other) { within += other.within, all += other.all; }
    };
    Light light;
    for (const auto& spectrum : spectra) {
        const auto height = static_cast<double>(spectrum.extent(0)), width = static_cast<double>(spectrum.extent(1));
        light += sum_of_lines(spectrum.extent(0), [&](std::size_t y) {
            Light line;
            const double fy = std::remainder(static_cast<double>(y) / height - range.directions.y, 1.0);
            for (std::size_t x = 0; x < spectrum.extent(1); ++x) {
                const double fx = std::remainder(static_cast<double>(x) / width - range.directions.x, 1.0);
                const double power = std::norm(spectrum(y, x));
                line.all += power;
                if (std::abs(fx) <= range.half_x && std::abs(fy) <= range.half_y) line.within += power;
            }
            return line;
        });
    }
    return light.all > 0 ? light.within / light.all : 0;
}

bool is_in_middle(const Pupil& pupil, const PupilRange& range) {
    return std::hypot((pupil.aperture.x - range.directions.x) / range.half_x,
                      (pupil.aperture.y - range.directions.y) / range.half_y) < 1.0 / 3;
}

// What the photographs through one pupil contribute, before the brightness factor of all pupils is known.
struct Sample {
    PhotographSums sums;
    std::vector<Window> windows;
    double peak = 0, contrast = 0;
    bool is_middle = false;

    double psnr(double factor) const {
        const double error = factor * factor * sums.aa - 2 * factor * sums.ab + sums.bb;
        return 10 * std::log10(static_cast<double>(sums.samples) * peak * peak / error);
    }
    double ssim(double factor) const {
        double sum = 0;
        for (const Window& window : windows) sum += similarity(window, factor, peak);
        return windows.empty() ? 0 : sum / static_cast<double>(windows.size());
    }
};

Sample sample_of(const PupilCamera& camera, std::span<const Array<Complex, 2>> spectra, const Pupil& pupil) {
    const Pictures pictures = photograph(camera, spectra, pupil);
    const Region region = camera.interior(pupil);
    Sample sample;
    sample.sums = camera.sums(pupil, pictures.intensity, pictures.amplitudes);
    for_windows(pictures, region,
                [&](const Window& window, std::size_t, std::size_t) { sample.windows.push_back(window); });
    sample.peak = pictures.peak;
    sample.contrast = contrast_of(pictures, region);
    sample.is_middle = is_in_middle(pupil, camera.range());
    return sample;
}

}  // namespace

namespace patterns {

PupilQuality pupil_quality(std::span<const Pattern> patterns, const PupilCamera& camera, const PatternOptions& options,
                           const Progress& progress) {
    std::vector<Array<Complex, 2>> spectra;
    const math::Fft2 fft(options.modulator.height, options.modulator.width);
    for (const Pattern& pattern : patterns) {
        spectra.push_back(transmission(pattern, options.encoding, options.phase_code));
        fft.forward(spectra.back());
    }
    PhotographSums all;
    std::vector<Sample> samples;
    for (std::uint32_t i = 0; i < pupils; ++i) {
        progress.report(static_cast<double>(i) / pupils);
        samples.push_back(sample_of(camera, spectra, camera.range().draw(test_sequence, i)));
        all += samples.back().sums;
    }
    PupilQuality quality{.lowest_psnr = std::numeric_limits<double>::max()};
    std::size_t in_middle = 0;
    const double factor = all.factor();
    for (const Sample& sample : samples) {
        const double psnr = sample.psnr(factor);
        quality.psnr += psnr / pupils;
        quality.lowest_psnr = std::min(quality.lowest_psnr, psnr);
        in_middle += sample.is_middle ? 1 : 0;
        (sample.is_middle ? quality.psnr_middle : quality.psnr_outside) += psnr;
        quality.ssim += sample.ssim(factor) / pupils;
        quality.contrast += sample.contrast / pupils;
    }
    if (in_middle > 0) quality.psnr_middle /= static_cast<double>(in_middle);
    if (in_middle < pupils) quality.psnr_outside /= static_cast<double>(pupils - in_middle);
    quality.efficiency = share_in(camera.range(), spectra);
    // Light of the power 1 on a pixel, spread evenly over all frequencies, has the radiance (Δ/λ)².
    quality.power = all.aa > 0 ? all.bb / all.aa * camera.per_cycle() * camera.per_cycle() : 0;
    return quality;
}

}  // namespace patterns

PupilQuality pupil_quality(std::span<const Pattern> patterns, const LightFieldSource& light_field, std::size_t channel,
                           double wavelength, const PatternOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    return pupil_quality(patterns, PupilCamera(light_field, channel, wavelength, options.modulator), options, progress);
}

}  // namespace hogel
