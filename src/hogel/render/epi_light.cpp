#include <algorithm>
#include <bit>

#include "hogel/render/epi_light_internal.h"
#include "hogel/render/sample_store_internal.h"

namespace hogel {
namespace {

LightCache::Corners corners_of(const StripLight& light, const LightGrid::Place& row, const LightGrid::Place& column,
                               std::size_t strip, const SampleSource& samples) {
    const std::uint32_t* first =
        light.points + std::uint64_t{row.node} * light.down + std::uint64_t{column.node} * light.right;
    const std::array points{first, first + light.right, first + light.down, first + light.down + light.right};
    if (!LightGrid::are_made(points[0], points[1], points[2], points[3]))
        return samples.corners(strip, row.node, column.node);
    LightCache::Corners corners{};
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 3; ++i) corners[k][i] = std::bit_cast<float>(points[k][i]);
    return corners;
}

Rgb light_of_points(const StripLight& light, float part, std::size_t strip, const SampleSource& samples) {
    const float towards = light.place[0] + part * light.change[0], last = light.place[1] + part * light.change[1];
    const LightGrid::Place row(towards, {light.scale[0], light.last_cell[0]});
    const LightGrid::Place column(LightGrid::along(towards, last), {light.scale[1], light.last_cell[1]});
    const LightCache::Corners corner = corners_of(light, row, column, strip, samples);
    std::array<float, 3> value;
    for (std::size_t i = 0; i < 3; ++i) {
        const float upper = corner[0][i] + column.beyond * (corner[1][i] - corner[0][i]);
        const float lower = corner[2][i] + column.beyond * (corner[3][i] - corner[2][i]);
        value[i] = std::max(0.0f, upper + row.beyond * (lower - upper));
    }
    return {value[0], value[1], value[2]};
}

}  // namespace

void shade_lit_plain(const EpipolarPlane& plane, std::span<const StripShades> strips,
                     std::span<const StripLight> lights, const SampleSource& samples, const ShadedPlane& out) {
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t k = 0; k < plane.directions; ++k) {
            std::uint64_t& word = plane.words[column * plane.directions + k];
            const std::size_t number = word & 0xffffffff;
            word = EpipolarPlane::nothing;
            const StripShades& strip = strips[number];
            const StripLight& light = lights[number];
            const float n = static_cast<float>(plane.first_column) + static_cast<float>(column);
            const float part = part_of_strip(strip, n, plane.first_direction + static_cast<float>(k));
            std::array<float, 4> value;
            for (std::size_t i = 0; i < 4; ++i) value[i] = strip.value0[i] + part * strip.difference[i];
            if (light.from != StripLight::From::ends) {
                const Rgb radiance = light.from == StripLight::From::points
                                         ? light_of_points(light, part, number, samples)
                                         : samples.radiance(number, part, column, k);
                value = {out.values[1] ? radiance.r : luminance(radiance), radiance.g, radiance.b, value[3]};
            }
            for (std::size_t i = 0; i < 4; ++i)
                if (out.values[i]) out.values[i][column * out.strides[i] + k] = value[i];
        }
}

}  // namespace hogel
