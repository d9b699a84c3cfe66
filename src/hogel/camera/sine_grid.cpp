// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/sine_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/math/fft.h"
#include "hogel/optics/pupil_edge.h"

namespace hogel::camera {
namespace {

// Returns the minimum slope of the sines over the plane, per metre.
double min_slope(const ViewGeometry& geometry, const Grid& plane) {
    // dn_x/dx = (1 − n_x²)/r, and likewise in y, is smallest at the corners farthest from the viewpoint.
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

SineRanges sines_of(const ViewGeometry& geometry, const Grid& plane) {
    // The extremes lie on the edge of the plane.
    constexpr double infinite = std::numeric_limits<double>::infinity();
    SineRanges sines{{infinite, -infinite}, {infinite, -infinite}};
    const auto include = [&](double x, double y) {
        const double nx = geometry.sine_x(x, y), ny = geometry.sine_y(x, y);
        sines.x = {std::min(sines.x.low, nx), std::max(sines.x.high, nx)};
        sines.y = {std::min(sines.y.low, ny), std::max(sines.y.high, ny)};
    };
    for (int i = 0; i <= 64; ++i)
        for (double end : {-0.5, 0.5}) {
            include(plane.center_x + plane.size_x() * (i / 64.0 - 0.5), plane.center_y + plane.size_y() * end);
            include(plane.center_x + plane.size_x() * end, plane.center_y + plane.size_y() * (i / 64.0 - 0.5));
        }
    return sines;
}

Rectangle film_area(const Grid& hologram, const Rectangle& pictures, const Rectangle& active) {
    Rectangle area(hologram);
    if (!pictures.meets(active)) return area;
    // Pictures of the hologram alone have its edges within rounding.
    const double tolerance = 1e-9 * std::max(hologram.size_x(), hologram.size_y());
    const auto extend = [&](double& low, double& high, double first, double last) {
        if (first < low - tolerance) low = first;
        if (last > high + tolerance) high = last;
    };
    extend(area.left, area.right, std::max(pictures.left, active.left), std::min(pictures.right, active.right));
    extend(area.bottom, area.top, std::max(pictures.bottom, active.bottom), std::min(pictures.top, active.top));
    return area;
}

Grid as_grid(const Rectangle& rectangle) {
    return {1,
            1,
            rectangle.right - rectangle.left,
            rectangle.top - rectangle.bottom,
            0.5 * (rectangle.left + rectangle.right),
            0.5 * (rectangle.bottom + rectangle.top)};
}

SineGrid sine_grid(const narrow_band::BandGrid& band, const Grid& plane, const Rectangle& shown, double pupil,
                   double blur) {
    SineGrid grid;
    const SineRanges sines = sines_of(band.geometry, plane);
    grid.x = grid.shown_x = sines.x;
    grid.y = grid.shown_y = sines.y;
    if (const Rectangle hologram(plane); shown.left < hologram.left || shown.right > hologram.right ||
                                         shown.bottom < hologram.bottom || shown.top > hologram.top) {
        const SineRanges shown_sines = sines_of(band.geometry, as_grid(shown));
        grid.shown_x = {std::min(shown_sines.x.low, grid.x.low), std::max(shown_sines.x.high, grid.x.high)};
        grid.shown_y = {std::min(shown_sines.y.low, grid.y.low), std::max(shown_sines.y.high, grid.y.high)};
    }
    // Nowhere coarser than the band, so that nothing aliases.
    grid.step = std::min(band.plane.pitch_x, band.plane.pitch_y) * min_slope(band.geometry, plane);
    const optics::SpreadWindow window(grid.shown_x.span(), grid.shown_y.span(), blur,
                                      band.geometry.wavelength() / pupil);
    const auto choose = [&](const SineGrid::Range& hologram, const SineGrid::Range& range, std::size_t& size,
                            double& first) {
        const double period =
            std::max(range.span(), SineGrid::farthest(hologram, range) + window.stop + 0.5 * blur) / grid.step;
        size = math::good_fft_size(static_cast<std::size_t>(std::ceil(period)) + 1);
        // Strides of large powers of two map rows to the same cache sets, which is ten times slower.
        while (size % 128 == 0) size = math::good_fft_size(size + 1);
        first = 0.5 * (range.low + range.high) - 0.5 * static_cast<double>(size - 1) * grid.step;
    };
    choose(grid.x, grid.shown_x, grid.size_x, grid.first_x);
    choose(grid.y, grid.shown_y, grid.size_y, grid.first_y);
    return grid;
}

}  // namespace hogel::camera
