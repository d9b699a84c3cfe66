// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/surface_cells.h"

#include <cmath>

#include "hogel/core/random.h"

namespace hogel::stereogram {
namespace {

constexpr double steps_of_depth = 16;

// Returns n · ratio modulo 1: coordinate n of a sequence that covers an interval evenly.
double fraction(double n, double ratio) { return n * ratio - std::floor(n * ratio); }

std::uint32_t word(double value) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(value)); }

}  // namespace

SurfaceCells::SurfaceCells(double step_u, double step_v, std::uint64_t seed, std::size_t channel)
    : step_u_(step_u), step_v_(step_v), seed_(seed), channel_(channel) {}

SurfaceCell SurfaceCells::find(double x, double y, double depth, std::size_t look) const {
    const double level = std::round(steps_of_depth * std::log(std::abs(depth) / shallowest));
    const double distance = shallowest * std::exp(level / steps_of_depth);
    const double width = distance * step_u_, height = distance * step_v_;
    // Roberts' sequence in two dimensions: powers of the reciprocal of the real root of r³ = r + 1.
    const double number = static_cast<double>(look + 1) + static_cast<double>(seed_ % 65536) * 17;
    const double right = fraction(number, 0.7548776662466927), up = fraction(number, 0.5698402909980532);
    const double column = std::floor(x / width - right), row = std::floor(y / height - up);
    const double relative_width = distance / std::abs(depth),
                 one_axis = relative_width > 1 ? 3 - 2 / relative_width : 1, crowding = one_axis * one_axis;
    const bool in_front = depth < 0;
    const auto bits = core::philox({word(column), word(row), word(2 * level + (in_front ? 1 : 0)),
                                    static_cast<std::uint32_t>(look * 4 + channel_)},
                                   {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
    return {(column + 0.5 + right) * width, (row + 0.5 + up) * height, depth, bits[0] / 4294967296.0, crowding};
}

}  // namespace hogel::stereogram
