// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstdlib>

#include "hogel/codec/format/residuals.h"

namespace hogel::codec::format {
namespace {

int size_of(std::int32_t number) {
    const auto bits = static_cast<std::uint32_t>(number);
    return std::bit_width(number < 0 ? 0 - bits : bits);
}

}  // namespace

ResidualContexts::Context ResidualContexts::at(std::size_t v, std::size_t u, const ResidualContexts* previous) const {
    const std::size_t index = v * width_ + u;
    Context context{0, 0, 2};
    int sum = 0, weights = 0;
    const auto see = [&](std::int8_t size, int weight) {
        if (size == static_cast<int>(ResidualModels::special)) return;
        sum += weight * std::abs(size);
        weights += weight;
    };
    const auto see_beside = [&](std::int8_t size) {
        see(size, 2);
        if (size == static_cast<int>(ResidualModels::special))
            ++context.special;
        else
            context.sign += size > 0 ? 1u : size < 0 ? ~std::size_t{0} : 0u;
    };
    if (u > 0) see_beside(sizes_[index - 1]);
    if (v > 0) {
        see_beside(sizes_[index - width_]);
        if (u > 0) see(sizes_[index - width_ - 1], 1);
        if (u + 1 < width_) see(sizes_[index - width_ + 1], 1);
    }
    if (previous) see(previous->sizes_[index], 2);
    if (weights > 0) context.mean = static_cast<std::size_t>((sum + weights / 2) / weights);
    return context;
}

void ResidualContexts::set(std::size_t v, std::size_t u, const Residual& residual) {
    int size = residual.special ? static_cast<int>(ResidualModels::special) : size_of(residual.number);
    if (!residual.special && residual.number < 0) size = -size;
    sizes_[v * width_ + u] = static_cast<std::int8_t>(size);
}

template <class Coder>
Residual code_residual(Coder& coder, ResidualModels& models, const ResidualContexts::Context& context,
                       const Residual& residual) {
    auto& of_size = models.size[context.special][context.mean];
    const unsigned size_class =
        residual.special ? unsigned{ResidualModels::special} : unsigned(size_of(residual.number));
    unsigned node = 1;
    for (int bit = 5; bit >= 0; --bit) node = node * 2 + coder.bit(of_size[node], size_class >> bit & 1);
    const unsigned size = std::min(node - 64, unsigned{ResidualModels::special});
    if (size == ResidualModels::special) return {0, true};
    if (size == 0) return {};
    const bool negative = coder.bit(models.sign[context.sign], residual.number < 0);
    auto magnitude = static_cast<std::uint32_t>(residual.number);
    if (residual.number < 0) magnitude = 0 - magnitude;
    // The two bits below the highest have models; the lower ones are nearly equally likely to be 0 or 1.
    std::uint32_t result = 1;
    int left = static_cast<int>(size) - 1;
    for (int k = 0; k < 2 && left > 0; ++k) {
        --left;
        result = result << 1 | std::uint32_t{coder.bit(models.below_highest[size][result & 3], magnitude >> left & 1)};
    }
    if (left > 0) result = result << left | coder.raw(magnitude & ((1u << left) - 1), left);
    return {static_cast<std::int32_t>(negative ? 0 - result : result), false};
}

template Residual code_residual(ResidualWriter&, ResidualModels&, const ResidualContexts::Context&, const Residual&);
template Residual code_residual(ResidualReader&, ResidualModels&, const ResidualContexts::Context&, const Residual&);

}  // namespace hogel::codec::format
