// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "hogel/field.h"

namespace hogel::optics::propagation {

/// A point on the other plane, in the coordinates of the field.
struct PlanePoint {
    double x = 0, y = 0;
};

/// The propagated field at any points, by sums in double precision: the plain versions of propagate(), for small
/// fields.

/// The integral over all plane waves of the band by Gauss's rule, exact at any distance. Evanescent waves decay
/// forwards and are dropped backwards. The number of nodes grows with the path that light can take: distances at which
/// the samples diffract by up to a few widths of the field.
std::vector<std::complex<double>> sum_of_plane_waves(const Field& field, double distance,
                                                     std::span<const PlanePoint> points);

/// Rayleigh and Sommerfeld's first integral as a sum over the samples, (z/2πr²)(1/r − ik) e^{ikr}. The samples light
/// copies too, in directions beyond their band; it is exact where those lie outside and the field has no light at the
/// edge of the band: at large distances.
std::vector<std::complex<double>> sum_of_spherical_waves(const Field& field, double distance,
                                                         std::span<const PlanePoint> points);

}  // namespace hogel::optics::propagation
