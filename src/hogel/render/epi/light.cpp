// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "hogel/render/epi/light.h"
#include "hogel/render/sample_store.h"

namespace hogel::render::epi {
namespace {

using Node = LitStrips::Node;

constexpr float not_yet = std::numeric_limits<float>::quiet_NaN();

shading::RadianceCache::Corners corners_of(const StripLight& light, const shading::LightGrid::Place& row,
                                           const shading::LightGrid::Place& column, std::size_t strip,
                                           const SampleSource& samples) {
    const std::uint32_t* first =
        light.points + std::uint64_t{row.node} * light.down + std::uint64_t{column.node} * light.right;
    const std::array points{first, first + light.right, first + light.down, first + light.down + light.right};
    if (!shading::LightGrid::are_filled(points[0], points[1], points[2], points[3]))
        return samples.corners(strip, row.node, column.node);
    shading::RadianceCache::Corners corners{};
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 3; ++i) corners[k][i] = std::bit_cast<float>(points[k][i]);
    return corners;
}

// What is kept where part of the way along a strip lies, and a zero.
Node light_of_points(const StripLight& light, float part, std::size_t strip, const SampleSource& samples) {
    const float towards = light.place[0] + part * light.change[0], last = light.place[1] + part * light.change[1];
    const shading::LightGrid::Place row(towards, light.axis[0]);
    const shading::LightGrid::Place column(shading::LightGrid::along(towards, last), light.axis[1]);
    const shading::RadianceCache::Corners corner = corners_of(light, row, column, strip, samples);
    Node value;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const float upper = corner[0][i] + column.beyond * (corner[1][i] - corner[0][i]);
        const float lower = corner[2][i] + column.beyond * (corner[3][i] - corner[2][i]);
        value[i] = std::max(0.0f, upper + row.beyond * (lower - upper));
    }
    return value;
}

Node value_of_one(const StripShades& strip, float part) {
    Node value;
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = strip.value0[i] + part * strip.difference[i];
    return value;
}

}  // namespace

StripLight::StripLight(const shading::LightGrid& grid, const StripOrigin& strip)
    : axis{shading::LightGrid::Axis(grid.rows), shading::LightGrid::Axis(grid.columns)},
      points(grid.points),
      down(grid.rows > 0 ? grid.down : 0),
      right(grid.columns > 0 ? grid.right : 0) {
    const std::array weights0 = strip.weights(0), weights1 = strip.weights(1);
    place[0] = grid.towards(weights0);
    place[1] = grid.last(weights0);
    change[0] = grid.towards(weights1) - place[0];
    change[1] = grid.last(weights1) - place[1];
}

float StripLight::cells() const {
    const float rows = down > 0 ? std::abs(change[0]) * axis[0].scale : 0,
                columns = right > 0 ? std::abs(change[1]) * axis[1].scale : 0;
    const float cells = std::min(per_cell * std::max(rows, columns), max_cells - 1);
    return static_cast<float>(static_cast<std::int32_t>(cells) + 1);
}

void LitStrips::clear(const StripShades& background) {
    lines_.clear();
    waits_.clear();
    has_points_ = false;
    used_ = 0;
    take_nodes(2);
    nodes_[0] = nodes_[1] = {0, 0, 0, not_yet};
    StripShades without_depth = background;
    without_depth.value0[3] = without_depth.difference[3] = 0;
    add_lit_at_ends(without_depth);
}

std::uint32_t LitStrips::take_nodes(std::size_t count) {
    const std::size_t first = used_;
    used_ += count;
    if (nodes_.size() < used_) nodes_.resize(2 * used_);
    return static_cast<std::uint32_t>(first);
}

void LitStrips::add_line(const StripShades& strip, LightFrom from, std::uint32_t first_node) {
    Line& line = lines_.emplace_back(Line{strip.x0, strip.z0, strip.dx, strip.dz, 0, 0, 0, from});
    line.set_nodes(first_node, 1);
    waits_.push_back(from == LightFrom::points ? 1 : 0);
    has_points_ |= from == LightFrom::points;
}

