// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "hogel/camera/models.h"
#include "hogel/image/film.h"
#include "hogel/math/quadrature.h"
#include "hogel/photograph.h"
#include "hogel/work/parallel.h"

namespace hogel {
namespace {

using DoubleComplex = std::complex<double>;

struct PupilPoint {
    Vec3 position;
    double area;
    DoubleComplex field;
};

// Returns points on rings around the pupil's centre, with radii of Gauss-Legendre quadrature, as far apart on a ring as
// the rings, with some more for smoothness. Their sum is exact for a wave that changes by much less than a cycle from
// point to point, unlike that over a square grid, in which the disc has a jagged rim.
std::vector<PupilPoint> pupil_points(const Camera& camera, std::size_t across) {
    std::vector<PupilPoint> points;
    const double half_radius = 0.25 * camera.pupil;
    const math::Quadrature radii = math::gauss_legendre((across + 1) / 2, half_radius);
    for (std::size_t i = 0; i < radii.points.size(); ++i) {
        const double radius = half_radius + radii.points[i];
        const double spacings_on_ring = std::numbers::pi * static_cast<double>(across) * radius / (2 * half_radius);
        const std::size_t count = 16 + static_cast<std::size_t>(std::ceil(spacings_on_ring));
        const double step = 2 * std::numbers::pi / static_cast<double>(count);
        for (std::size_t k = 0; k < count; ++k) {
            const double angle = (static_cast<double>(k) + 0.5 * static_cast<double>(i % 2)) * step;
            points.push_back(
                {{camera.eye.x + radius * std::cos(angle), camera.eye.y + radius * std::sin(angle), camera.eye.z},
                 radii.weights[i] * radius * step,
                 0});
        }
    }
    return points;
}

void sum_directly(const FieldSource& hologram, const Camera& camera, const DirectCamera& model, Image& image) {
    const std::size_t subpixels = model.subpixels;
    const FieldGrid& grid = hologram.grid();
    const Grid& plane = grid.plane;
    const double k = 2 * std::numbers::pi / grid.wavelength;
    std::vector<PupilPoint> pupil = pupil_points(camera, model.pupil_points);
    const double pupil_area = 0.25 * std::numbers::pi * camera.pupil * camera.pupil;
    const math::Quadrature subpixel_nodes = math::gauss_legendre(subpixels, 0.5);

    Array<std::complex<float>, 2> field({plane.height, plane.width});
    for (std::size_t look = 0; look < hologram.looks(); ++look) {
        hologram.read({0, 0, plane.width, plane.height}, look, field);
        // Rayleigh-Sommerfeld: every sample of the hologram sends a wave z/(iλr²) e^{ikr} to the pupil.
        work::parallel_for(pupil.size(), [&](std::size_t i) {
            DoubleComplex sum = 0;
            for (std::size_t row = 0; row < plane.height; ++row)
                for (std::size_t column = 0; column < plane.width; ++column) {
                    const Vec3 sample{plane.x(static_cast<double>(column)), plane.y(static_cast<double>(row)), 0};
                    const double r = length(pupil[i].position - sample);
                    sum += DoubleComplex(field(row, column)) * std::polar(camera.eye.z / (r * r), k * r);
                }
            pupil[i].field = sum * plane.pitch_x * plane.pitch_y / DoubleComplex(0, grid.wavelength);
        });
        // A perfect lens: waves from a point p of the plane in focus arrive in phase at the image of p on the film.
        work::parallel_for(camera.picture.height, [&](std::size_t row) {
            for (std::size_t column = 0; column < camera.picture.width; ++column)
                for (std::size_t b = 0; b < subpixels; ++b)
                    for (std::size_t a = 0; a < subpixels; ++a) {
                        const Vec3 on_hologram{camera.picture.x(static_cast<double>(column) + subpixel_nodes.points[a]),
                                               camera.picture.y(static_cast<double>(row) + subpixel_nodes.points[b]),
                                               0};
                        const Vec3 p =
                            camera.eye + focus_ratio(camera, on_hologram.x, on_hologram.y) * (on_hologram - camera.eye);
                        DoubleComplex film = 0;
                        for (const PupilPoint& q : pupil)
                            film += q.field * std::polar(q.area, -k * length(q.position - p));
                        // Radiance of a diffuse surface: |film|² cos θ / (λ² · area of the pupil).
                        const double cosine = camera.eye.z / length(camera.eye - on_hologram);
                        image.pixels(row, column, 0) += static_cast<float>(
                            subpixel_nodes.weights[a] * subpixel_nodes.weights[b] * std::norm(film) * cosine /
                            (grid.wavelength * grid.wavelength * pupil_area) / static_cast<double>(hologram.looks()));
                    }
        });
    }
}

}  // namespace

void camera::photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const DirectCamera& model,
                           std::span<Image> pictures, const Progress& progress) {
    image::load_film(cameras, 1, hologram.provenance(), pictures);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        sum_directly(hologram, cameras[i], model, pictures[i]);
        progress.report(static_cast<double>(i + 1) / static_cast<double>(cameras.size()));
    }
}

}  // namespace hogel
