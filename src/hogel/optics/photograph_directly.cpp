// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "hogel/core/parallel.h"
#include "hogel/image/film.h"
#include "hogel/photograph.h"

namespace hogel {
namespace {

using Complex = std::complex<double>;

struct PupilPoint {
    Vec3 position;
    Complex field;
};

// The points of a square grid that are inside the pupil's disc.
std::vector<PupilPoint> pupil_grid(const Camera& camera, std::size_t across) {
    std::vector<PupilPoint> points;
    const double step = camera.pupil / static_cast<double>(across);
    for (std::size_t j = 0; j < across; ++j)
        for (std::size_t i = 0; i < across; ++i) {
            const double x = (static_cast<double>(i) + 0.5) * step - 0.5 * camera.pupil;
            const double y = (static_cast<double>(j) + 0.5) * step - 0.5 * camera.pupil;
            if (std::hypot(x, y) <= 0.5 * camera.pupil)
                points.push_back({{camera.eye.x + x, camera.eye.y + y, camera.eye.z}, 0});
        }
    return points;
}

}  // namespace

Image photograph_directly(const FieldSource& hologram, const Camera& camera, std::size_t pupil_points_across,
                          std::size_t subpixels) {
    validate(camera);
    const FieldGrid& grid = hologram.grid();
    const Grid& plane = grid.plane;
    const double k = 2 * std::numbers::pi / grid.wavelength;
    std::vector<PupilPoint> pupil = pupil_grid(camera, pupil_points_across);
    const double step = camera.pupil / static_cast<double>(pupil_points_across);
    const double pupil_area = static_cast<double>(pupil.size()) * step * step;

    Image image;
    image::load_film({&camera, 1}, 1, hologram.provenance(), {&image, 1});
    Array<std::complex<float>, 2> field({plane.height, plane.width});
    for (std::size_t look = 0; look < hologram.looks(); ++look) {
        hologram.read({0, 0, plane.width, plane.height}, look, field);
        // Rayleigh and Sommerfeld: every sample of the hologram sends a wave z/(iλr²) e^{ikr} to the pupil.
        core::parallel_for(pupil.size(), [&](std::size_t i) {
            Complex sum = 0;
            for (std::size_t row = 0; row < plane.height; ++row)
                for (std::size_t column = 0; column < plane.width; ++column) {
                    const Vec3 from{plane.x(static_cast<double>(column)), plane.y(static_cast<double>(row)), 0};
                    const double r = length(pupil[i].position - from);
                    sum += Complex(field(row, column)) * std::polar(camera.eye.z / (r * r), k * r);
                }
            pupil[i].field = sum * plane.pitch_x * plane.pitch_y / Complex(0, grid.wavelength);
        });
        // A perfect lens: waves from a point p of the plane in focus arrive in phase at the image of p on the film.
        const double points_a_pixel = static_cast<double>(subpixels * subpixels);
        core::parallel_for(camera.picture.height, [&](std::size_t row) {
            for (std::size_t column = 0; column < camera.picture.width; ++column)
                for (std::size_t b = 0; b < subpixels; ++b)
                    for (std::size_t a = 0; a < subpixels; ++a) {
                        const auto within = [&](std::size_t sub) {
                            return (static_cast<double>(sub) + 0.5) / static_cast<double>(subpixels) - 0.5;
                        };
                        const Vec3 on_hologram{camera.picture.x(static_cast<double>(column) + within(a)),
                                               camera.picture.y(static_cast<double>(row) + within(b)), 0};
                        const Vec3 p =
                            camera.eye + focus_ratio(camera, on_hologram.x, on_hologram.y) * (on_hologram - camera.eye);
                        Complex film = 0;
                        for (const PupilPoint& q : pupil)
                            film += q.field * std::polar(step * step, -k * length(q.position - p));
                        // Radiance of a diffuse surface: |film|² cos θ / (λ² · area of the pupil).
                        const double cosine = camera.eye.z / length(camera.eye - on_hologram);
                        image.pixels(row, column, 0) += static_cast<float>(
                            std::norm(film) * cosine / (grid.wavelength * grid.wavelength * pupil_area) /
                            points_a_pixel / static_cast<double>(hologram.looks()));
                    }
        });
    }
    return image;
}

}  // namespace hogel
