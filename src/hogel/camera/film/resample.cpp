// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/resample.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "hogel/camera/film/line_shares.h"

namespace hogel::camera::film {
namespace {

static_assert(TangentNodes::max == max_line_nodes);

double position(const TangentPositions& positions, double square, double scale, double i) {
    const double s = positions.first + i * positions.step;
    return positions.offset + scale * (s / std::sqrt(square - s * s));
}

// Resamples lines [begin, end), in halves if their positions differ too much.
void resample_range(const float* lines, std::size_t size, const TangentPositions& positions,
                    const InterpolationTable& table, std::size_t count, std::size_t begin, std::size_t end,
                    float* out) {
    const auto range_of = [&](const auto& values) {
        return std::ranges::minmax(std::span(values).subspan(begin, end - begin));
    };
    const auto [low_square, high_square] = range_of(positions.squares);
    const auto [low_scale, high_scale] = range_of(positions.scales);
    // Positions differ most at an end.
    double spread = 0;
    for (const double i : {0.0, static_cast<double>(count) - 1})
        spread = std::max(spread, std::abs(position(positions, high_square, high_scale, i) -
                                           position(positions, low_square, low_scale, i)));
    if (spread > max_line_spread && end - begin > 1) {
        const std::size_t middle = (begin + end) / 2;
        resample_range(lines, size, positions, table, count, begin, middle, out);
        resample_range(lines, size, positions, table, count, middle, end, out);
        return;
    }
    TangentNodes nodes{};
    nodes.nodes = line_nodes(spread);
    for (std::size_t node = 0; node < nodes.nodes; ++node) {
        nodes.squares[node] = at_node(node, nodes.nodes, low_square, high_square);
        nodes.scales[node] = at_node(node, nodes.nodes, low_scale, high_scale);
    }
    for (std::size_t line = begin; line < end; ++line) {
        nodes.t[line] = high_square > low_square ? line_position(positions.squares[line], low_square, high_square)
                                                 : line_position(positions.scales[line], low_scale, high_scale);
        nodes.mask[line] = 1;
    }
    resample_nodes(lines, size, positions, nodes, table, count, out);
}

}  // namespace

void resample_lines_plain(const float* lines, std::size_t size, const TangentPositions& positions,
                          const InterpolationTable& table, std::size_t count, float* out) {
    std::vector<std::complex<float>> line_values(size);
    for (std::size_t line = 0; line < optics::block_lines; ++line) {
        for (std::size_t i = 0; i < size; ++i) {
            const float* re = lines + 2 * i * optics::block_lines + line;
            line_values[i] = {re[0], re[optics::block_lines]};
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::complex<float> value =
                table.at(line_values.data(), size,
                         position(positions, positions.squares[line], positions.scales[line], static_cast<double>(i)));
            out[2 * i * optics::block_lines + line] = value.real();
            out[(2 * i + 1) * optics::block_lines + line] = value.imag();
        }
    }
}

void resample_lines(const float* lines, std::size_t size, const TangentPositions& positions,
                    const InterpolationTable& table, std::size_t count, float* out) {
    if (count > 0) resample_range(lines, size, positions, table, count, 0, optics::block_lines, out);
}

}  // namespace hogel::camera::film
