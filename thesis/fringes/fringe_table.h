// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "hogel/array.h"

namespace hogel::fringes {

/// Term of a weighted sum of fringes: [K] (3.24).
struct WeightedFringe {
    const std::complex<float>* fringe;
    float weight;
};

/// Computes sum[i] = Σ weight · fringe[i] over all fringes. Plain and fast twins agree to rounding.
void sum_fringes_plain(std::span<const WeightedFringe> fringes, std::span<std::complex<float>> sum);
extern decltype(sum_fringes_plain)& sum_fringes;

/// Thread-safe table of basis fringes, each computed on first use.
class FringeTable {
  public:
    using Make = std::function<void(std::size_t number, std::span<std::complex<float>> fringe)>;

    /// @param samples  number of samples of a fringe
    FringeTable(std::size_t fringes, std::size_t samples, Make make);
    const std::complex<float>* operator[](std::size_t number) const;

  private:
    std::size_t samples_;
    Make make_;
    mutable std::vector<Array<std::complex<float>, 1>> fringes_;
    mutable std::vector<std::once_flag> computed_;
};

}  // namespace hogel::fringes
