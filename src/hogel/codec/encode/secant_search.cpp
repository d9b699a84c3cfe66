// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "hogel/codec/encode/secant_search.h"

namespace hogel::codec::encode {

bool Search::add(double value) {
    if (value >= low_ && value <= high_) return true;
    if (std::isfinite(value)) {
        if (last_ && last_->first != next_) {
            const double slope = (value - last_->second) / (next_ - last_->first);
            // A slope far from the expected one is noise and is ignored.
            if (slope < 0.2 * slope_ && slope > 5 * slope_) slope_ = slope;
        }
        last_ = {next_, value};
    }
    (value > high_ ? above_ : below_) = next_;
    const double aim = (low_ + high_) / 2;
    double step = std::isfinite(value) ? (aim - value) / slope_ : value > 0 ? 4.0 : -4.0;
    step = std::clamp(step, -8.0, 8.0);
    double next_argument = next_ + step;
    // Every fourth step is a bisection, in case the secant approaches from one side only.
    if (above_ && below_ && (++bracketed_ % 4 == 0 || next_argument <= *above_ || next_argument >= *below_))
        next_argument = (*above_ + *below_) / 2;
    next_ = next_argument;
    return false;
}

}  // namespace hogel::codec::encode
