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

// Returns the transmission of an edge that falls from 1 to 0 over one sample, at a point `inside` metres inside it.
double edge(double inside, double pitch) { return std::clamp(inside / pitch + 0.5, 0.0, 1.0); }

void require_opening(double diameter) {
    if (!(std::isfinite(diameter) && diameter > 0))
        throw Error(ErrorCode::usage,
                    fmt::format("the diameter of an aperture is {} m, but must be positive and finite", diameter));
}

}  // namespace

void circular_aperture(Wave& wave, double center_x, double center_y, double diameter, const PupilEdge& edge) {
    require_opening(diameter);
    multiply_everywhere(wave, [&](double x, double y) {
        return edge.transmission(0.5 * diameter - std::hypot(x - center_x, y - center_y));
    });
}

void weigh_alike(Wave& wave, double center_x, double center_y, Vec3 path) {
    const double centre_square = dot(path, path);
    multiply_everywhere(wave, [&](double x, double y) {
        const Vec3 to_sample = path - Vec3{x - center_x, y - center_y, 0};
        return dot(to_sample, to_sample) / centre_square;
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
        throw Error(ErrorCode::usage,
                    fmt::format("the focal length of a lens is {} m, but must be finite and not zero", focal_length));
    const double wavelength = wave.grid().wavelength;
    const double pitch = std::max(wave.grid().plane.pitch_x, wave.grid().plane.pitch_y);
    // At a distance a from the centre the phase has a frequency of a/(λl); samples represent half a cycle per pitch.
    const double max_diameter = wavelength * std::abs(focal_length) / pitch;
    if (diameter > max_diameter)
        throw Error(
            ErrorCode::usage,
            fmt::format(
                "a lens with a diameter of {} and a focal length of {} is undersampled at a pitch of {}; expected "
                "a diameter of at most {} or a pitch of at most {}",
                format_length(diameter), format_length(std::abs(focal_length)), format_length(pitch),
                format_length(max_diameter), format_length(pitch * max_diameter / diameter)));
    multiply_everywhere(wave, [&](double x, double y) -> std::complex<double> {
        const double square = (x - center_x) * (x - center_x) + (y - center_y) * (y - center_y);
        const double transmission = edge(0.5 * diameter - std::sqrt(square), pitch);
        if (transmission == 0) return 0;
        return transmission * unit_phasor(-square / (2 * focal_length * wavelength));
    });
}

}  // namespace hogel::optics
