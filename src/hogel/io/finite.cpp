// SPDX-License-Identifier: Apache-2.0
// Rejects values in files that are not finite: a single one would spread over whole holograms and pictures.
#include "hogel/io/finite.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "hogel/error.h"

namespace hogel::io {
namespace {

class FiniteSource final : public LightFieldSource {
  public:
    FiniteSource(LightField::Source source, std::filesystem::path path)
        : source_(std::move(source)), path_(std::move(path)) {}

    const LightFieldGrid& grid() const override { return source_->grid(); }
    bool has_depth() const override { return source_->has_depth(); }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }
    void read(LightFieldTile& tile) const override {
        source_->read(tile);
        if (!all_finite(tile.radiance.elements())) throw_not_finite(tile, path_);
    }

  private:
    LightField::Source source_;
    std::filesystem::path path_;
};

}  // namespace

// Adding 1 to the exponent of a non-finite number carries into the sign bit. Integer loops are vectorised.
bool all_finite(std::span<const float> values) {
    std::uint32_t carries = 0;
    for (const float value : values) carries |= (std::bit_cast<std::uint32_t>(value) & 0x7fffffffu) + 0x00800000u;
    return (carries & 0x80000000u) == 0;
}

void throw_not_finite(const LightFieldTile& tile, const std::filesystem::path& path) {
    const Shape<5>& shape = tile.radiance.shape();
    for (std::size_t i = 0; i < tile.radiance.size(); ++i) {
        const float value = tile.radiance.data()[i];
        if (std::isfinite(value)) continue;
        std::size_t rest = i, index[5];
        for (std::size_t axis = 5; axis-- > 0; rest /= shape[axis]) index[axis] = rest % shape[axis];
        throw Error(ErrorCode::bad_input,
                    fmt::format("cannot use '{}': the radiance of its hogel ({}, {}) in direction ({}, {}), channel "
                                "{}, is {}; a finite number was expected",
                                path.string(), tile.range.s0 + index[2], tile.range.t0 + index[1], index[4], index[3],
                                index[0], value));
    }
    throw Error(ErrorCode::internal, "a radiance that is not finite was lost");
}

void require_finite(View<const std::complex<float>, 2> samples, const Region& region, std::size_t field,
                    const std::filesystem::path& path) {
    // The standard allows access to complex numbers as pairs of floats.
    if (all_finite({reinterpret_cast<const float*>(samples.data()), 2 * samples.size()})) return;
    const auto is_wrong = [](const std::complex<float>& sample) {
        return !std::isfinite(sample.real()) || !std::isfinite(sample.imag());
    };
    const auto found = std::ranges::find_if(samples.elements(), is_wrong);
    const auto index = static_cast<std::size_t>(found - samples.elements().begin());
    throw Error(ErrorCode::bad_input,
                fmt::format("cannot use '{}': the sample in row {} and column {} of its field {}, from 0, is {}{:+}i; "
                            "finite numbers were expected",
                            path.string(), region.y0 + index / region.width, region.x0 + index % region.width, field,
                            found->real(), found->imag()));
}

void require_finite(const Field& samples, std::size_t field, const std::filesystem::path& path) {
    const Grid& plane = samples.grid().plane;
    require_finite(samples.samples, {0, 0, plane.width, plane.height}, field, path);
}

LightField require_finite(const LightField& light_field, const std::filesystem::path& path) {
    return light_field.wrapped(
        [&](const LightField::Source& face) { return std::make_shared<const FiniteSource>(face, path); });
}

}  // namespace hogel::io
