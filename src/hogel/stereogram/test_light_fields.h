// SPDX-License-Identifier: Apache-2.0
// Light fields given by formulas, and measures of their photographs, for the tests of this module.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hogel/image.h"
#include "hogel/light_field.h"

namespace hogel::stereogram {

/// The radiance of a ray from a hogel in a direction of any length, both (x, y, ζ).
using Radiance = std::function<double(Vec3 hogel, Vec3 direction)>;

inline LightFieldBuffer light_field_of(const LightFieldGrid& grid, const Radiance& radiance) {
    LightFieldBuffer light_field(grid);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t l = 0; l < grid.directions_v; ++l)
                for (std::size_t k = 0; k < grid.directions_u; ++k)
                    light_field.radiance(0, t, s, l, k) =
                        float(radiance({grid.s(double(s)), grid.t(double(t)), 0},
                                       grid.direction_of(grid.u(double(k)), grid.v(double(l)))));
    return light_field;
}

inline LightField light_field_of_faces(std::span<const LightFieldGrid> grids, const Radiance& radiance) {
    std::vector<LightField::Source> faces;
    for (const LightFieldGrid& face : grids)
        faces.push_back(std::make_shared<const LightFieldBuffer>(light_field_of(face, radiance)));
    return LightField(std::move(faces));
}

inline LightField hemicube_of(const LightFieldGrid& grid, const Radiance& radiance) {
    return light_field_of_faces(hemicube(grid), radiance);
}

/// Position and size of the light in a picture.
struct Spot {
    double x = 0, y = 0, wide = 0, high = 0;  ///< centroid and standard deviations, metres
};
inline Spot spot_of(const Image& image, const Grid& picture) {
    Spot spot;
    double all = 0;
    const auto sum = [&](auto&& add) {
        for (std::size_t row = 0; row < picture.height; ++row)
            for (std::size_t column = 0; column < picture.width; ++column)
                add(double(image.pixels(row, column, 0)), picture.x(double(column)), picture.y(double(row)));
    };
    sum([&](double light, double x, double y) { all += light, spot.x += light * x, spot.y += light * y; });
    spot.x /= all;
    spot.y /= all;
    sum([&](double light, double x, double y) {
        spot.wide += light * (x - spot.x) * (x - spot.x) / all;
        spot.high += light * (y - spot.y) * (y - spot.y) / all;
    });
    spot.wide = std::sqrt(spot.wide);
    spot.high = std::sqrt(spot.high);
    return spot;
}

inline double mean_of(const Image& image) {
    double mean = 0;
    for (const float value : image.pixels.elements()) mean += value / double(image.pixels.size());
    return mean;
}

}  // namespace hogel::stereogram
