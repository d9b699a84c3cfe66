// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/patterns/phasors.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {
namespace {

using Complex = std::complex<float>;

// First pixels of the squares that cover `length` pixels. The last square may overlap its neighbour.
std::vector<std::size_t> squares_along(std::size_t side, std::size_t length) {
    std::vector<std::size_t> starts;
    for (std::size_t start = 0; start + side <= length; start += side) starts.push_back(start);
    if (starts.back() + side < length) starts.push_back(length - side);
    return starts;
}

}  // namespace

void require_squares_fit(View<const Complex, 2> field, std::size_t side) {
    const std::size_t max_side = std::min(field.extent(0), field.extent(1));
    if (side < 2 || side > max_side)
        throw Error(ErrorCode::usage, "window",
                    fmt::format("squares of {} pixels do not fit a modulator of {}x{}; expected 2 to {}", side,
                                field.extent(1), field.extent(0), max_side));
}

// Each square alternates independently between unit modulus and the moduli of the field's local spectrum, its light
// field: Gerchberg and Saxton, Optik 35, 1972.
Array<float, 2> iterate_phases(View<const Complex, 2> field, const PatternOptions& options, const Progress& progress) {
    const std::size_t side = options.window, width = field.extent(1), height = field.extent(0);
    require_squares_fit(field, side);
    const std::vector<std::size_t> columns = squares_along(side, width), rows = squares_along(side, height);
    const std::size_t iterations = options.iterations > 0 ? options.iterations : projections;
    const math::Fft2 fft(side, side);
    const std::vector<float> ones(side * side, 1.0f);  // the moduli of a phase modulator
    Array<float, 2> cycles(field.shape());
    for (std::size_t j = 0; j < rows.size(); ++j) {
        progress.report(static_cast<double>(j) / static_cast<double>(rows.size()));
        work::parallel_for(columns.size(), [&](std::size_t i) {
            const std::size_t x0 = columns[i], y0 = rows[j];
            Array<Complex, 2> square({side, side});
            Array<float, 2> moduli({side, side});
            for (std::size_t y = 0; y < side; ++y) std::copy_n(&field(y0 + y, x0), side, &square(y, 0));
            fft.forward(square);
            for (std::size_t p = 0; p < square.size(); ++p) moduli.data()[p] = std::abs(square.data()[p]);
            for (std::size_t k = 0; k <= iterations; ++k) {
                set_moduli(moduli.data(), square.elements());
                fft.backward(square);
                if (k == iterations) break;
                set_moduli(ones.data(), square.elements());
                fft.forward(square);
            }
            // Overlapping pixels keep the values of the earlier square.
            const std::size_t skip_x = i > 0 ? columns[i - 1] + side - x0 : 0;
            const std::size_t skip_y = j > 0 ? rows[j - 1] + side - y0 : 0;
            for (std::size_t y = skip_y; y < side; ++y)
                phases_of(&square(y, skip_x), {&cycles(y0 + y, x0 + skip_x), side - skip_x});
        });
    }
    return cycles;
}

}  // namespace hogel::patterns
