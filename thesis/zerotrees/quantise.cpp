// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/quantise.h"

#include <fmt/format.h>

#include <algorithm>

#include "hogel/coding/histogram_rule.h"
#include "hogel/error.h"

namespace hogel::zerotrees {

double energy(std::span<const float> values) {
    double sum = 0;
    for (float value : values) sum += static_cast<double>(value) * value;
    return sum;
}

double squared_error(std::span<const float> values, double step) {
    const Quantiser quantiser(step);
    double sum = 0;
    for (float value : values) {
        const double error = std::abs(value) - static_cast<double>(quantiser.value(quantiser.level(value), false));
        sum += error * error;
    }
    return sum;
}

double step_for_sqnr(std::span<const float> values, double sqnr) {
    if (!(sqnr > 0 && sqnr <= 130))
        throw Error(ErrorCode::usage, "sqnr",
                    fmt::format("coding: an SQNR of {} dB, expected more than 0 and at most 130", sqnr));
    const double max_value = coding::max_magnitude(values);
    if (max_value == 0) return 1;
    const double allowed = energy(values) * std::pow(10, -sqnr / 10);
    // With the coarse step all levels are zero; with the fine one floats are nearly exact.
    double coarse = max_value, fine = max_value * 0x1p-30;
    while (coarse > fine * 1.001) {
        const double step = std::sqrt(coarse * fine);
        (squared_error(values, step) <= allowed ? fine : coarse) = step;
    }
    return fine;
}

}  // namespace hogel::zerotrees
