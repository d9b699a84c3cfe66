// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "hogel/array.h"

namespace hogel::hologram {

/// A weighted sum of fringes: [K] (3.24).
struct WeightedFringe {
    const std::complex<float>* fringe;
    float weight;
};

/// sum[i] = Σ weight · fringe[i] over all fringes; plain, and as fast as this processor allows. The twins agree to
/// rounding.
void sum_fringes_plain(std::span<const WeightedFringe> fringes, std::span<std::complex<float>> sum);
void sum_fringes(std::span<const WeightedFringe> fringes, std::span<std::complex<float>> sum);

/// Basis fringes, each computed when it is first needed and kept. May be used by several threads at once.
class FringeTable {
  public:
    using Make = std::function<void(std::size_t number, std::span<std::complex<float>> fringe)>;

    /// @param samples  of a fringe
    FringeTable(std::size_t fringes, std::size_t samples, Make make);
    const std::complex<float>* operator[](std::size_t number) const;

  private:
    std::size_t samples_;
    Make make_;
    mutable std::vector<Array<std::complex<float>, 1>> fringes_;
    mutable std::vector<std::once_flag> made_;
};

}  // namespace hogel::hologram
