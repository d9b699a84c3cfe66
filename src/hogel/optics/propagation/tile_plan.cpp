// SPDX-License-Identifier: Apache-2.0
// Computes the step and the range of the frequencies that propagate a field.
//
// Frequencies at steps of 1/W make the output periodic with period W. Light reaches the output on sideways paths within
// middle ± R, where 2R is the sum of the sizes of field and output. The propagation kernel is e^{iπu²/λz} for a path u:
// a direction determines the path to within a few Fresnel lengths L = √(λz). The frequencies are therefore multiplied
// by ½ erfc((|path − middle| − R − G/2)/s), and the period is W = 2R + G. The paths of a wanted direction and of its
// alias in the next period are G/2 or more from the middle of the fade. s = L/√π minimises the error, about
// e^{−(π/8)(G/L)²}: a convolution of the erfc with the kernel is an erfc of complex width. The number of frequencies, W
// times the kept band, is about (2R + 5.5 L)(2R + 9 L)/λz. It equals the number of samples for near planes, and a
// hundred for far planes.
//
// Oblique directions have a larger L, determined by the second derivative of z f_z, at most λz/cos³θ.
#include "hogel/optics/propagation/tile_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/optics/propagation/band_edge.h"
#include "hogel/optics/spectrum.h"
#include "hogel/units.h"

