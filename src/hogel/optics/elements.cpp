// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/optics/phase_walk.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::optics {
namespace {

// Multiplies every sample by factor(x, y).
template <class Factor>
void multiply_everywhere(Wave& wave, const Factor& factor) {
    const Grid& plane = wave.grid().plane;
    work::parallel_for(wave.rows.count, [&](std::size_t row) {
        const double y = plane.y(static_cast<double>(wave.rows.first + row));
        std::complex<float>* samples = &wave.samples.view()(row, 0);
        for (std::size_t column = 0; column < plane.width; ++column) {
            const std::complex<double> value(samples[column]);
            samples[column] = std::complex<float>(
                times(value, std::complex<double>(factor(plane.x(static_cast<double>(column)), y))));
        }
    });
}

// The transmission of an edge that falls from 1 to 0 over one sample, at a point `inside` metres inside of it.
double edge(double inside, double pitch) { return std::clamp(inside / pitch + 0.5, 0.0, 1.0); }

void require_opening(double diameter) {
    if (!(std::isfinite(diameter) && diameter > 0))
        throw Error(ErrorCode::usage, fmt::format("an opening of {} m: it must be positive and finite", diameter));
}

}  // namespace

void circular_aperture(Wave& wave, double center_x, double center_y, double diameter, const PupilEdge& edge) {
    require_opening(diameter);
    multiply_everywhere(wave, [&](double x, double y) {
        return edge.transmission(0.5 * diameter - std::hypot(x - center_x, y - center_y));
    });
}

void weigh_alike(Wave& wave, double center_x, double center_y, Vec3 path) {
    const double middle = dot(path, path);
    multiply_everywhere(wave, [&](double x, double y) {
        const Vec3 way = path - Vec3{x - center_x, y - center_y, 0};
        return dot(way, way) / middle;
    });
}

void rectangular_aperture(Wave& wave, const Rectangle& opening) {
    const Grid& plane = wave.grid().plane;
    multiply_everywhere(wave, [&](double x, double y) {
        return edge(std::min(x - opening.left, opening.right - x), plane.pitch_x) *
               edge(std::min(y - opening.bottom, opening.top - y), plane.pitch_y);
    });
}

void thin_lens(Wave& wave, double center_x, double center_y, double diameter, double focal_length) {
    require_opening(diameter);
    if (!std::isfinite(focal_length) || focal_length == 0)
        throw Error(ErrorCode::usage, fmt::format("a lens with a focal length of {} m", focal_length));
    const double wavelength = wave.grid().wavelength;
    const double pitch = std::max(wave.grid().plane.pitch_x, wave.grid().plane.pitch_y);
    // At a distance a from the centre the phase has a frequency of a/(λl) cycles per metre; samples can represent half
    // a cycle per pitch.
    const double widest = wavelength * std::abs(focal_length) / pitch;
    if (diameter > widest)
        throw Error(
            ErrorCode::usage,
            fmt::format("a lens of {} with a focal length of {} is too steep for samples {} apart; a diameter of "
                        "{} or samples {} apart would do",
                        format_length(diameter), format_length(std::abs(focal_length)), format_length(pitch),
                        format_length(widest), format_length(pitch * widest / diameter)));
    multiply_everywhere(wave, [&](double x, double y) -> std::complex<double> {
        const double square = (x - center_x) * (x - center_x) + (y - center_y) * (y - center_y);
        const double passes = edge(0.5 * diameter - std::sqrt(square), pitch);
        if (passes == 0) return 0;
        return passes * unit_phasor(-square / (2 * focal_length * wavelength));
    });
}

}  // namespace hogel::optics