void LitStrips::add_lit_at_ends(const StripShades& strip) {
    const std::uint32_t first = take_nodes(2);
    add_line(strip, LightFrom::ends, first);
    nodes_[first] = value_of_one(strip, 0);
    nodes_[first + 1] = value_of_one(strip, 1);
}

void LitStrips::add_lit(const StripShades& strip, LightFrom from) { add_line(strip, from, unmade); }

std::uint32_t LitStrips::add_nodes(std::size_t number, float cells) {
    const std::uint32_t first = take_nodes(static_cast<std::size_t>(cells) + 1);
    lines_[number].set_nodes(first, cells);
    waits_[number] = 0;
    return first;
}

void LitStrips::add_unmade_nodes(std::size_t number, float cells) {
    const std::uint32_t first = add_nodes(number, cells);
    std::fill_n(nodes_.begin() + first, static_cast<std::size_t>(cells) + 1, Node{0, 0, 0, not_yet});
}

void make_nodes_around(float part, std::size_t number, const StripShades& strip, LitStrips& lit,
                       const SampleSource& samples, bool colour) {
    const auto [origins, grids] = samples.grids();
    const StripLight light(grids[origins[number].triangle], origins[number]);
    const LitStrips::Line& line = lit.lines()[number];
    const std::uint32_t cell = LitStrips::Place(line, part).cell;
    for (std::uint32_t i = cell; i <= cell + 1; ++i) {
        Node& node = lit.nodes()[line.first_node() + i];
        if (!std::isnan(node[3])) continue;
        const float at = static_cast<float>(i) / line.cells;
        node = light_of_points(light, at, number, samples);
        if (!colour) node = {luminance({node[0], node[1], node[2]}), 0, 0, 0};
        node[3] = strip.value0[3] + at * strip.difference[3];
    }
}

void shade_lit_plain(const EpipolarPlane& plane, std::span<const StripShades> strips, LitStrips& lit,
                     const SampleSource& samples, const ShadedPlane& out) {
    const bool colour = out.values[1] != nullptr;
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t k = 0; k < plane.directions; ++k) {
            std::uint64_t& word = plane.words[column * plane.directions + k];
            const std::size_t number = word & 0xffffffff;
            word = EpipolarPlane::nothing;
            const StripShades& strip = strips[number];
            const LitStrips::Line& line = lit.lines()[number];
            const float n = static_cast<float>(plane.first_column) + static_cast<float>(column);
            const float part = part_of_strip(strip, n, plane.first_direction + static_cast<float>(k));
            Node value;
            if (number == EpipolarPlane::nobody) {
                value = value_of_one(strip, 0);
            } else if (line.from == LightFrom::samples) {
                const Rgb radiance = samples.radiance(number, part, column, k);
                value = value_of_one(strip, part);
                value = {colour ? radiance.r : luminance(radiance), radiance.g, radiance.b, value[3]};
            } else {
                if (line.from == LightFrom::points) {
                    const auto [origins, grids] = samples.grids();
                    const StripOrigin& origin = origins[number];
                    if (lit.waits()[number] != 0)
                        lit.add_unmade_nodes(number, StripLight(grids[origin.triangle], origin).cells());
                    make_nodes_around(part, number, strip, lit, samples, colour);
                }
                const LitStrips::Place place(line, part);
                const Node* node = lit.nodes() + line.first_node() + place.cell;
                for (std::size_t i = 0; i < value.size(); ++i)
                    value[i] = node[0][i] + place.beyond * (node[1][i] - node[0][i]);
            }
            for (std::size_t i = 0; i < 4; ++i)
                if (out.values[i]) out.values[i][column * out.strides[i] + k] = value[i];
        }
}

}  // namespace hogel::render::epi