namespace hogel::optics::propagation {
namespace {

// In Fresnel lengths. The fade has an error of 7e-6; beyond its end 1e-5 of the amplitude is dropped.
constexpr double guard_lengths = 5.5, fade_lengths = 1.69;
// The largest fraction of the period for paths to an active edge of the band.
constexpr double max_edge_path = 0.85;
constexpr double infinite = std::numeric_limits<double>::infinity();

// Sets the Fresnel lengths for the most oblique direction that is kept. If grazing directions need more than four times
// the size of field and output, sets a minimum cosine instead.
void set_guards(TilePlan& plan) {
    AxisPlan &x = plan.x, &y = plan.y;
    const double z = std::abs(plan.distance), lambda = plan.wavelength;
    const double steepest = std::hypot(x.edge_frequency(), y.edge_frequency()) * lambda;
    const double band_cosine = std::sqrt(std::max(0.0, 1 - steepest * steepest));
    const double along_axis = std::sqrt(lambda * z);
    const double max_length = std::max(2 * along_axis, 4 * std::max(x.reach, y.reach) / guard_lengths);
    double length = along_axis;
    plan.min_cosine = 0;
    for (int i = 0; i < 40 && z > 0; ++i) {
        const double margin = (0.5 * guard_lengths + fade_lengths) * length;
        const double dx = std::abs(x.middle) + x.reach + margin, dy = std::abs(y.middle) + y.reach + margin;
        const double cosine = std::max(band_cosine, z / std::hypot(z, dx, dy));
        const double next = along_axis / std::pow(cosine, 1.5);
        const bool converged = next <= length * 1.001;
        length = std::max(length, next);
        if (length > max_length) {
            length = max_length;
            plan.min_cosine = std::pow(along_axis / length, 2.0 / 3);
            break;
        }
        if (converged) break;
    }
    for (AxisPlan* axis : {&x, &y}) {
        axis->fresnel = length;
        axis->guard = guard_lengths * length;
    }
}

// Returns the shortest and longest sideways path at this axis' band edge, over all frequencies of the other axis.
std::pair<double, double> edge_paths(const TilePlan& plan, const AxisPlan& axis, double other_frequency) {
    const double z = std::abs(plan.distance), f = axis.edge_frequency();
    const double squares = 1 / (plan.wavelength * plan.wavelength) - f * f;
    if (z == 0) return {0, 0};
    if (squares <= 0) return plan.evanescent ? std::pair(0.0, 0.0) : std::pair(infinite, infinite);
    const double rest = squares - other_frequency * other_frequency;
    return {rest <= 0 && plan.evanescent ? 0 : z * f / std::sqrt(squares),
            rest <= 0 ? infinite : z * f / std::sqrt(rest)};
}

// Returns the range of remaining paths at an edge whose directions have sideways paths between low and high.
AxisPlan::Edge edge_between(const AxisPlan& axis, double low, double high) {
    const double max_path = axis.reach + axis.end_of_fade();
    low = std::max(low, axis.middle - max_path);
    high = std::min(high, axis.middle + max_path);
    if (low > high) return {};
    return {true, axis.middle - axis.reach - high, axis.middle + axis.reach - low};
}

// Sets the period, and the paths of the edges in periods.
void set_period(const TilePlan& plan, AxisPlan& axis, double other_frequency) {
    const auto [near, far] = edge_paths(plan, axis, other_frequency);
    const bool backwards = plan.distance < 0;
    axis.upper = backwards ? edge_between(axis, -far, -near) : edge_between(axis, near, far);
    axis.lower = backwards ? edge_between(axis, near, far) : edge_between(axis, -far, -near);
    double min_period = std::max(2 * axis.reach + axis.guard, 64 * axis.field.step);
    for (const AxisPlan::Edge& edge : {axis.lower, axis.upper})
        if (edge.active)
            min_period = std::max({min_period, std::abs(edge.low) / max_edge_path, std::abs(edge.high) / max_edge_path,
                                   (edge.high - edge.low) / max_edge_path});
    const double samples = min_period / axis.field.step;
    if (!(samples < 1e12))
        throw Error(ErrorCode::usage, "output_pitch, output_samples, offset_x, offset_y",
                    fmt::format("an output {} from the field's middle and {} wide is too large to compute",
                                format_length(axis.middle),
                                format_length(static_cast<double>(axis.output.count) * axis.output.step)));
    // An even number of samples puts a frequency on each edge of the band.
    const std::size_t half = math::good_fft_size(static_cast<std::size_t>(std::ceil(0.5 * samples)));
    axis.period = 2 * static_cast<double>(half) * axis.field.step;
    for (AxisPlan::Edge* edge : {&axis.lower, &axis.upper}) {
        edge->low /= axis.period;
        edge->high /= axis.period;
    }
    axis.inward = axis.outward = 2 * half;
}

// Sets the frequencies of the band that are kept, and the transforms.
void set_frequencies(AxisPlan& axis, double low, double high) {
    const double half = 0.5 * axis.period / axis.field.step;
    constexpr auto margin = static_cast<double>(BandEdge::max_beyond);
    const double lowest = axis.lower.active ? -half - margin : -half,
                 highest = axis.upper.active ? half + margin : half;
    // One more frequency at each end, so that any band contains at least one.
    const double first = std::clamp(std::floor(low * axis.period) - 1, lowest, half);
    const double last = std::clamp(std::ceil(high * axis.period) + 1, -half, highest);
    const double begin = axis.lower.active && first <= -half + margin ? lowest : first;
    const double end = axis.upper.active && last >= half - margin ? highest : last;
    axis.frequencies = {begin / axis.period, 1 / axis.period, static_cast<std::size_t>(end - begin) + 1};
    const std::size_t n = axis.frequencies.count;
    const auto cheaper = [](std::size_t inputs, std::size_t outputs, std::size_t transform) {
        return LineTransform::operations(inputs, outputs, transform) <= LineTransform::operations(inputs, outputs, 0);
    };
    if (!cheaper(axis.field.count, n, axis.inward)) axis.inward = 0;
    if (axis.output.step != axis.field.step || !cheaper(n, axis.output.count, axis.outward)) axis.outward = 0;
}

AxisPlan axis_of(std::size_t field, double field_pitch, std::size_t output, double output_pitch, double middle) {
    const auto centred = [](double centre, std::size_t n, double pitch) {
        return Steps{centre + (0.5 - 0.5 * static_cast<double>(n)) * pitch, pitch, n};
    };
    AxisPlan axis;
    axis.field = centred(0, field, field_pitch);
    axis.output = centred(middle, output, output_pitch);
    axis.middle = middle;
    // Output samples are points; field samples are as wide as their pitch.
    axis.reach = 0.5 * (static_cast<double>(field) * field_pitch + static_cast<double>(output - 1) * output_pitch);
    return axis;
}

// Returns the part of a plan that does not depend on the frequencies.
TilePlan geometry_of(const FieldGrid& field, double distance, const Grid& output) {
    const Grid& plane = field.plane;
    TilePlan plan;
    plan.distance = distance;
    plan.wavelength = field.wavelength;
    plan.x = axis_of(plane.width, plane.pitch_x, output.width, output.pitch_x, output.center_x - plane.center_x);
    plan.y = axis_of(plane.height, plane.pitch_y, output.height, output.pitch_y, plane.center_y - output.center_y);
    // Evanescent waves of noise have decayed to 1e-4 of its amplitude at a distance of 500 pitches.
    constexpr double pitches = 500;
    plan.evanescent = std::hypot(plan.x.edge_frequency(), plan.y.edge_frequency()) * field.wavelength > 1 &&
                      distance >= 0 && distance < pitches * std::min(plane.pitch_x, plane.pitch_y);
    return plan;
}

// Returns the index of the first position not below `minimum`, or the number of positions.
std::size_t first_from(const Steps& positions, double minimum) {
    const double index = std::ceil((minimum - positions.first) / positions.step);
    return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(positions.count)));
}

