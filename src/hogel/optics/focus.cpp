// SPDX-License-Identifier: Apache-2.0
#include "hogel/focus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/math/fft.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;
using Contrasts = std::array<double, FocusSearch::cells.size()>;
constexpr std::size_t scales = FocusSearch::cells.size();
constexpr double pi = std::numbers::pi;

// The middle of a field as a sum of plane waves, which can be looked at on any parallel plane.
class Planes {
  public:
    Planes(const FieldSource& field, std::size_t max_side)
        : grid_(field.grid()),
          width_(std::min(grid_.plane.width, max_side)),
          height_(std::min(grid_.plane.height, max_side)),
          fft_(height_, width_),
          spectrum_({height_, width_}) {
        const Grid& plane = grid_.plane;
        field.read({(plane.width - width_) / 2, (plane.height - height_) / 2, width_, height_}, 0, spectrum_);
        fft_.forward(spectrum_);
    }

    // The contrasts of the intensity at a depth: waves go back to it. Frequencies of either sign turn alike.
    Contrasts at(double depth) const {
        Array<Complex, 2> wave(spectrum_.shape());
        const double inverse = 1 / grid_.wavelength;
        for (std::size_t y = 0; y <= height_ / 2; ++y) {
            const double fy = static_cast<double>(y) / static_cast<double>(height_) / grid_.plane.pitch_y;
            const std::size_t other_y = (height_ - y) % height_;
            for (std::size_t x = 0; x <= width_ / 2; ++x) {
                const double fx = static_cast<double>(x) / static_cast<double>(width_) / grid_.plane.pitch_x;
                const double square = fx * fx + fy * fy;
                if (square >= inverse * inverse) continue;
                // √(1/λ² − f²) − 1/λ without the difference of large numbers
                const double along = -square / (std::sqrt(inverse * inverse - square) + inverse);
                const Complex turn(std::polar(1.0, -2 * pi * std::remainder(along * depth, 1.0)));
                const std::size_t other_x = (width_ - x) % width_;
                wave(y, x) = spectrum_(y, x) * turn;
                wave(y, other_x) = spectrum_(y, other_x) * turn;
                wave(other_y, x) = spectrum_(other_y, x) * turn;
                wave(other_y, other_x) = spectrum_(other_y, other_x) * turn;
            }
        }
        fft_.backward(wave);
        return contrasts_of(wave);
    }

  private:
    Contrasts contrasts_of(const Array<Complex, 2>& wave) const {
        Contrasts contrasts{};
        std::size_t height = height_, width = width_;
        std::vector<double> light(height * width);
        for (std::size_t i = 0; i < light.size(); ++i) light[i] = std::norm(wave.data()[i]);
        for (std::size_t s = 0; s < scales; ++s) {
            if (s > 0) halve(light, height, width);
            if (light.empty()) break;
            double sum = 0, squares = 0;
            for (const double value : light) sum += value, squares += value * value;
            const auto n = static_cast<double>(light.size());
            contrasts[s] = sum > 0 ? std::max(0.0, squares * n / (sum * sum) - 1) : 0;
        }
        return contrasts;
    }

    // Means over squares of two by two.
    static void halve(std::vector<double>& light, std::size_t& height, std::size_t& width) {
        const std::size_t down = height / 2, across = width / 2;
        std::vector<double> means(down * across);
        for (std::size_t y = 0; y < down; ++y)
            for (std::size_t x = 0; x < across; ++x) {
                const double* at = &light[2 * y * width + 2 * x];
                means[y * across + x] = (at[0] + at[1] + at[width] + at[width + 1]) / 4;
            }
        light = std::move(means);
        height = down;
        width = across;
    }

    FieldGrid grid_;
    std::size_t width_, height_;
    math::Fft2 fft_;
    Array<Complex, 2> spectrum_;
};

// An extremum of one scale's curve of logarithms.
struct Extremum {
    std::size_t index = 0, scale = 0;
    bool maximum = true;
    double prominence = 0;
    std::size_t base = 0;             // the nearer of the two extrema of the other kind beside it
    std::size_t first = 0, last = 0;  // where the curve is near the extremum
    double slope = 0;                 // prominence for each depth of focus
};

