// SPDX-License-Identifier: Apache-2.0
// Light fields from files, which may hold what no light is.
#include <fmt/format.h>

#include <cmath>

#include "hogel/error.h"
#include "hogel/pipeline.h"

namespace hogel {
namespace {

// A face whose radiance is looked at as it is read.
class FiniteSource final : public LightFieldSource {
  public:
    FiniteSource(LightField::Source source, std::string name) : source_(std::move(source)), name_(std::move(name)) {}

    const LightFieldGrid& grid() const override { return source_->grid(); }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }
    void read(LightFieldTile& tile) const override {
        source_->read(tile);
        // Zero times a finite number is zero, times any other number NaN, and a sum with NaN stays NaN.
        float sum = 0;
        for (const float value : tile.radiance.elements()) sum += 0 * value;
        if (!(sum == 0)) fail(tile);
    }

  private:
    [[noreturn]] void fail(const LightFieldTile& tile) const {
        const Shape<5>& shape = tile.radiance.shape();
        for (std::size_t i = 0; i < tile.radiance.size(); ++i) {
            const float value = tile.radiance.data()[i];
            if (std::isfinite(value)) continue;
            std::size_t at = i, index[5];
            for (std::size_t axis = 5; axis-- > 0; at /= shape[axis]) index[axis] = at % shape[axis];
            throw Error(ErrorCode::bad_input,
                        fmt::format("cannot use '{}': the radiance of its hogel ({}, {}) in direction ({}, {}), "
                                    "channel {}, is {}; a finite number was expected",
                                    name_, tile.range.s0 + index[2], tile.range.t0 + index[1], index[4], index[3],
                                    index[0], value));
        }
        throw Error(ErrorCode::internal, "a radiance that is not finite was lost");
    }

    LightField::Source source_;
    std::string name_;
};

}  // namespace

LightField require_finite(const LightField& light_field, const std::string& name) {
    return light_field.wrapped(
        [&](const LightField::Source& face) { return std::make_shared<const FiniteSource>(face, name); });
}

}  // namespace hogel
