// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "hogel/camera.h"
#include "hogel/camera/film/lens_stretch.h"
#include "hogel/camera/sine_grid.h"
#include "hogel/optics/pupil_edge.h"

namespace hogel::camera::film {

/// Returns the cosine of the direction with these sines to the axis of the film. Corners of a film may have sines of no
/// direction: there it is a tiny number.
inline double cosine_of(double sine_x, double sine_y) {
    return std::sqrt(std::max(1 - sine_x * sine_x - sine_y * sine_y, 1e-12));
}

/// Returns the path of light to the point q = c + δ of the pupil, minus the path to its centre c and the term linear in
/// δ: |x − q| − |x − c| + n·δ, exactly. The point x is in direction sine (n_x, n_y), `distance_z` in front of the lens.
inline double path(double sine_x, double sine_y, double distance_z, double delta_x, double delta_y) {
    const double r = distance_z / cosine_of(sine_x, sine_y);
    const double along = sine_x * delta_x + sine_y * delta_y, square = delta_x * delta_x + delta_y * delta_y;
    // |rn − δ| − r without cancellation.
    const double change = square - 2 * r * along;
    return change / (std::sqrt(r * r + change) + r) + along;
}

/// Returns the radius of the pupil's disc in its plane of frequencies. Light in direction n that enters the pupil at δ
/// has a frequency that differs from δ/λ by at most 3δ²/4Rλ, for viewpoints up to 55° off the axis.
inline double frequency_radius(double pupil, double distance) { return 0.5 * pupil * (1 + 0.75 * pupil / distance); }

/// Returns the distance in the pupil's plane, metres, between the frequencies of a transform over a range of sines.
inline double pupil_step(double wavelength, double period) { return wavelength / period; }

inline optics::SpreadWindow spread_window(const SineGrid& sines, double wavelength, double pupil, double blur) {
    optics::SpreadWindow window(sines.shown_x.span(), sines.shown_y.span(), blur, wavelength / pupil);
    window.fit(sines.room() - 0.5 * blur);
    return window;
}

/// A camera's lens at the frequencies of the transform. Around the direction n, light that enters the pupil at δ has
/// the frequency (δ − ∇_n Q)/λ in the sines, with Q the path without the term linear in δ. So the disc is slightly
/// distorted in the plane of frequencies, more so for oblique light.
///
/// The defocus phase depends slowly on the direction. The film is divided among nodes with one phase each. There are
/// enough nodes that the phase varies by at most half a radian within one. For a tilted plane in focus, the phase
/// varies from side to side: by a fifth of a radian from node to node, and the outermost nodes are at the sides.
class FilmLens {
  public:
    FilmLens(const SineGrid& sines, double wavelength, const Camera& camera)
        : sines_(sines),
          wavelength_(wavelength),
          camera_(camera),
          tilted_(camera.focus_slope_x != 0 || camera.focus_slope_y != 0),
          radius_(0.5 * camera.pupil),
          step_x_(pupil_step(wavelength, sines.period_x())),
          step_y_(pupil_step(wavelength, sines.period_y())),
          window_(spread_window(sines, wavelength, camera.pupil, defocus_blur(camera))),
          edge_(window_, wavelength) {
        nodes_x = nodes_for(sines.shown_x.span(), 0);
        nodes_y = nodes_for(0, sines.shown_y.span());
    }

    std::size_t nodes_x = 1, nodes_y = 1;

    double node_x(std::size_t i) const {
        return sines_.shown_x.low + sines_.shown_x.span() * node_fraction(i, nodes_x);
    }
    double node_y(std::size_t j) const {
        return sines_.shown_y.low + sines_.shown_y.span() * node_fraction(j, nodes_y);
    }

    // Returns the position among the nodes, counted from the first, of a fraction of the range of sines, 0 to 1.
    double node_position(double fraction, std::size_t nodes) const {
        const auto n = static_cast<double>(nodes);
        return std::clamp(tilted_ ? fraction * (n - 1) : fraction * n - 0.5, 0.0, n - 1);
    }

    // Return the largest offset from the middle of the pupil that transmits light, in steps.
    std::ptrdiff_t reach_x() const { return reach(step_x_, sines_.size_x); }
    std::ptrdiff_t reach_y() const { return reach(step_y_, sines_.size_y); }

    // Returns the area, m², that divides intensities: that of the disc. Where the window is narrower than the hologram,
    // the light in it makes up for the omitted light.
    double area() const {
        const double lost =
            optics::light_left_out(window_, sines_.x.span(), sines_.y.span(), wavelength_ / camera_.pupil);
        return std::numbers::pi * radius_ * radius_ * (1 - lost);
    }

