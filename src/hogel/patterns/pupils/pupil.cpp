// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/pupils/pupil.h"

#include <algorithm>
#include <array>

#include "hogel/core/random.h"

namespace hogel::patterns {
namespace {

// Smallest and largest radius of a pupil, in halves of the light field's directions.
constexpr double smallest = 1.0 / 6, largest = 3.0 / 8;

// Returns a number in [-1, 1).
double signed_unit(std::uint32_t bits) { return bits / 2147483648.0 - 1; }

}  // namespace

double PupilRange::radius(std::size_t size) const {
    const double share = smallest + (largest - smallest) * static_cast<double>(size) / (radii - 1);
    return share * std::min(half_x, half_y);
}

Pupil PupilRange::draw(std::uint32_t sequence, std::uint32_t index) const {
    const auto bits = core::philox({index, 0, 0, 0}, {sequence, 0x70757069u});
    Pupil pupil;
    pupil.size = bits[0] % radii;
    pupil.aperture.radius = radius(pupil.size);
    pupil.aperture.x = directions.x + signed_unit(bits[1]) * (half_x - pupil.aperture.radius);
    pupil.aperture.y = directions.y + signed_unit(bits[2]) * (half_y - pupil.aperture.radius);
    pupil.focus = nearest + (farthest - nearest) * (bits[3] / 4294967296.0);
    return pupil;
}

}  // namespace hogel::patterns