// Returns the range [first, end) of output samples on this axis that light can reach.
std::pair<std::size_t, std::size_t> illuminated_samples(const TilePlan& plan, const AxisPlan& axis,
                                                        double other_frequency, const char* across) {
    const Steps& output = axis.output;
    const double widest = edge_paths(plan, axis, other_frequency).second;
    const double cone = 0.5 * static_cast<double>(axis.field.count) * axis.field.step + widest;
    const auto position = [&](std::size_t i) { return std::abs(output.first + static_cast<double>(i) * output.step); };
    // The nearest sample to the centre of the field is one of its two neighbours.
    const std::size_t next = std::min(first_from(output, 0), output.count - 1);
    const double nearest = std::min(position(next), position(next == 0 ? 0 : next - 1));
    if (!plan.evanescent && nearest > cone)
        throw Error(ErrorCode::usage, "output_pitch, output_samples, offset_x, offset_y",
                    fmt::format("no light reaches the output: samples {} apart diffract by at most {} {} over {}, and "
                                "the output begins {} from the field",
                                format_length(axis.field.step), format_length(widest), across,
                                format_length(std::abs(plan.distance)), format_length(nearest - (cone - widest))));
    if (plan.evanescent || plan.distance == 0) return {0, output.count};
    return {first_from(output, -3 * cone), first_from(output, 3 * cone)};
}

}  // namespace

double AxisPlan::end_of_fade() const { return 0.5 * guard + fade_lengths * fresnel; }

double AxisPlan::outermost() const { return reach + end_of_fade(); }

Region illuminated_region(const FieldGrid& field, double distance, const Grid& output) {
    const TilePlan plan = geometry_of(field, distance, output);
    const auto [x0, x1] = illuminated_samples(plan, plan.x, plan.y.edge_frequency(), "sideways");
    const auto [y0, y1] = illuminated_samples(plan, plan.y, plan.x.edge_frequency(), "up and down");
    return {x0, y0, x1 - x0, y1 - y0};
}

TilePlan plan_tile(const FieldGrid& field, double distance, const Grid& output) {
    TilePlan plan = geometry_of(field, distance, output);
    const double fx = plan.x.edge_frequency(), fy = plan.y.edge_frequency();
    set_guards(plan);
    set_period(plan, plan.x, fy);
    set_period(plan, plan.y, fx);
    Band band{-fx, fx, -fy, fy};
    if (distance != 0 && !plan.evanescent) {
        // Directions from the origin to the paths that are kept.
        Rectangle from{Grid()}, to{Grid()};
        to.left = plan.x.middle - plan.x.outermost();
        to.right = plan.x.middle + plan.x.outermost();
        to.bottom = plan.y.middle - plan.y.outermost();
        to.top = plan.y.middle + plan.y.outermost();
        band = band_between(from, to, std::abs(distance), field.wavelength);
        if (distance < 0) band = {-band.high_x, -band.low_x, -band.high_y, -band.low_y};
    }
    set_frequencies(plan.x, band.low_x, band.high_x);
    set_frequencies(plan.y, band.low_y, band.high_y);
    return plan;
}

double TilePlan::bytes() const {
    return static_cast<double>(std::max(y.field.count, y.output.count)) * static_cast<double>(x.frequencies.count) *
           sizeof(std::complex<float>);
}

double TilePlan::operations() const {
    const std::size_t nx = x.frequencies.count, ny = y.frequencies.count;
    const auto count = [](std::size_t n) { return static_cast<double>(n); };
    constexpr double phase = 30;  // operations per frequency
    return count(y.field.count) * LineTransform::operations(x.field.count, nx, x.inward) +
           count(nx) * (LineTransform::operations(y.field.count, ny, y.inward) + phase * count(ny) +
                        LineTransform::operations(ny, y.output.count, y.outward)) +
           count(y.output.count) * LineTransform::operations(nx, x.output.count, x.outward);
}

}  // namespace hogel::optics::propagation