    // Computes sixteen rows of the pupil from `first` on, for light from the direction (n_x, n_y), at the columns
    // −reach … reach: [column][part][row], zero outside the disc.
    void rows(double nx, double ny, std::ptrdiff_t first, std::ptrdiff_t reach, float* out) const {
        const Direction direction(nx, ny);
        const double scale = 1 / (static_cast<double>(sines_.size_x) * static_cast<double>(sines_.size_y));
        const double max_radius = frequency_radius(camera_.pupil, camera_.eye.z) + edge_.reach(),
                     in_focus = ratio(nx, ny);
        LensStretch stretch;
        stretch.inner = std::max(0.0, radius_ - edge_.reach());
        // Along a row everything is smooth: the squared distance from the middle of the pupil, the weight of the
        // transmission and the phase are parabolas over a stretch of at most 32 steps and a hundredth of the distance.
        const auto max_columns = static_cast<std::size_t>(std::clamp(0.01 * camera_.eye.z / step_x_, 2.0, 32.0));
        const auto columns = static_cast<std::size_t>(2 * reach + 1);
        for (std::size_t begin = 0; begin < columns; begin += max_columns) {
            stretch.columns = std::min(max_columns, columns - begin);
            bool any_inside = false;
            for (std::size_t row = 0; row < optics::block_lines; ++row) {
                const double dy = step_y_ * static_cast<double>(first + static_cast<std::ptrdiff_t>(row));
                double squares[3], weights[3], cycles[3];
                for (std::size_t i = 0; i < 3; ++i) {
                    const double step = static_cast<double>(begin) + 0.5 * static_cast<double>(max_columns * i);
                    const double dx = step_x_ * (step - static_cast<double>(reach));
                    const PupilPoint point = pupil_point(direction, dx, dy);
                    squares[i] = point.x * point.x + point.y * point.y;
                    // The amplitude transmission within the disc is (cos θ_n/cos θ_m)², which combines the density of
                    // frequencies there and the intensity of light from a nearer point.
                    weights[i] = scale * direction.cosine * direction.cosine / (point.cosine * point.cosine);
                    cycles[i] = defocus(nx, ny, in_focus, point.x, point.y);
                    any_inside = any_inside || dx * dx + dy * dy <= max_radius * max_radius;
                }
                stretch.set(row, squares, weights, cycles, static_cast<double>(max_columns));
            }
            float* const destination = out + 2 * optics::block_lines * begin;
            if (any_inside)
                lens_stretch(stretch, edge_, radius_, destination);
            else
                std::fill_n(destination, 2 * optics::block_lines * stretch.columns, 0.0f);
        }
    }

  private:
    static constexpr double max_nodes = 33, max_tilted_nodes = 83;

    struct Direction {
        Direction(double nx, double ny) : x(nx), y(ny), cosine(cosine_of(nx, ny)) {}
        double x, y, cosine;
    };

    struct PupilPoint {
        double x, y;    // in the pupil
        double cosine;  // cosine of the light's direction there
    };

    // Returns the point of the pupil that light around direction n with the frequency (fx/λ, fy/λ) in the sines enters.
    // Seen from there, the point of the hologram in direction n is exactly in direction m = n − (f − n (n·f)) cos θ/R.
    PupilPoint pupil_point(const Direction& n, double fx, double fy) const {
        const double R = camera_.eye.z, along = n.x * fx + n.y * fy, step = n.cosine / R;
        const double mx = n.x - step * (fx - n.x * along), my = n.y - step * (fy - n.y * along);
        const double cosine = cosine_of(mx, my);
        return {R * (n.x / n.cosine - mx / cosine), R * (n.y / n.cosine - my / cosine), cosine};
    }

    double node_fraction(std::size_t i, std::size_t nodes) const {
        const auto index = static_cast<double>(i), n = static_cast<double>(nodes);
        return tilted_ && nodes > 1 ? index / (n - 1) : (index + 0.5) / n;
    }

    std::ptrdiff_t reach(double step, std::size_t size) const {
        const double max_radius = frequency_radius(camera_.pupil, camera_.eye.z) + edge_.reach();
        return std::min(static_cast<std::ptrdiff_t>(max_radius / step) + 1, static_cast<std::ptrdiff_t>(size - 1) / 2);
    }

    // Returns the phase in cycles for a plane in focus `ratio` times as far away as the hologram.
    double defocus(double nx, double ny, double ratio, double dx, double dy) const {
        if (ratio == 1) return 0;
        const double R = camera_.eye.z;
        return (path(nx, ny, R, dx, dy) - path(nx, ny, ratio * R, dx, dy)) / wavelength_;
    }

    // Returns focus_ratio() in a direction of the picture, and that of its edge outside the picture.
    double ratio(double nx, double ny) const {
        const double distance = camera_.eye.z / cosine_of(nx, ny);
        const Grid& picture = camera_.picture;
        const double half_x = 0.5 * picture.size_x(), half_y = 0.5 * picture.size_y();
        return focus_ratio(
            camera_, std::clamp(camera_.eye.x + distance * nx, picture.center_x - half_x, picture.center_x + half_x),
            std::clamp(camera_.eye.y + distance * ny, picture.center_y - half_y, picture.center_y + half_y));
    }

    std::size_t nodes_for(double ux, double uy) const {
        const double mid_x = 0.5 * (sines_.shown_x.low + sines_.shown_x.high),
                     mid_y = 0.5 * (sines_.shown_y.low + sines_.shown_y.high);
        double change = 0;
        for (double a : {0.0, 0.25, 0.5, 0.75}) {
            const double dx = radius_ * std::cos(std::numbers::pi * a), dy = radius_ * std::sin(std::numbers::pi * a);
            const auto phase_at = [&](double fraction) {
                const double nx = mid_x + fraction * ux, ny = mid_y + fraction * uy;
                return defocus(nx, ny, ratio(nx, ny), dx, dy);
            };
            change = std::max(change, std::abs(phase_at(0.5) - phase_at(-0.5)));
        }
        const double radians = 2 * std::numbers::pi * change;
        constexpr double negligible = 0.02;
        if (tilted_ && radians > negligible)
            return static_cast<std::size_t>(std::min(std::ceil(radians / 0.2) + 1, max_tilted_nodes));
        return static_cast<std::size_t>(std::clamp(std::ceil(radians / 0.5), 1.0, max_nodes));
    }

    const SineGrid& sines_;
    double wavelength_;
    const Camera& camera_;
    bool tilted_;
    double radius_, step_x_, step_y_;
    optics::SpreadWindow window_;
    optics::PupilEdge edge_;
};

}  // namespace hogel::camera::film
