// SPDX-License-Identifier: Apache-2.0
#include "thesis/fringes/fringe_table.h"

#include <algorithm>

namespace hogel::fringes {

void sum_fringes_plain(std::span<const WeightedFringe> fringes, std::span<std::complex<float>> sum) {
    std::ranges::fill(sum, std::complex<float>(0));
    for (const auto& [fringe, weight] : fringes)
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * fringe[i];
}

FringeTable::FringeTable(std::size_t fringes, std::size_t samples, Make make)
    : samples_(samples), make_(std::move(make)), fringes_(fringes), computed_(fringes) {}

const std::complex<float>* FringeTable::operator[](std::size_t number) const {
    std::call_once(computed_[number], [&] {
        Array<std::complex<float>, 1> fringe({samples_});
        make_(number, fringe.elements());
        fringes_[number] = std::move(fringe);
    });
    return fringes_[number].data();
}

}  // namespace hogel::fringes
