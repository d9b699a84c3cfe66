// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/designed_phase.h"

#include <cmath>

namespace hogel::stereogram {
namespace {

constexpr int projections = 200;  // more do not flatten the modulus further

std::complex<float> unit(std::complex<float> value) {
    const float modulus = std::abs(value);
    return modulus > 0 ? value / modulus : std::complex<float>(1);
}

}  // namespace

void flatten_fringe(View<const float, 2> moduli, const math::Fft2& fft, View<std::complex<float>, 2> phases) {
    Array<std::complex<float>, 2> fringe(phases.shape());
    for (int i = 0; i < projections; ++i) {
        for (std::size_t j = 0; j < fringe.size(); ++j) fringe.data()[j] = moduli.data()[j] * phases.data()[j];
        fft.backward(fringe);
        for (auto& sample : fringe.elements()) sample = unit(sample);
        fft.forward(fringe);
        for (std::size_t j = 0; j < fringe.size(); ++j) phases.data()[j] = unit(fringe.data()[j]);
    }
}

}  // namespace hogel::stereogram
