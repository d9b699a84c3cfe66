// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/codec/encode/depth.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/compress.h"
#include "hogel/error.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Range of finite depths; nearest > farthest if there are none.
struct Range {
    float nearest = infinity, farthest = -infinity;

    void include(const Range& other) {
        nearest = std::min(nearest, other.nearest);
        farthest = std::max(farthest, other.farthest);
    }
};

Range depths_of(const LightFieldSource& source, const HogelRange& range) {
    LightFieldTile tile(source.grid(), range, true);
    source.read(tile);
    Range depths;
    for (const float depth : tile.depth.elements()) {
        if (depth == infinity) continue;
        if (!std::isfinite(depth))
            throw Error(ErrorCode::bad_input,
                        fmt::format("depth is {} in hogels {} to {} of rows {} to {}, expected a number or infinity",
                                    depth, range.s0, range.s0 + range.ns - 1, range.t0, range.t0 + range.nt - 1));
        depths.include({depth, depth});
    }
    return depths;
}

class DepthAsRadiance final : public LightFieldSource {
  public:
    DepthAsRadiance(LightField::Source source, const DepthCoding& coding)
        : source_(std::move(source)), grid_(source_->grid()), nothing_(static_cast<float>(coding.nothing)) {
        grid_.channels = 1;
    }

    const LightFieldGrid& grid() const override { return grid_; }
    HogelRange preferred_tile() const override { return source_->preferred_tile(); }
    void read(LightFieldTile& tile) const override {
        LightFieldTile tile_with_depth(source_->grid(), tile.range, true);
        source_->read(tile_with_depth);
        std::ranges::transform(tile_with_depth.depth.elements(), tile.radiance.elements().begin(),
                               [&](float depth) { return depth == infinity ? nothing_ : depth; });
    }

  private:
    LightField::Source source_;
    LightFieldGrid grid_;
    float nothing_;
};

}  // namespace

namespace {

// Returns the range of depths, or for a single depth its magnitude.
double range_of(double nearest, double farthest) {
    return farthest > nearest ? farthest - nearest : std::max(std::abs(farthest), 1e-6);
}

}  // namespace

DepthCoding::DepthCoding(double nearest, double farthest, double bound) : error(bound) {
    // Far enough for any rounding, but no farther: edges between finite and infinite depths cost more if the
    // jump is larger.
    beyond = farthest + 4 * error + 1e-2 * range_of(nearest, farthest);
    nothing = beyond + (beyond - farthest);
}

DepthCoding depth_coding(const LightField& light_field, std::optional<double> bound) {
    Range range;
    for (const LightField::Source& face : light_field.faces()) {
        const Tiling tiling(face->grid(), face->preferred_tile());
        work::ordered_reduce<Range>(
            tiling.count(), work::default_in_flight(), {}, [&](std::size_t i) { return depths_of(*face, tiling[i]); },
            [&](std::size_t, Range& depths) { range.include(depths); });
    }
    work::broadcast_result(range, {});
    if (range.nearest > range.farthest) range = {0, 0};
    return DepthCoding(
        range.nearest, range.farthest,
        bound ? *bound : default_depth_error(light_field.front().grid(), range_of(range.nearest, range.farthest)));
}

LightField depth_as_radiance(const LightField& light_field, const DepthCoding& coding) {
    return light_field.wrapped(
        [&](const LightField::Source& face) { return std::make_shared<DepthAsRadiance>(face, coding); });
}

StreamInfo::Depth compress_depth(
    const LightField& light_field, const CompressionOptions& options,
    const std::function<std::uint64_t(const LightField&, const CompressionOptions&)>& code) {
    if (!light_field.has_depth()) throw Error(ErrorCode::usage, "depth was asked for, but the light field has none");
    std::optional<double> bound = options.depth_error;
    if (bound && !(*bound >= 0 && std::isfinite(*bound)))
        throw Error(ErrorCode::usage, "depth_error",
                    fmt::format("an error of depth of {} m was asked for, expected 0 or a positive one", *bound));
    if (!bound && std::holds_alternative<Lossless>(options.target)) bound = 0;
    const DepthCoding coding = depth_coding(light_field, bound);
    CompressionOptions exact;
    exact.target = MaxError{coding.error};
    if (coding.error == 0) exact.target = Lossless{};
    exact.tile = options.tile;
    return {code(depth_as_radiance(light_field, coding), exact), coding.error, coding.beyond};
}

}  // namespace hogel::codec::encode

namespace hogel {

namespace {

// Returns the largest |U| and |V| of a hogel's rays.
double steepest_slope(const LightFieldGrid& hogel) {
    if (!hogel.has_frequencies())
        return std::max(std::abs(hogel.center_u()) + hogel.half_u(), std::abs(hogel.center_v()) + hogel.half_v());
    double steepest = 0;
    for (std::size_t v = 0; v < hogel.directions_v; ++v)
        for (std::size_t u = 0; u < hogel.directions_u; ++u) {
            const Vec3 ray = hogel.direction_of(hogel.u(static_cast<double>(u)), hogel.v(static_cast<double>(v)));
            steepest = std::max({steepest, std::abs(ray.x), std::abs(ray.y)});
        }
    return steepest;
}

}  // namespace

double default_depth_error(const LightFieldGrid& grid, double range) {
    // The hogels in the first and the last corner have the steepest directions.
    double steepest = 0;
    for (const LightFieldGrid& hogel : {grid.of_hogel(0, 0), grid.of_hogel(static_cast<double>(grid.hogels_s) - 1,
                                                                           static_cast<double>(grid.hogels_t) - 1)})
        steepest = std::max(steepest, steepest_slope(hogel));
    const double a_thousandth = 1e-3 * range;
    return steepest > 0 ? std::min(grid.pitch / (32000 * steepest), a_thousandth) : a_thousandth;
}

}  // namespace hogel