// How far a curve goes up and down from sample to sample: by no more than this nine samples of ten are off from their
// neighbours' mean. The tenth may be a plane in focus.
double noise_of(const std::vector<double>& curve) {
    std::vector<double> off;
    for (std::size_t i = 1; i + 1 < curve.size(); ++i)
        off.push_back(std::abs(curve[i] - (curve[i - 1] + curve[i + 1]) / 2));
    const std::size_t most = off.size() * 9 / 10;
    std::ranges::nth_element(off, off.begin() + static_cast<std::ptrdiff_t>(most));
    return off[most];
}

// The maxima of a curve that is not at its ends, with how far one must descend from each to reach a higher one.
std::vector<Extremum> maxima_of(const std::vector<double>& curve) {
    std::vector<Extremum> found;
    const std::size_t n = curve.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
        if (!(curve[i] > curve[i - 1] && curve[i] >= curve[i + 1])) continue;
        std::size_t left = i, right = i;
        for (std::size_t j = i; j-- > 0 && curve[j] <= curve[i];)
            if (curve[j] < curve[left]) left = j;
        for (std::size_t j = i + 1; j < n && curve[j] <= curve[i]; ++j)
            if (curve[j] < curve[right]) right = j;
        Extremum extremum{i};
        extremum.base = curve[left] > curve[right] ? left : right;
        extremum.prominence = curve[i] - curve[extremum.base];
        // Halfway down, or where high peaks have fallen to 0.7.
        const double near = curve[i] - std::min(extremum.prominence / 2, 0.35);
        for (extremum.first = i; extremum.first > 0 && curve[extremum.first - 1] >= near;) --extremum.first;
        for (extremum.last = i; extremum.last + 1 < n && curve[extremum.last + 1] >= near;) ++extremum.last;
        found.push_back(extremum);
    }
    return found;
}

// Extrema of both kinds at all scales that stand out of the noise and are no wider than defocus makes them: a square
// of n samples is blurred away in about n depths of focus, more where the light has not all frequencies of the samples.
std::vector<Extremum> extrema_of(const std::vector<Contrasts>& contrasts, double depths_of_focus) {
    // Measured on the fields of docs/holograms-from-elsewhere.md (docs/decisions/0085-planes-in-focus.md).
    constexpr double least = 0.08, above_noise = 4, widest = 8;
    std::vector<Extremum> found;
    for (std::size_t s = 0; s < scales; ++s) {
        std::vector<double> curve;
        for (const Contrasts& contrast : contrasts) curve.push_back(std::log(contrast[s] + 1e-9));
        const double noise = noise_of(curve);
        for (const bool maximum : {true, false}) {
            for (Extremum extremum : maxima_of(curve)) {
                extremum.scale = s;
                extremum.maximum = maximum;
                const double width =
                    static_cast<double>(std::max<std::size_t>(extremum.last - extremum.first, 1)) * depths_of_focus / 2;
                extremum.slope = extremum.prominence / width;
                const bool wide = width > widest * static_cast<double>(FocusSearch::cells[s]);
                if (!wide && extremum.prominence > least && extremum.prominence > above_noise * noise)
                    found.push_back(extremum);
            }
            for (double& value : curve) value = -value;
        }
    }
    return found;
}

// Whether two extrema are of one plane: their surroundings overlap.
bool same_plane(const Extremum& a, const Extremum& b) { return a.first <= b.last && b.first <= a.last; }

// One extremum for each plane: of those that overlap the finest scale that shows the plane well, which locates it best.
std::vector<Extremum> merged(std::vector<Extremum> extrema) {
    std::ranges::stable_sort(extrema, std::greater(), &Extremum::slope);
    std::vector<Extremum> planes, best;
    for (const Extremum& extremum : extrema) {
        // The rise between two planes of lowest contrast, or beside one, is no plane.
        if (std::ranges::any_of(best, [&](const Extremum& b) {
                return b.maximum != extremum.maximum && extremum.base >= b.first && extremum.base <= b.last;
            }))
            continue;
        const auto same = std::ranges::find_if(best, [&](const Extremum& b) { return same_plane(b, extremum); });
        if (same == best.end()) {
            best.push_back(extremum);
            planes.push_back(extremum);
            continue;
        }
        Extremum& plane = planes[static_cast<std::size_t>(same - best.begin())];
        const bool inside = extremum.index >= same->first && extremum.index <= same->last;
        if (inside && extremum.scale < plane.scale && extremum.prominence > 0.25 * same->prominence) {
            const double slope = plane.slope;
            plane = extremum;
            plane.slope = slope;
        }
    }
    return planes;
}

