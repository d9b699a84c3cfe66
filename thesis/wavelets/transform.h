// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "thesis/wavelets/pyramid.h"
#include "thesis/wavelets/wavelet.h"

namespace hogel::wavelets {

/// Named transform: a wavelet, or the windowed 8-point DCT. Created by transform(); cheap to copy.
class Transform {
  public:
    std::string_view name() const { return wavelet_ ? wavelet_->name : "dct8"; }
    bool is_wavelet() const { return wavelet_ != nullptr; }
    /// Returns the wavelet. Must not be called for the DCT.
    const Wavelet& wavelet() const { return *wavelet_; }

    /// Transforms a row-major array of the pyramid's shape in place. The DCT transforms the axes of all groups once,
    /// regardless of their levels. Works on all threads; the result does not depend on their number. Cost: O(size ·
    /// axes). Throws Error(usage) if the number of elements differs from the pyramid's.
    void forward(const Pyramid& pyramid, std::span<float> elements) const;
    /// Inverts forward(), up to rounding.
    void inverse(const Pyramid& pyramid, std::span<float> elements) const;

  private:
    friend Transform transform(std::string_view name);
    explicit Transform(const Wavelet* wavelet) : wavelet_(wavelet) {}
    const Wavelet* wavelet_;  // null: the DCT
};

/// Returns the transform of a name: haar|d4|d6|ai13|ai31|ai33|i22|i24|i42|i44|cdf31|cdf33|cdf42|cdf44|cdf97|dct8.
/// Throws Error(usage) with that list for any other name.
Transform transform(std::string_view name);

/// Returns all names, in this order.
std::vector<std::string_view> transform_names();

}  // namespace hogel::wavelets
