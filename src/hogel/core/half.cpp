#include "hogel/core/half.h"

namespace hogel {

void to_half(const float* from, std::uint16_t* to, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) to[i] = half_of(from[i]);
}

void to_float(const std::uint16_t* from, float* to, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) to[i] = float_of(from[i]);
}

}  // namespace hogel
