// SPDX-License-Identifier: Apache-2.0
#include "hogel/math/split_fft.h"

#include <fmt/format.h>

#include <complex>
#include <vector>

#include "hogel/error.h"
#include "hogel/math/fourier/plain.h"
#include "hogel/math/fourier/plan.h"

namespace hogel::math {

static_assert(SplitFft::together == fourier::batch_lines);

struct SplitFft::Plans {
    fourier::Plan plan;
};

SplitFft::SplitFft(std::size_t size) {
    if (size == 0 || !fourier::is_smooth(size))
        throw Error(ErrorCode::internal, fmt::format("a batch of lines cannot have transforms of {} samples", size));
    plans_ = std::make_unique<Plans>(fourier::Plan(size));
}
SplitFft::~SplitFft() = default;
SplitFft::SplitFft(SplitFft&&) noexcept = default;
SplitFft& SplitFft::operator=(SplitFft&&) noexcept = default;

std::size_t SplitFft::size() const { return plans_->plan.length; }
std::uint32_t SplitFft::place(std::size_t frequency) const { return plans_->plan.position[frequency]; }

void SplitFft::transform(float* lines) const {
    if (fourier::has_vectors()) return fourier::transform_in_place(plans_->plan, lines);
    std::vector<std::complex<float>> line(size());
    for (std::size_t l = 0; l < together; ++l) {
        for (std::size_t i = 0; i < line.size(); ++i) line[i] = {lines[i * row + l], lines[i * row + together + l]};
        fourier::transform_plain(line);
        for (std::size_t i = 0; i < line.size(); ++i) {
            float* to = lines + place(i) * row + l;
            to[0] = line[i].real();
            to[together] = line[i].imag();
        }
    }
}

}  // namespace hogel::math
