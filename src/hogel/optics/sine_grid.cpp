// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/sine_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/math/fft.h"

namespace hogel::optics {
namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void include(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
};

// The minimum rate of change of the sines over the plane, per metre.
double min_slope(const ViewGeometry& geometry, const Grid& plane) {
    // dn_x/dx = (1 - n_x²)/r, and likewise in y, is smallest at the corners farthest from the eye.
    double slope = std::numeric_limits<double>::infinity();
    for (double x : {plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2})
        for (double y : {plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2}) {
            const double sine = std::max(std::abs(geometry.sine_x(x, y)), std::abs(geometry.sine_y(x, y)));
            slope = std::min(slope, (1 - sine * sine) / geometry.distance(x, y));
        }
    return slope;
}

}  // namespace

double defocus_blur(const Camera& camera) {
    const Grid& picture = camera.picture;
    const double R = camera.eye.z, half_x = 0.5 * picture.size_x(), half_y = 0.5 * picture.size_y();
    double max_change = 0;
    for (double x : {picture.center_x - half_x, picture.center_x + half_x})
        for (double y : {picture.center_y - half_y, picture.center_y + half_y})
            max_change = std::max(max_change, std::abs(1 - 1 / focus_ratio(camera, x, y)));
    return camera.pupil / R * max_change;
}

SineGrid sine_grid(const narrow_band::NarrowBand& band, const Grid& plane, double blur) {
    // The directions of the whole plane, found along its edge.
    const ViewGeometry& geometry = band.geometry;
    Range x, y;
    for (int i = 0; i <= 64; ++i) {
        const double across = plane.center_x + plane.size_x() * (i / 64.0 - 0.5);
        const double along = plane.center_y + plane.size_y() * (i / 64.0 - 0.5);
        for (double end : {-0.5, 0.5}) {
            const double edge_x = plane.center_x + plane.size_x() * end, edge_y = plane.center_y + plane.size_y() * end;
            x.include(geometry.sine_x(across, edge_y));
            x.include(geometry.sine_x(edge_x, along));
            y.include(geometry.sine_y(across, edge_y));
            y.include(geometry.sine_y(edge_x, along));
        }
    }
    SineGrid grid;
    // Nowhere coarser than the band, which is sampled finely enough for the pupil and its intensity, so that nothing
    // aliases.
    grid.step = std::min(band.plane.pitch_x, band.plane.pitch_y) * min_slope(geometry, plane);
    // Light out of focus spreads by the blur, light in focus by some resolution cells of four samples each. The margin
    // keeps both from wrapping around to the other side.
    constexpr double margin = 64;
    const auto choose = [&](const Range& range, std::size_t& size, double& first) {
        const double wanted = (range.high - range.low + blur) / grid.step + margin;
        size = math::good_fft_size(static_cast<std::size_t>(std::ceil(wanted)));
        // Rows at distances of large powers of two map to the same cache sets, which is ten times slower.
        while (size % 128 == 0) size = math::good_fft_size(size + 1);
        first = 0.5 * (range.low + range.high) - 0.5 * static_cast<double>(size - 1) * grid.step;
    };
    choose(x, grid.size_x, grid.first_x);
    choose(y, grid.size_y, grid.first_y);
    return grid;
}

}  // namespace hogel::optics
