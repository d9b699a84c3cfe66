// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "hogel/field.h"

namespace hogel::optics::propagation {

/// A point on the output plane, in the coordinates of the field.
struct PlanePoint {
    double x = 0, y = 0;
};

/// Reference versions of propagate() for small fields: sums in double precision at arbitrary points.

/// Returns the Gaussian quadrature over all plane waves of the band, exact at any distance. Evanescent waves decay
/// forwards and are dropped backwards. The number of nodes grows with the sideways path of light; suited to distances
/// at which the samples diffract by up to a few field widths.
std::vector<std::complex<double>> sum_of_plane_waves(const Field& field, double distance,
                                                     std::span<const PlanePoint> points);

/// Returns the first Rayleigh–Sommerfeld integral as a sum over the samples, (z/2πr²)(1/r − ik) e^{ikr}. The samples
/// also emit aliases in directions beyond their band. The sum is exact if the points are outside these directions and
/// the field has no light at the edge of its band, i.e. at large distances.
std::vector<std::complex<double>> sum_of_spherical_waves(const Field& field, double distance,
                                                         std::span<const PlanePoint> points);

}  // namespace hogel::optics::propagation