// The middle of the extremum, by more depths around it: the mean depth weighted by what exceeds half the prominence.
double refined_depth(const Planes& planes, const std::vector<double>& depths, const Extremum& extremum,
                     const std::vector<Contrasts>& contrasts) {
    constexpr std::size_t samples = 25;
    const double low = depths[extremum.first == 0 ? 0 : extremum.first - 1],
                 high = depths[std::min(depths.size() - 1, extremum.last + 1)];
    std::vector<double> heights(samples);
    const auto height_of = [&](const Contrasts& contrast) {
        return (extremum.maximum ? 1 : -1) * std::log(contrast[extremum.scale] + 1e-9);
    };
    core::parallel_for(samples, [&](std::size_t i) {
        heights[i] = height_of(planes.at(low + (high - low) * static_cast<double>(i) / (samples - 1)));
    });
    const double top = std::max(*std::ranges::max_element(heights), height_of(contrasts[extremum.index]));
    const double base = std::max(heights.front(), heights.back());
    double weights = 0, sum = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double weight = std::max(0.0, heights[i] - (top + base) / 2);
        weights += weight;
        sum += weight * (low + (high - low) * static_cast<double>(i) / (samples - 1));
    }
    return weights > 0 ? sum / weights : depths[extremum.index];
}

std::vector<double> depths_of(const FieldGrid& grid, const FocusOptions& options, double depth_of_focus) {
    double from = options.from, to = options.to;
    if (!std::isfinite(from) || !std::isfinite(to))
        throw Error(ErrorCode::usage, "the depths to search are not finite");
    if (from > to) std::swap(from, to);
    if (from == to) {
        const Grid& plane = grid.plane;
        to = std::min(static_cast<double>(plane.width) * plane.pitch_x * plane.pitch_x,
                      static_cast<double>(plane.height) * plane.pitch_y * plane.pitch_y) /
             grid.wavelength;
        from = -to;
    }
    constexpr std::size_t least = 8, most = 1 << 16;
    const double wanted = std::ceil((to - from) / depth_of_focus) + 1;
    const std::size_t count = options.planes > 0
                                  ? options.planes
                                  : std::max<std::size_t>(33, static_cast<std::size_t>(std::min(wanted, 1e9)));
    if (count < least || count > most)
        throw Error(ErrorCode::usage, fmt::format("{} depths from {} to {} m were asked for; {} to {} are searched",
                                                  count, from, to, least, most));
    std::vector<double> depths(count);
    for (std::size_t i = 0; i < count; ++i)
        depths[i] = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    return depths;
}

}  // namespace

FocusSearch find_focus(const FieldSource& field, const FocusOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    const FieldGrid& grid = field.grid();
    validate(grid, ErrorCode::usage, "the field");
    FocusSearch search;
    const double pitch = std::min(grid.plane.pitch_x, grid.plane.pitch_y);
    // Directions beyond 90 degrees carry nothing: samples finer than half a wave resolve no more.
    const double finest = std::max(pitch, grid.wavelength / 2);
    search.depth_of_focus = 2 * finest * finest / grid.wavelength;
    search.depths = depths_of(grid, options, search.depth_of_focus);
    const Planes planes(field, std::max<std::size_t>(options.max_side, 16));
    search.contrasts.resize(search.depths.size());
    std::mutex mutex;
    std::size_t done = 0;
    core::parallel_for(search.depths.size(), [&](std::size_t i) {
        search.contrasts[i] = planes.at(search.depths[i]);
        const std::lock_guard lock(mutex);
        progress.report(0.95 * static_cast<double>(++done) / static_cast<double>(search.depths.size()));
    });
    const double step = (search.depths[1] - search.depths[0]) / search.depth_of_focus;
    // Planes that stand out much less steeply than the clearest one are ripple and shoulders of its defocus.
    constexpr double faintest = 0.3;
    double steepest = 0;
    for (const Extremum& extremum : merged(extrema_of(search.contrasts, step))) {
        const double depth = refined_depth(planes, search.depths, extremum, search.contrasts);
        // Nearly all holograms are more even than what they show.
        if (!extremum.maximum && std::abs(depth) <= 2 * search.depth_of_focus) continue;
        steepest = std::max(steepest, extremum.slope);
        if (extremum.slope < faintest * steepest) break;
        search.planes.push_back({depth, extremum.prominence, extremum.maximum, FocusSearch::cells[extremum.scale]});
    }
    progress.report(1);
    return search;
}

}  // namespace hogel
