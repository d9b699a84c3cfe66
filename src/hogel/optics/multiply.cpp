// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/multiply.h"

#include "hogel/optics/phase_walk.h"

namespace hogel::optics {

void multiply_plain(const std::complex<float>* a, const std::complex<float>* b, std::span<std::complex<float>> out) {
    for (std::size_t x = 0; x < out.size(); ++x) out[x] = times(a[x], b[x]);
}

}  // namespace hogel::optics
