// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/propagation/plain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "hogel/optics/phase_walk.h"

namespace hogel::optics::propagation {
namespace {

using DoubleComplex = std::complex<double>;
using std::numbers::pi;

struct Nodes {
    std::vector<double> position, weight;
};

// Returns the Gauss rule of 16 nodes per panel on equal panels of [−edge, edge]. The nodes are the zeros of the
// Legendre polynomial, found by Newton's method.
Nodes gauss(double edge, std::size_t panels) {
    constexpr int order = 16;
    std::array<double, order> zero{}, weight{};
    for (int i = 0; i < order; ++i) {
        double x = std::cos(pi * (i + 0.75) / (order + 0.5)), slope = 1;
        for (int step = 0; step < 50; ++step) {
            double p = 1, previous = 0;
            for (int n = 0; n < order; ++n) previous = std::exchange(p, ((2 * n + 1) * x * p - n * previous) / (n + 1));
            slope = order * (x * p - previous) / (x * x - 1);
            x -= p / slope;
        }
        zero[std::size_t(i)] = x;
        weight[std::size_t(i)] = 2 / ((1 - x * x) * slope * slope);
    }
    Nodes nodes;
    const double half = edge / static_cast<double>(panels);
    for (std::size_t panel = 0; panel < panels; ++panel)
        for (std::size_t i = 0; i < order; ++i) {
            nodes.position.push_back(-edge + half * (2 * static_cast<double>(panel) + 1 + zero[i]));
            nodes.weight.push_back(half * weight[i]);
        }
    return nodes;
}

// Returns nodes on panels of about two cycles of e^{2πi f u}, for the longest sideways path u from a point.
Nodes nodes_of(double pitch, double path, double wavelength) {
    const double edge = std::min(0.5 / pitch, 4 / wavelength);
    return gauss(edge, static_cast<std::size_t>(std::ceil(edge * path)) + 2);
}

double path_at_edge(const FieldGrid& grid, double distance) {
    const double sine =
        std::min(0.995, 0.5 * grid.wavelength * std::hypot(1 / grid.plane.pitch_x, 1 / grid.plane.pitch_y));
    return std::abs(distance) * sine / std::sqrt(1 - sine * sine);
}

}  // namespace

std::vector<DoubleComplex> sum_of_plane_waves(const Field& field, double distance, std::span<const PlanePoint> points) {
    const Grid& plane = field.grid().plane;
    const double k = 1 / field.grid().wavelength;
    double path_x = plane.size_x(), path_y = plane.size_y();
    for (const PlanePoint& point : points) {
        path_x = std::max(path_x, std::abs(point.x - plane.center_x) + 0.5 * plane.size_x());
        path_y = std::max(path_y, std::abs(point.y - plane.center_y) + 0.5 * plane.size_y());
    }
    const double edge_path = path_at_edge(field.grid(), distance);
    const Nodes x = nodes_of(plane.pitch_x, path_x + edge_path, field.grid().wavelength),
                y = nodes_of(plane.pitch_y, path_y + edge_path, field.grid().wavelength);
    std::vector<DoubleComplex> result(points.size()), column(plane.height), along_x(points.size());
    std::vector<DoubleComplex> along_y;  // [node][point]
    for (const double f : y.position)
        for (const PlanePoint& point : points) along_y.push_back(unit_phasor(f * point.y));
    for (std::size_t i = 0; i < x.position.size(); ++i) {
        // Transforms the rows at f_x, then the column at each f_y.
        std::ranges::fill(column, DoubleComplex(0));
        for (std::size_t s = 0; s < plane.width; ++s) {
            const DoubleComplex wave = unit_phasor(-x.position[i] * plane.x(static_cast<double>(s)));
            for (std::size_t t = 0; t < plane.height; ++t) column[t] += times(wave, DoubleComplex(field.samples(t, s)));
        }
        for (std::size_t p = 0; p < points.size(); ++p)
            along_x[p] = x.weight[i] * unit_phasor(x.position[i] * points[p].x);
        for (std::size_t j = 0; j < y.position.size(); ++j) {
            const double square = k * k - x.position[i] * x.position[i] - y.position[j] * y.position[j];
            if (square < 0 && distance < 0) continue;
            DoubleComplex value = 0;
            const DoubleComplex step = unit_phasor(y.position[j] * plane.pitch_y);
            DoubleComplex wave = unit_phasor(-y.position[j] * plane.y(0));
            for (std::size_t t = 0; t < plane.height; ++t, wave = times(wave, step)) value += times(wave, column[t]);
            value *= square >= 0 ? unit_phasor(std::sqrt(square) * distance)
                                 : DoubleComplex(std::exp(-2 * pi * std::sqrt(-square) * distance));
            value *= y.weight[j] * plane.pitch_x * plane.pitch_y;
            for (std::size_t p = 0; p < points.size(); ++p)
                result[p] += times(times(value, along_x[p]), along_y[j * points.size() + p]);
        }
    }
    return result;
}

std::vector<DoubleComplex> sum_of_spherical_waves(const Field& field, double distance,
                                                  std::span<const PlanePoint> points) {
    const Grid& plane = field.grid().plane;
    const double wavelength = field.grid().wavelength, z = std::abs(distance);
    std::vector<DoubleComplex> result;
    for (const PlanePoint& point : points) {
        DoubleComplex sum = 0;
        for (std::size_t t = 0; t < plane.height; ++t)
            for (std::size_t s = 0; s < plane.width; ++s) {
                const double r =
                    std::hypot(point.x - plane.x(static_cast<double>(s)), point.y - plane.y(static_cast<double>(t)), z);
                DoubleComplex kernel =
                    z / (2 * pi * r * r) * DoubleComplex(1 / r, -2 * pi / wavelength) * unit_phasor(r / wavelength);
                // Backward propagation uses the conjugate kernel of forward propagation.
                if (distance < 0) kernel = std::conj(kernel);
                sum += kernel * DoubleComplex(field.samples(t, s));
            }
        result.push_back(sum * plane.pitch_x * plane.pitch_y);
    }
    return result;
}

}  // namespace hogel::optics::propagation
