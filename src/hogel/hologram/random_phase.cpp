#include "hogel/hologram/random_phase.h"

#include <algorithm>
#include <numbers>

#include "hogel/core/random.h"

namespace hogel {
namespace {

const std::array<std::complex<float>, 256>& roots_of_unity() {
    static const auto table = [] {
        std::array<std::complex<float>, 256> roots;
        for (std::size_t b = 0; b < roots.size(); ++b)
            roots[b] = std::complex<float>(std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(b) / 256));
        return roots;
    }();
    return table;
}

}  // namespace

void spread_random_phases(const PhaseSeries& series, std::span<const float> moduli,
                          std::span<std::complex<float>> values) {
    const auto& roots = roots_of_unity();
    for (std::size_t i = 0; i < values.size(); i += 16) {
        const auto words =
            philox({static_cast<std::uint32_t>(i / 16), series.position[0], series.position[1], series.position[2]},
                   series.key);
        for (std::size_t j = 0; j < std::min<std::size_t>(16, values.size() - i); ++j)
            values[i + j] = moduli[i + j] * roots[words[j / 4] >> (8 * (j % 4)) & 0xff];
    }
}

}  // namespace hogel
