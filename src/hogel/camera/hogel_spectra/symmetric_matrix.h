// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/array.h"

namespace hogel::camera::hogel_spectra {

/// Eigenvalues of a real symmetric matrix, largest first, and its eigenvectors of length 1, [number][row].
struct Eigensystem {
    std::vector<double> values;
    Array<double, 2> vectors;
};

/// Computes the eigensystem by Jacobi rotations, for matrices of at most a hundred rows.
Eigensystem eigensystem(Array<double, 2> matrix);

}  // namespace hogel::camera::hogel_spectra
