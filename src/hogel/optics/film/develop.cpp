// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "hogel/core/parallel.h"
#include "hogel/optics/film/film.h"
#include "hogel/optics/film/interpolation.h"
#include "hogel/optics/film/kernels.h"
#include "hogel/optics/film/lens.h"
#include "hogel/photograph.h"

namespace hogel::optics::film {

void Film::develop(View<const float, 2> blocks, const Camera& camera, const Rectangle& shown, double weight,
                   Image& image) const {
    Array<float, 2> intensity({size_.y.count, size_.x.count});
    core::parallel_for(blocks_of(size_.y.count), [&](std::size_t part) {
        const std::size_t end = std::min((part + 1) * lines_together, size_.y.count);
        for (std::size_t block = 0; block < blocks.extent(0); ++block) {
            const std::size_t first = block * lines_together, count = std::min(lines_together, size_.x.count - first);
            for (std::size_t y = part * lines_together; y < end; ++y)
                std::copy_n(&blocks(block, y * lines_together), count, &intensity(y, first));
        }
    });
    const Grid& picture = camera.picture;
    const Vec3 eye = band_.geometry.eye();
    const double cell = resolution_cell(camera, hologram_.wavelength);
    const std::size_t sub_x = gauss_points(picture.pitch_x / cell), sub_y = gauss_points(picture.pitch_y / cell);
    const auto place = [](std::size_t pixel, std::size_t point, std::size_t count) {
        return static_cast<double>(pixel) + gauss_place(point, count);
    };
    // The range of pixels that are shown, for each point within a pixel.
    struct Columns {
        std::size_t begin = 0, end = 0;
    };
    std::vector<Columns> columns(sub_x);
    for (std::size_t a = 0; a < sub_x; ++a) {
        const auto held = [&](std::size_t column) {
            const double x = picture.x(place(column, a, sub_x));
            return x >= shown.left && x < shown.right;
        };
        Columns& c = columns[a];
        while (c.begin < picture.width && !held(c.begin)) ++c.begin;
        for (c.end = c.begin; c.end < picture.width && held(c.end);) ++c.end;
    }
    // A diffuse surface of radiance L sends L cos θ · (area of the pupil) cos θ/r² through this band, and its plane
    // waves have 1/cos θ of that as |F|² (docs/notation.md section 4): so the film shows radiance times
    // (area of the pupil) cos θ/r², and cos θ is c_z/r.
    const double area = FilmLens(size_.sines, hologram_.wavelength, camera).area();
    const auto scale = static_cast<float>(weight / (area * eye.z * static_cast<double>(sub_x * sub_y)));
    // A pixel's mean is taken first down the film's columns, on each of which n_x is constant and n_y = √(1 − n_x²) ·
    // (y − c_y)/√((y − c_y)² + c_z²), and then along the row.
    std::vector<double> slopes(size_.x.count);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const double nx = size_.x.low + static_cast<double>(i) * size_.x.step;
        slopes[i] = std::sqrt(1 - nx * nx);
    }
    core::parallel_for(picture.height, [&](std::size_t row) {
        std::vector<float> line(size_.x.count), pixels(picture.width);
        std::vector<double> sines;
        for (std::size_t b = 0; b < sub_y; ++b) {
            const double y = picture.y(place(row, b, sub_y)), up = y - eye.y;
            if (y >= shown.bottom && y < shown.top) sines.push_back(up / std::hypot(up, eye.z) / size_.y.step);
        }
        sum_down_columns(intensity.data(), size_.x.count, size_.y.count, {slopes, sines, -size_.y.low / size_.y.step},
                         line);
        const double dy = picture.y(static_cast<double>(row)) - eye.y;
        for (std::size_t a = 0; a < sub_x; ++a) {
            const Columns& c = columns[a];
            add_along_line(line,
                           {picture.x(place(c.begin, a, sub_x)) - eye.x, picture.pitch_x, dy * dy + eye.z * eye.z,
                            1 / size_.x.step, -size_.x.low / size_.x.step},
                           scale, std::span(pixels).subspan(c.begin, c.end - c.begin));
        }
        for (std::size_t column = 0; column < picture.width; ++column) image.pixels(row, column, 0) += pixels[column];
    });
}

}  // namespace hogel::optics::film
