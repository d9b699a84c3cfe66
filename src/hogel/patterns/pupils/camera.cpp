// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/pupils/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/error.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {

PupilCamera::PupilCamera(const LightFieldSource& light_field, std::size_t channel, double wavelength,
                         const Modulator& modulator)
    : rays_(light_field, channel, wavelength, modulator.pitch), wavelength_(wavelength), pixel_pitch_(modulator.pitch) {
    if (std::abs(range().directions.x) + range().half_x > 0.5 + 1e-6 ||
        std::abs(range().directions.y) + range().half_y > 0.5 + 1e-6)
        throw Error(ErrorCode::usage, "pixel_pitch",
                    fmt::format("pixels of {} do not diffract {} to all directions of the light field",
                                format_length(modulator.pitch), format_length(wavelength)));
    for (std::size_t size = 0; size < PupilRange::radii; ++size) films_.emplace_back(modulator, range().radius(size));
}

void PupilCamera::photograph_rays(const Pupil& pupil, Array<float, 2>& amplitudes) const {
    rays_.photograph(pupil, film(pupil), amplitudes);
    work::parallel_for(amplitudes.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < amplitudes.extent(1); ++x)
            amplitudes(y, x) = std::sqrt(std::max(0.0f, amplitudes(y, x)));
    });
}

void PupilCamera::photograph_waves(std::span<const Array<std::complex<float>, 2>> spectra, const Pupil& pupil,
                                   std::vector<Array<std::complex<float>, 2>>& fields,
                                   Array<float, 2>& intensity) const {
    for (std::size_t f = 0; f < spectra.size(); ++f) film(pupil).photograph(spectra[f], pupil, wavelength_, fields[f]);
    const float share = 1.0f / static_cast<float>(spectra.size());
    work::parallel_for(intensity.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < intensity.extent(1); ++x) {
            float sum = 0;
            for (const auto& field : fields) sum += std::norm(field(y, x));
            intensity(y, x) = share * sum;
        }
    });
}

Region PupilCamera::interior(const Pupil& pupil) const {
    const PupilFilm& picture = film(pupil);
    const double depth = std::abs(pupil.focus);
    const auto border = [&](double frequency, double pitch, std::size_t samples) {
        const double steepest = std::min(0.99, (std::abs(frequency) + pupil.aperture.radius) * per_cycle());
        const double width = depth * steepest / std::sqrt(1 - steepest * steepest);
        return std::min(static_cast<std::size_t>(std::ceil(width / pitch)), (samples - 1) / 2);
    };
    const std::size_t left = border(pupil.aperture.x, picture.pitch_x(), picture.columns()),
                      top = border(pupil.aperture.y, picture.pitch_y(), picture.rows());
    return {left, top, picture.columns() - 2 * left, picture.rows() - 2 * top};
}

PhotographSums PupilCamera::sums(const Pupil& pupil, View<const float, 2> intensity,
                                 View<const float, 2> amplitudes) const {
    const Region region = interior(pupil);
    return sum_of_lines(region.height, [&](std::size_t row) {
        PhotographSums line;
        line.samples = region.width;
        for (std::size_t x = region.x0; x < region.x0 + region.width; ++x) {
            const double a2 = intensity(region.y0 + row, x), b = amplitudes(region.y0 + row, x);
            line.ab += std::sqrt(a2) * b;
            line.aa += a2;
            line.bb += b * b;
        }
        return line;
    });
}

}  // namespace hogel::patterns
