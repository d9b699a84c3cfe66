// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace hogel::hologram::eye {

/// A line of nodes through the middle of a hogel: √((first + step · place)² + square) frequency − tilt · place − off
/// cycles at a place, counted in hogels from the middle.
struct NodeLine {
    double first = 0, step = 0, square = 0;
    double frequency = 0;  ///< cycles per metre
    double tilt = 0, off = 0;
};

/// What is left of the demodulation at the nodes of a hogel, as in HogelView: e^{2πi (across + down + bend · right ·
/// below)} for nodes at the places `right` and `below`. The bend is small: 2π bend times both places is below 0.1.
/// Plain and fast twins agree to 1e-6 of the phase by which a line changes.
/// @param places  of the nodes, the same across and down; the vector twin reads up to padded(places) of them
/// @param phases  [node down][2][phase_row(nodes)], aligned to a cache line
void node_phases_plain(const NodeLine& across, const NodeLine& down, double bend, std::span<const double> places,
                       float* phases);
void node_phases(const NodeLine& across, const NodeLine& down, double bend, std::span<const double> places,
                 float* phases);

}  // namespace hogel::hologram::eye
